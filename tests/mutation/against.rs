//! What a certificate does not tell: whose job a plan does. A job that asks for less is found against its scenario, by name.

use crate::mutation::edit::{JOBS, good, scenario};
use crate::mutation::edits;
use nalgebra::Vector3;
use platewash::certificate::{differences, prove};
use platewash::kinematics::geometry::Shape;
use platewash::workcell::job::{OrderRule, Overlap, Planner, PlannerSettings};
use platewash::workcell::simulation::ControlLawName;
use platewash::workcell::{Exclusion, ExclusionReason};
use platewash::{JobTerms, Plan, Scenario, Surface, plan};
use rayon::prelude::*;

type Change = fn(&mut JobTerms);

/// An edit of the job, the field under which it is found, and whether the motion does the edited job, too.
struct Case(&'static str, bool, Change);

fn settings(terms: &mut JobTerms) -> &mut PlannerSettings {
    match &mut terms.planner {
        Planner::Wash(settings) => settings,
        Planner::Paper(_) => panic!("the job is one of a washing"),
    }
}

/// What must be kept.
const REQUIRED: [Case; 13] = [
    Case("requirements.clearance_m", true, |j| j.requirements.clearance_m = 5e-3),
    Case("requirements.clearance_m", true, |j| {
        j.requirements.clearance_m += 1e-12
    }),
    Case("requirements.coverage", true, |j| j.requirements.coverage = 0.9),
    Case("requirements.tilt_rad", true, |j| j.requirements.tilt_rad = 0.6),
    Case("requirements.wash_speed_m_s", true, |j| {
        j.requirements.wash_speed_m_s = 0.5
    }),
    Case("requirements.wash_acceleration_m_s2", true, |j| {
        j.requirements.wash_acceleration_m_s2 = 9.0
    }),
    Case("requirements.overlap", true, |j| {
        j.requirements.overlap = Overlap::Report
    }),
    Case("requirements.as_listed", false, |j| j.requirements.as_listed = true),
    Case("limits.joint_acceleration_rad_s2[2]", true, |j| {
        j.limits.joint_acceleration_rad_s2[2] = 40.0
    }),
    Case("limits.tip_speed_m_s", true, |j| j.limits.tip_speed_m_s = 2.0),
    Case("limits.tip_acceleration_m_s2", false, |j| {
        j.limits.tip_acceleration_m_s2 = 1.0
    }),
    Case("home_rad[0][3]", true, |j| j.home_rad[0][3] += 5e-10),
    Case("home_rad[1][0]", false, |j| j.home_rad[1][0] = 0.1),
];

/// The world.
const WORLD: [Case; 17] = [
    Case(r#"workcell.tool.bodies["handle"].shape.cylinder.radius_m"#, true, |j| {
        j.workcell.tool.bodies[0].shape = Shape::Cylinder {
            radius_m: 0.01,
            half_length_m: 0.0625,
        }
    }),
    // Behind the flange the handle is within link 5.
    Case(r#"workcell.tool.bodies["handle"].pose.position_m[2]"#, false, |j| {
        j.workcell.tool.bodies[0].pose.translation.z -= 1e-3
    }),
    Case("workcell.tool.sponge.radius_m", true, |j| {
        j.workcell.tool.sponge.radius_m += 1e-4
    }),
    Case("workcell.tool.sponge.compression_m", true, |j| {
        j.workcell.tool.sponge.compression_m += 4e-4
    }),
    Case("workcell.tool.tip.position_m[2]", false, |j| {
        j.workcell.tool.tip.translation.z += 1e-5
    }),
    Case("workcell.tool.mass", true, |j| j.workcell.tool.mass = None),
    Case(r#"workcell.exclusions[["link_4","handle"]]"#, true, |j| {
        j.workcell.exclusions.push(Exclusion {
            pair: ["link_4", "handle"].map(str::to_owned),
            reason: ExclusionReason::Srdf,
        })
    }),
    Case(r#"workcell.exclusions[["base_link","link_1"]]"#, false, |j| {
        _ = j.workcell.exclusions.remove(0)
    }),
    Case("order of workcell.exclusions", true, |j| {
        j.workcell.exclusions.swap(3, 4)
    }),
    Case("workcell.obstacles[", false, |j| {
        j.workcell.obstacles[0].name = "ground".to_owned()
    }),
    Case(r#"workcell.obstacles["floor"]"#, false, |j| {
        j.workcell.obstacles.clear()
    }),
    Case("workcell.arm.name", false, |j| j.workcell.arm.name = "other".to_owned()),
    Case("workcell.arm.srdf_sha256", false, |j| j.workcell.arm.srdf_sha256 = None),
    Case("plates[1].surface.radius_m", true, |j| {
        j.plates[1].surface = Surface::Disc { radius_m: 0.144 }
    }),
    Case("plates[2].pose.position_m[0]", true, |j| {
        j.plates[2].pose.translation.x += 1e-5
    }),
    Case("plates[3].thickness_m", true, |j| j.plates[3].thickness_m = 0.01),
    Case("plates[4]", false, |j| j.plates.push(j.plates[0].moved_to([-0.6, 0.0]))),
];

