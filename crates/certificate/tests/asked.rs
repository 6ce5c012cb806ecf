//! Requests that no plan can meet, an order that a job requires, and facts that only the job's owner knows.

use crate::maker::{Recipe, good, irb120, resealed};
use platewash_certificate::Requirement::{self, EveryPlateOnce, Plates};
use platewash_certificate::{Certificate, differences, prove};
use platewash_motion::plan::Plan;
use platewash_workcell::job::JobTerms;

fn judged(plan: Plan) -> Certificate {
    prove(&resealed(plan), &irb120()).unwrap()
}

fn broken(certificate: &Certificate) -> Vec<Requirement> {
    certificate.broken().map(|c| c.requirement).collect()
}

#[test]
fn plates_that_reach_below_the_floor_are_named() {
    let mut plan = good();
    plan.job.plates.iter_mut().for_each(|plate| plate.thickness_m = 1.0);
    let told = judged(plan);
    assert!(broken(&told).contains(&Plates), "{told}");
    let underside = "height of the underside of plate 1 over the floor: -970.0 mm; expected none below 0";
    assert!(told.to_string().contains(underside), "{told}");
}

#[test]
fn keeps_the_requested_order() {
    let mut recipe = Recipe::arc(&[-35.0, 30.0]);
    recipe.order = vec![1, 0];
    assert_eq!(broken(&judged(recipe.plan())), []);
    recipe.terms.requirements.as_listed = true;
    let told = judged(recipe.plan());
    assert_eq!(broken(&told), [EveryPlateOnce], "{told}");
    recipe.order = vec![0, 1];
    assert_eq!(broken(&judged(recipe.plan())), []);
}

/// A job that requires less than was wanted is done all the same: the certificate holds, and the comparison with the wanted job names the
/// lowered requirements.
#[test]
fn only_the_comparison_finds_a_lowered_requirement() {
    type Change = fn(&mut JobTerms);
    let lowered: [(&str, Change); 8] = [
        ("requirements.clearance_m", |t| t.requirements.clearance_m = 0.0),
        ("requirements.coverage", |t| t.requirements.coverage = 0.5),
        ("requirements.tilt_rad", |t| t.requirements.tilt_rad = 0.4),
        ("requirements.wash_speed_m_s", |t| t.requirements.wash_speed_m_s = 0.5),
        ("limits.tip_speed_m_s", |t| t.limits.tip_speed_m_s = 2.0),
        ("limits.joint_acceleration_rad_s2[2]", |t| {
            t.limits.joint_acceleration_rad_s2[2] = 9.0
        }),
        ("plates[1].thickness_m", |t| t.plates[1].thickness_m *= 0.5),
        ("seed", |t| t.seed = 7),
    ];
    for (key, change) in lowered {
        let mut plan = good();
        change(&mut plan.job);
        let found = differences(&plan.job, &good().job);
        assert_eq!(found.iter().map(|d| d.key.as_str()).collect::<Vec<_>>(), [key]);
        let certificate = judged(plan);
        assert!(certificate.passes(), "{key}\n{certificate}");
    }
}
