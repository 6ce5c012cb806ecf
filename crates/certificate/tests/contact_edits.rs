//! Plans whose jobs are edited: what is more than a plan has to spare is refused by the requirement that it concerns, what is less is still
//! proved. What it has to spare is taken from its certificate.

use crate::contact::{disc, profile, rings};
use crate::maker::{Recipe, irb120};
use platewash_certificate::{Certificate, Measure, Requirement, Status, prove};
use platewash_fixtures::is_thorough;
use platewash_motion::plan::Plan;
use rayon::prelude::*;

/// An edit: the requirement that it concerns, and the job with a share of what there is to spare taken away.
type Edit = (Requirement, fn(&mut Plan, &Measure, f64));

/// A limit that is moved towards what is proved.
fn towards(limit: &mut f64, measure: &Measure, share: f64) {
    *limit += share * (measure.bound.unwrap() - measure.limit);
}

fn contact(plan: &mut Plan) -> &mut platewash_workcell::job::ContactRequirements {
    plan.job.requirements.contact.as_mut().unwrap()
}

const EDITS: [Edit; 11] = [
    (Requirement::Pressed, |p, m, s| towards(&mut contact(p).share, m, s)),
    (Requirement::ContactTime, |p, m, s| {
        towards(&mut contact(p).time_share, m, s)
    }),
    (Requirement::ContactDose, |p, m, s| {
        towards(&mut contact(p).dose_share, m, s)
    }),
    (Requirement::Strain, |p, m, s| towards(&mut contact(p).strain, m, s)),
    (Requirement::ContactForce, |p, m, s| {
        towards(&mut contact(p).force_n[1], m, s)
    }),
    // A stiffer sponge presses harder in proportion.
    (Requirement::ContactForce, |p, m, s| {
        let range = p.job.workcell.tool.sponge.stiffness_pa.as_mut().unwrap();
        range[1] *= 1.0 + s * (m.limit / m.bound.unwrap() - 1.0);
    }),
    (Requirement::Wrist, |p, m, s| {
        towards(p.job.requirements.wrist_rad.as_mut().unwrap(), m, s)
    }),
    (Requirement::Tilt, |p, m, s| {
        let mut cone = p.job.requirements.tilt_rad;
        towards(&mut cone, m, s);
        p.job.requirements.tilt_rad = cone;
        p.wash_paths.iter_mut().for_each(|path| path.cone_rad = cone);
    }),
    (Requirement::Swept, |p, m, s| {
        towards(&mut p.job.requirements.coverage, m, s)
    }),
    (Requirement::ContactSpeed, |p, m, s| {
        towards(p.job.requirements.landing_m_s.as_mut().unwrap(), m, s);
        p.job.requirements.lifting_m_s = p.job.requirements.landing_m_s;
    }),
    // The plate lies lower, or the tip higher over it.
    (Requirement::ContactHeight, |p, m, s| {
        let spare = m.limit - m.bound.unwrap();
        p.job
            .plates
            .iter_mut()
            .for_each(|plate| plate.pose.translation.z -= s * spare);
    }),
];

fn plans() -> Vec<(&'static str, Plan)> {
    let plan = |mut recipe: Recipe| {
        recipe.terms.requirements.landing_m_s = Some(0.2);
        recipe.terms.requirements.lifting_m_s = Some(0.2);
        recipe.terms.requirements.wrist_rad = Some(0.01);
        recipe.terms.requirements.coverage = 0.98;
        let contact = recipe.terms.requirements.contact.as_mut().unwrap();
        (contact.share, contact.time_share, contact.dose_share) = (0.98, 0.95, 0.95);
        recipe.plan()
    };
    vec![
        ("disc", plan(disc(0.006, 4.0, rings()))),
        ("disc, upright", plan(disc(0.005, 0.0, rings()))),
        ("dessert190", plan(profile("dessert190"))),
        ("coupe275", plan(profile("coupe275"))),
        ("rim270", plan(profile("rim270"))),
    ]
}

fn judged(plan: &Plan) -> Certificate {
    prove(plan, &irb120()).unwrap()
}

#[test]
fn proves_errors_within_the_spare_and_refuses_larger_ones() {
    let mut plans = plans();
    if !is_thorough() {
        // A flat plate under a tilted sponge, and the plate with the most of everything.
        plans.retain(|(name, _)| ["disc", "rim270"].contains(name));
    }
    let least = 18 * plans.len();
    let edits: usize = plans.into_par_iter().map(edited).sum();
    assert!(edits >= least, "{edits}");
}

/// Returns the number of edits of a plan that were judged.
fn edited((name, plan): (&str, Plan)) -> usize {
    let mut edits = 0;
    let before = judged(&plan);
    // If everything is required, the finest cells are examined: no more can be proved.
    let mut all = plan.clone();
    all.job.requirements.coverage = 1.0;
    (
        contact(&mut all).share,
        contact(&mut all).time_share,
        contact(&mut all).dose_share,
    ) = (1.0, 1.0, 1.0);
    let most = judged(&all);
    for (requirement, edit) in EDITS {
        let check = before.check(requirement).unwrap();
        let mut measure = check.measure.unwrap();
        if measure.unit == platewash_certificate::Unit::Share && requirement != Requirement::Strain {
            measure.bound = most.check(requirement).unwrap().measure.unwrap().bound;
        }
        assert_eq!(check.status, Status::Proved, "{name}: {check:?}");
        for (share, kept) in [(0.9, true), (1.1, false)] {
            let (mut edited, mut measure) = (plan.clone(), measure);
            if requirement == Requirement::ContactSpeed && !kept {
                // Bounded more tightly where the limit is nearer: beyond what is seen it is broken for certain.
                measure.bound = measure.seen;
            }
            edit(&mut edited, &measure, share);
            // A share cannot be asked for beyond the whole.
            if edited.job.validate().is_err() {
                continue;
            }
            let after = judged(&edited);
            let status = after.check(requirement).unwrap().status;
            assert_eq!(
                status == Status::Proved,
                kept,
                "{name}, {requirement:?}, {share}: {after}"
            );
            edits += 1;
        }
    }
    edits
}

/// Joint 5 on the other side of 0 at one knot in the middle of a wash.
#[test]
fn a_wrist_that_flips_is_refused() {
    let (_, mut plan) = plans().swap_remove(0);
    let middle = plan.knots.t_s.len() / 2;
    plan.knots.q_rad[middle][4] *= -1.0;
    let after = judged(&plan);
    assert_eq!(
        after.check(Requirement::Wrist).unwrap().status,
        Status::Violated,
        "{after}"
    );
}
