//! When a job counts as washed, and what breaks it: one good job and single changes of it.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use platewash::planner::report::{JobFinding, ViolationKind};
use platewash::planner::tracking::TrackingError;
use platewash::planner::{plan, scenario::ControlLawName};
use platewash::{Job, JobReport, PlanError, Scenario, Verdict};

/// One plate in front of the arm, a 150 mm tool on its surface, from a start over its centre, slowly and exactly.
const GOOD: &str = r#"
name = "one plate"
[robot]
start_deg = [0, 39.507074, 26.156277, 0, 24.336649, 0]
[tool]
length_m = 0.15
[layout]
positions_m = [[0.36, 0.0]]
[wash]
points = 400
turns = 4
path_radius_m = 0.124
height_m = 0
closing_ring = true
clearance_m = 0.01
[control]
law = "exact"
dt_s = 0.2
"#;

fn good() -> Scenario {
    Scenario::parse(GOOD, "good").unwrap()
}

fn judged(change: impl FnOnce(&mut Scenario)) -> JobReport {
    let mut scenario = good();
    change(&mut scenario);
    Job::run(&scenario).unwrap().report().unwrap()
}

#[test]
fn a_plate_that_is_covered_clear_and_touched_is_washed() {
    let report = judged(|_| ());
    assert_eq!(report.headline, "WASHED: 1 of 1 plate, every limit kept.");
    assert_eq!(report.verdict, Verdict::Washed);
    let plate = &report.plates[0];
    assert!(plate.washed && plate.executed_coverage.lower > 0.995 && plate.in_contact == plate.waypoints);
    assert!(report.findings.is_empty(), "{:?}", report.findings);
}

#[test]
fn a_hovering_flange_washes_nothing() {
    let report = judged(|s| {
        s.tool.length_m = 0.0;
        s.wash.height_m = 0.05;
        s.wash.clearance_m = 0.0;
        s.control.dt_s = 10.0;
    });
    assert_ne!(report.verdict, Verdict::Washed);
    assert!(!report.plates[0].washed && report.plates[0].in_contact == 0);
    assert!(
        report.plates[0].executed_coverage.fraction > 0.99,
        "seen from above it would"
    );
    assert!(
        report
            .findings
            .iter()
            .any(|f| matches!(f, JobFinding::NoContact { tool: false, .. }))
    );
    assert!(report.headline.contains("off the plate"), "{}", report.headline);
    // With a tool that hovers 2 mm too high, the same.
    let report = judged(|s| s.wash.height_m = 0.002);
    assert!(!report.plates[0].washed, "{}", report.headline);
}

#[test]
fn limits_that_are_broken_are_named_with_their_time() {
    let report = judged(|s| s.control.dt_s = 0.1);
    assert_eq!(report.verdict, Verdict::NotVerified);
    assert_eq!(report.headline, "NOT WASHED: 1 of 1 plate washed; joint limits broken.");
    let worst = &report.executed.violations[0];
    assert_eq!(
        (worst.kind, worst.who.as_str()),
        (ViolationKind::Acceleration, "joint_1")
    );
    assert!(worst.worst > worst.limit && worst.t_end_s > worst.t_start_s);
}

#[test]
fn too_little_clearance_names_every_pair() {
    let report = judged(|s| s.wash.clearance_m = 0.04);
    assert_eq!(report.verdict, Verdict::Infeasible);
    assert_eq!(
        report.headline,
        "NOT WASHED: 0 of 1 plate washed; too little clearance."
    );
    let mut pairs: Vec<_> = report.planned.violations.iter().map(|v| v.who.as_str()).collect();
    pairs.dedup();
    assert!(
        pairs.contains(&"link_4 – handle") && pairs.contains(&"handle – plate 0"),
        "{pairs:?}"
    );
    for v in &report.planned.violations {
        assert!(v.kind == ViolationKind::Clearance && v.worst < 0.04);
    }
}

#[test]
fn a_plate_out_of_reach_is_infeasible() {
    let report = judged(|s| s.layout.positions_m = Some(vec![[0.55, 0.0]]));
    assert_eq!(report.verdict, Verdict::Infeasible);
    let plate = &report.plates[0];
    let worst = plate.worst_unreached.unwrap();
    assert!(plate.reached < plate.waypoints && worst.position_error_m > 1e-3);
    assert!(report.headline.contains("out of reach"));
}

#[test]
fn too_little_coverage_is_not_washed() {
    let report = judged(|s| s.wash.turns = 1.0);
    assert!(!report.plates[0].washed);
    assert!(report.headline.contains("of a plate covered"), "{}", report.headline);
}

#[test]
fn a_control_law_that_diverges_is_an_error() {
    let mut scenario = good();
    scenario.control.law = Some(ControlLawName::Paper);
    (scenario.control.kp, scenario.control.dt_s) = (1e6, 10.0);
    let Err(PlanError::Tracking(error)) = Job::run(&scenario) else {
        panic!("it diverges")
    };
    assert!(matches!(error, TrackingError::Divergence { .. }));
    assert!(error.to_string().contains("control.kp"), "{error}");
}

#[test]
fn segments_begin_with_the_step_from_the_start_and_follow_each_other() {
    let job = Job::run(&good()).unwrap();
    let segments = plan::segments(&job);
    let kinds: Vec<_> = segments.iter().map(|s| s.kind.name()).collect();
    assert_eq!(kinds, ["depart", "wash"]);
    assert_eq!((segments[0].t_start_s, segments[0].t_end_s), (0.0, 0.2));
    assert_eq!(segments[1].t_end_s, job.planned.duration_s());
}
