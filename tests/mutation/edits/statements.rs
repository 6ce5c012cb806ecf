//! The arm, tolerances, pairs, summary and homes.

use crate::edit::{Edits, Kind};
use platewash::planner::certificate::PromiseName::{Arm, ClearancePairs, HomeToHome, Summary, Tolerances};
use platewash::planner::scenario::{OrderRule, Program};

pub fn add(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Statements, what, names, apply);
    fails("the arm's name", &[Arm], |p| p.robot.name.push(' '));
    fails("the arm's description", &[Arm], |p| {
        p.robot.urdf_sha256 = "0".repeat(64)
    });
    fails("the description in capitals", &[Arm], |p| {
        p.robot.urdf_sha256.make_ascii_uppercase()
    });
    fails("the program", &[Arm], |p| {
        (p.scenario.job.program, p.scenario.job.order) = (Program::Paper, OrderRule::Nearest);
    });
    fails("a tolerance of positions", &[Tolerances], |p| {
        p.tolerances.position_m *= 2.0
    });
    fails("a tolerance of angles", &[Tolerances], |p| {
        p.tolerances.orientation_rad = 1.0
    });
    fails("the tolerance of strokes", &[Tolerances], |p| {
        p.tolerances.path_m = 0.01
    });
    fails("the tolerance of lines", &[Tolerances], |p| {
        p.tolerances.line_m -= 1e-15
    });
    fails("a tolerance, asked", &[Tolerances], |p| {
        p.scenario.ik.position_tolerance_m *= 2.0
    });
    fails("a pair dropped", &[ClearancePairs], |p| {
        _ = p.clearance_pairs.remove(17)
    });
    fails("all pairs dropped", &[ClearancePairs], |p| p.clearance_pairs.clear());
    fails("a pair doubled", &[ClearancePairs], |p| {
        p.clearance_pairs.push(p.clearance_pairs[0].clone())
    });
    fails("pairs exchanged", &[ClearancePairs], |p| p.clearance_pairs.swap(0, 1));
    fails("a pair turned round", &[ClearancePairs], |p| {
        p.clearance_pairs[3].reverse()
    });
    fails("a pair of others", &[ClearancePairs], |p| {
        p.clearance_pairs[3][0] = "link_9".into()
    });
    let mut words = |what, apply| edits.fails(Kind::Words, what, &[Summary], apply);
    words("the headline", |p| p.summary.headline.push('!'));
    words("another headline", |p| {
        p.summary.headline = "9 plates sterilised in 1 s, PROVED".into()
    });
    words("no plate washed", |p| p.summary.plates_washed = 0);
    words("a plate washed more", |p| p.summary.plates_washed += 1);
    words("another duration", |p| p.summary.duration_s -= 1.0);
    words("waypoints", |p| p.summary.waypoints_reached = [1, 1]);
    let mut homes = |what, apply| edits.fails(Kind::Home, what, &[HomeToHome], apply);
    homes("stated", |p| p.home_rad[1][3] += 1e-6);
    homes("asked", |p| p.scenario.robot.start_deg[5] += 1e-5);
    homes("asked and stated", |p| {
        p.scenario.robot.start_deg[5] += 1.0;
        p.home_rad = p.scenario.homes();
    });
    homes("another at the end", |p| {
        p.scenario.robot.home_deg = Some([10.0, 0.0, 0.0, 0.0, 80.0, 0.0]);
        p.home_rad = p.scenario.homes();
    });
    edits.harmless(Kind::Home, "the same at the end, in words", |p| {
        p.scenario.robot.home_deg = Some(p.scenario.robot.start_deg);
    });
}
