//! When a run counts as washed, and what breaks it: one good job and single changes of it.

use nalgebra::UnitQuaternion;
use platewash_bodies::job::{End, JobError};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_paper::cubic::Interpolation;
use platewash_paper::report::{PaperFinding, ViolationKind};
use platewash_paper::settings::IkSeed;
use platewash_paper::tracking::TrackingError;
use platewash_paper::{PaperError, PaperJob, PaperPart, PaperReport, WorkError, run};
use platewash_simulator::ControlError;
use platewash_workcell::job::TermsError;
use platewash_workcell::layout::{Layout, base_footprint, check_explicit};
use platewash_workcell::simulation::ControlLawName;
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::verdict::Verdict;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Where the arm starts: over the centre of the plate.
const START_DEG: [f64; 6] = [0.0, 39.507074, 26.156277, 0.0, 24.336649, 0.0];

fn plates_at(arm: &RobotModel, centres_m: &[[f64; 2]]) -> Layout {
    let part = PaperPart::Appendix;
    check_explicit(
        centres_m,
        None,
        &part.spacing(),
        &part.geometry(),
        Some(&base_footprint(arm)),
    )
    .unwrap()
}

/// One plate in front of the arm, a 150 mm tool on its surface, from a start over its centre, slowly and exactly.
fn good() -> PaperJob {
    let arm = Arc::new(RobotModel::irb120().unwrap());
    let layout = plates_at(&arm, &[[0.36, 0.0]]);
    let mut job = PaperJob::of_part(PaperPart::Appendix, arm, layout, 1).unwrap();
    job.start_rad = JointVector::from(START_DEG).map(f64::to_radians);
    with_tool(&mut job, 0.15);
    let settings = &mut job.settings;
    (settings.spiral.points, settings.spiral.turns) = (400, 4.0);
    (settings.spiral.radius_m, settings.spiral.closing_ring) = (0.124, true);
    (settings.height_m, settings.ik.seed) = (0.0, IkSeed::Previous);
    settings.transit.interpolation = Interpolation::C2Spline;
    job.requirements.clearance_m = 0.01;
    (job.simulation.law, job.simulation.control.dt_s) = (ControlLawName::Exact, 0.2);
    job
}

/// Gives the arm a tool of a length \[m\].
fn with_tool(job: &mut PaperJob, length_m: f64) {
    job.workcell.tool = Tool::from(StraightTool {
        length_m,
        ..StraightTool::default()
    });
    let (tool, obstacles) = (&job.workcell.tool, &job.workcell.obstacles);
    job.workcell.exclusions = platewash_bodies::clearance::exclusions(&job.arm, tool, obstacles).unwrap();
}

fn judged(change: impl FnOnce(&mut PaperJob)) -> PaperReport {
    let mut job = good();
    change(&mut job);
    run(&job).unwrap().report().unwrap()
}

#[test]
fn a_plate_that_is_covered_clear_and_touched_is_washed() {
    let report = judged(|_| ());
    assert_eq!(
        report.headline,
        "SWEPT: 1 of 1 plate, every limit kept; contact was not judged."
    );
    assert_eq!(report.verdict, Verdict::Swept);
    let plate = &report.plates[0];
    assert!(plate.washed && plate.executed_coverage.lower > 0.995 && plate.in_contact == plate.waypoints);
    assert!(report.findings.is_empty(), "{:?}", report.findings);
}

#[test]
fn a_tilted_plate_is_measured_in_its_own_plane() {
    let turned = |[roll, pitch, yaw]: [f64; 3]| {
        let report = judged(|job| {
            let pose = &mut job.layout.plates[0].pose;
            pose.rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
            // An upright plate would stand in the floor.
            job.workcell.obstacles.clear();
            with_tool(job, 0.15);
        });
        report.plates[0].executed_coverage
    };
    // Around its axis nothing changes; of an upright plate the level spiral sweeps a stripe as wide as the sponge.
    assert!(turned([0.0, 0.0, 1.0]).lower > 0.995);
    let rim_m = good().layout.plates[0].rim_m();
    let stripe = 2.0 * 2.0 * rim_m * 0.025 / (std::f64::consts::PI * rim_m * rim_m);
    for upright in [[FRAC_PI_2, 0.0, 0.0], [0.0, -FRAC_PI_2, 0.0]] {
        let swept = turned(upright);
        assert!(
            swept.upper <= stripe && swept.lower > 0.9 * stripe,
            "{swept:?} for about {stripe}"
        );
    }
}

#[test]
fn a_hovering_flange_washes_nothing() {
    let report = judged(|s| {
        with_tool(s, 0.0);
        s.settings.height_m = 0.05;
        s.requirements.clearance_m = 0.0;
        s.simulation.control.dt_s = 10.0;
    });
    assert_ne!(report.verdict, Verdict::Swept);
    assert!(!report.plates[0].washed && report.plates[0].in_contact == 0);
    assert!(
        report.plates[0].executed_coverage.fraction > 0.99,
        "seen from above it would"
    );
    assert!(
        report
            .findings
            .iter()
            .any(|f| matches!(f, PaperFinding::NoContact { tool: false, .. }))
    );
    assert!(report.headline.contains("off the plate"), "{}", report.headline);
    // Nor does a tool that hovers 2 mm too high.
    let report = judged(|s| s.settings.height_m = 0.002);
    assert!(!report.plates[0].washed, "{}", report.headline);
}