/// What no requirement rests on.
const UNJUDGED: [Case; 13] = [
    Case("seed", true, |j| j.seed = 7),
    Case("planner.wash.path_radius_m", true, |j| {
        settings(j).path_radius_m = Some(0.1)
    }),
    Case("planner.wash.turns", true, |j| settings(j).turns = Some(2.0)),
    Case("planner.wash.closing_ring", true, |j| {
        settings(j).closing_ring = Some(false)
    }),
    Case("planner.wash.lift_m", true, |j| settings(j).lift_m = 0.01),
    Case("planner.wash.order", true, |j| settings(j).order = OrderRule::Nearest),
    Case("planner.wash.arc.points", true, |j| settings(j).arc.points = 9),
    Case("planner.wash.reach.near_m", true, |j| settings(j).reach.near_m = 0.2),
    Case("planner.wash.relocate", true, |j| settings(j).relocate = true),
    Case("simulation.law", true, |j| j.simulation.law = ControlLawName::Exact),
    Case("simulation.control.rate_hz", true, |j| {
        j.simulation.control.rate_hz = 100.0
    }),
    Case("simulation.plant.contact_force_n", true, |j| {
        j.simulation.plant.contact_force_n = 1.0
    }),
    Case("simulation.payload_kg", true, |j| j.simulation.payload_kg = Some(99.0)),
];

#[test]
fn a_job_that_was_edited_is_found_against_its_scenario() {
    let cases: Vec<_> = REQUIRED.iter().chain(&WORLD).chain(&UNJUDGED).collect();
    let good = &good()[0];
    cases.par_iter().for_each(|Case(key, passes, change)| {
        let mut plan = good.plan.clone();
        change(&mut plan.job);
        plan.hash = Some(plan.seal().unwrap());
        let found = differences(&plan.job, &good.terms);
        let keys: Vec<_> = found.iter().map(|difference| difference.key.as_str()).collect();
        assert!(!keys.is_empty(), "{key} is not found");
        assert!(keys.iter().all(|found| found.starts_with(key)), "{key}: {keys:?}");
        let certificate = prove(&plan, good.robot).unwrap();
        assert_eq!(certificate.passes(), *passes, "{key}: {certificate}");
    });
    assert!(cases.iter().filter(|case| case.1).count() >= 30, "most pass");
}

/// Whatever is edited of a job is found, and nothing else.
#[test]
fn every_edit_of_a_job_is_found_against_its_scenario() {
    for good in good() {
        assert_eq!(differences(&good.plan.job, &good.terms), []);
    }
    let (mut of_jobs, mut of_plans) = (0, 0);
    for edit in edits::all() {
        let good = &good()[edit.of];
        let plan = edit.apply(&good.plan);
        let found = differences(&plan.job, &good.terms);
        assert_eq!(found.is_empty(), plan.job == good.terms, "{}: {found:?}", edit.what);
        *(if found.is_empty() { &mut of_plans } else { &mut of_jobs }) += 1;
    }
    assert!(of_jobs > 120 && of_plans > 120, "{of_jobs} {of_plans}");
}

/// Plans that are planned properly for an easier job under the scenario's name.
#[test]
fn a_plan_of_another_job_passes_and_is_found() {
    let keys = |other: &Plan| {
        let certificate = prove(other, good()[0].robot).unwrap();
        assert!(certificate.passes(), "{certificate}");
        assert_eq!(certificate.scenario, "kitchen-spiral");
        let found = differences(&other.job, &good()[0].terms);
        found.into_iter().map(|difference| difference.key).collect::<Vec<_>>()
    };
    let job = scenario(JOBS[0]).job().unwrap();
    let plates = |plates: &[platewash::Plate]| plan(&job.on_plates(plates.to_vec()).unwrap()).unwrap().plan;
    let mut easier = job.terms().plates.clone();
    easier.pop();
    assert_eq!(keys(&plates(&easier)), ["plates[3]"]);
    // One plate nearer to the arm.
    let mut nearer = job.terms().plates.clone();
    let towards = nearer[2].centre() - nearer[2].centre().component_mul(&Vector3::new(0.02, 0.02, 0.0));
    nearer[2] = nearer[2].moved_to([towards.x, towards.y]);
    let moved = ["plates[2].pose.position_m[0]", "plates[2].pose.position_m[1]"];
    assert_eq!(keys(&plates(&nearer)), moved);
    // The plates of another seed, under this one's name.
    let lucky = Scenario {
        seed: 3,
        ..scenario(JOBS[0])
    };
    let mut other = plan(&lucky.job().unwrap()).unwrap().plan;
    other.job.seed = job.terms().seed;
    other.hash = Some(other.seal().unwrap());
    let found = keys(&other);
    assert_eq!(found.len(), 8);
    assert!(found.iter().all(|key| key.starts_with("plates[")), "{found:?}");
}