#[test]
fn names_broken_limits_with_their_time() {
    let report = judged(|s| s.simulation.control.dt_s = 0.1);
    assert_eq!(report.verdict, Verdict::NotVerified);
    assert_eq!(
        report.headline,
        "SWEPT, LIMITS BROKEN: 1 of 1 plate swept; joint limits broken."
    );
    let worst = &report.executed.violations[0];
    assert_eq!(
        (worst.kind, worst.who.as_str()),
        (ViolationKind::Acceleration, "joint_1")
    );
    assert!(worst.worst > worst.limit && worst.t_end_s > worst.t_start_s);
}

#[test]
fn too_little_clearance_names_every_pair() {
    let report = judged(|s| s.requirements.clearance_m = 0.04);
    assert_eq!(report.verdict, Verdict::Infeasible);
    assert_eq!(report.headline, "NOT SWEPT: 0 of 1 plate swept; too little clearance.");
    let mut pairs: Vec<_> = report.planned.violations.iter().map(|v| v.who.as_str()).collect();
    pairs.dedup();
    assert!(
        pairs.contains(&"link_4 – handle") && pairs.contains(&"handle – plate 1"),
        "{pairs:?}"
    );
    for v in &report.planned.violations {
        assert!(v.kind == ViolationKind::Clearance && v.worst < 0.04);
    }
}

#[test]
fn a_plate_out_of_reach_is_infeasible() {
    let report = judged(|s| s.layout = plates_at(&s.arm, &[[0.55, 0.0]]));
    assert_eq!(report.verdict, Verdict::Infeasible);
    let plate = &report.plates[0];
    let worst = plate.worst_unreached.unwrap();
    assert!(plate.reached < plate.waypoints && worst.position_error_m > 1e-3);
    assert!(report.headline.contains("out of reach"));
}

#[test]
fn too_little_coverage_is_not_washed() {
    let report = judged(|s| s.settings.spiral.turns = 1.0);
    assert!(!report.plates[0].washed);
    assert!(report.headline.contains("of a plate swept"), "{}", report.headline);
}

#[test]
fn a_control_law_that_diverges_is_an_error() {
    let mut job = good();
    job.simulation.law = ControlLawName::Paper;
    (job.simulation.control.kp, job.simulation.control.dt_s) = (1e6, 10.0);
    let Err(PaperError::Tracking(error)) = run(&job) else {
        panic!("it diverges")
    };
    assert!(matches!(error, TrackingError::Divergence { joint: 0, .. }), "{error:?}");
    assert!(error.to_string().contains("smaller gains"), "{error}");
}

#[test]
fn rejects_unusable_jobs() {
    type Change = fn(&mut PaperJob);
    type Refusal = fn(&PaperError) -> bool;
    let cases: [(Change, Refusal); 7] = [
        (
            |j| j.simulation.law = ControlLawName::Pd,
            |e| {
                matches!(
                    e,
                    PaperError::Law(ControlError::NotKinematic {
                        law: ControlLawName::Pd
                    })
                )
            },
        ),
        (
            |j| j.start_rad[2] = 3.0,
            |e| matches!(e, PaperError::Job(JobError::Home { end: End::Start, violation }) if violation.joint == 2),
        ),
        (
            |j| j.layout.plates.clear(),
            |e| matches!(e, PaperError::Job(JobError::Terms(TermsError::PlateCount { found: 0 }))),
        ),
        (
            |j| j.workcell.arm.name = "other".to_owned(),
            |e| matches!(e, PaperError::Job(JobError::OtherArm { .. })),
        ),
        (
            |j| j.settings.spiral.turns = f64::NAN,
            |e| matches!(e, PaperError::Setting(s) if s.name == "spiral.turns"),
        ),
        (
            |j| j.settings.spiral.points = usize::MAX,
            |e| matches!(e, PaperError::Work(WorkError::Waypoints { plates: 1, .. })),
        ),
        (
            |j| j.settings.ik.position_tolerance_m = -1.0,
            |e| matches!(e, PaperError::IkSettings(s) if s.name == "position_tolerance_m"),
        ),
    ];
    for (k, (change, refusal)) in cases.into_iter().enumerate() {
        let mut job = good();
        change(&mut job);
        let error = run(&job).unwrap_err();
        assert!(refusal(&error), "case {k}: {error:?}");
        assert!(error.infeasibility().is_none());
    }
}

#[test]
fn segments_begin_with_the_step_from_the_start_and_follow_each_other() {
    let run = run(&good()).unwrap();
    let segments = run.segments();
    let kinds: Vec<_> = segments.iter().map(|s| s.kind.name()).collect();
    assert_eq!(kinds, ["depart", "wash"]);
    assert_eq!((segments[0].t_start_s, segments[0].t_end_s), (0.0, 0.2));
    assert_eq!(segments[1].t_end_s, run.planned.duration_s());
}
