//! Files that are hardly plans: an error or a failed promise, soon, and never a panic.

use super::made::{good, irb120, resealed};
use crate::certificate::{CertificateVerdict, PromiseName, VerifyError, verify};
use crate::plan::Plan;
use platewash_kinematics::JointVector;
use platewash_workcell::layout::Plate;

fn changed(change: impl FnOnce(&mut Plan)) -> Result<crate::certificate::Certificate, VerifyError> {
    let mut plan = good();
    change(&mut plan);
    verify(&plan, &irb120())
}

#[track_caller]
fn fails(change: impl FnOnce(&mut Plan)) {
    let certificate = changed(change).unwrap();
    assert_eq!(certificate.verdict, CertificateVerdict::Fail);
    // Both forms can be written.
    assert!(certificate.to_string().starts_with("NOT CERTIFIED"));
    assert!(serde_json::to_string(&certificate).is_ok());
}

#[test]
fn knots_that_are_no_motion_are_refused() {
    let cut = |p: &mut Plan, n: usize| {
        p.knots.t_s.truncate(n);
        p.knots.q_rad.truncate(n);
        p.knots.qd_rad_s.truncate(n);
    };
    assert_eq!(changed(|p| cut(p, 0)), Err(VerifyError::NoMotion { found: 0 }));
    assert_eq!(changed(|p| cut(p, 1)), Err(VerifyError::NoMotion { found: 1 }));
    fails(|p| cut(p, 2));
    let knots = |change: fn(&mut Plan)| matches!(changed(change), Err(VerifyError::Knots(_)));
    assert!(knots(|p| p.knots.t_s.swap(5, 6)));
    assert!(knots(|p| p.knots.t_s[0] = 1e-3));
    assert!(knots(|p| p.knots.q_rad.truncate(9)));
    assert!(knots(|p| p.knots.q_rad[3][3] = f64::NAN));
    assert!(knots(|p| p.knots.qd_rad_s[3][3] = f64::INFINITY));
}

#[test]
fn huge_numbers_end_in_a_clear_word() {
    for size in [1e5, 1e150, 1e300, f64::MAX] {
        let found = changed(|p| p.knots.q_rad[77][2] = size);
        assert!(
            matches!(found, Err(VerifyError::TurnsTooFar { joint: 2, .. })),
            "{size}"
        );
    }
    assert!(matches!(
        changed(|p| p.knots.qd_rad_s[77][2] = 1e300),
        Err(VerifyError::TurnsTooFar { .. })
    ));
    fails(|p| p.knots.q_rad[77][2] = 9e3);
    fails(|p| p.knots.qd_rad_s[77] = JointVector::repeat(1e4));
    fails(|p| p.segments[1].t_end_s = 1e308);
    fails(|p| p.tip.position_m = [1e300; 3]);
    fails(|p| p.limits.tip_speed_m_s = 1e308);
    for wild in [1e300, -1e300, 1e9] {
        assert_eq!(
            changed(|p| p.plates[1].x_m = wild),
            Err(VerifyError::NoPlate { plate: 1 })
        );
    }
    assert_eq!(
        changed(|p| p.plates[0].radius_m = 0.0),
        Err(VerifyError::NoPlate { plate: 0 })
    );
    assert!(matches!(
        changed(|p| p.scenario.wash.turns = 1e12),
        Err(VerifyError::Scenario(_))
    ));
    assert!(matches!(
        changed(|p| p.scenario.tool.length_m = -1.0),
        Err(VerifyError::Scenario(_))
    ));
}

#[test]
fn wrong_counts_and_indices_fail() {
    fails(|p| p.segments.clear());
    fails(|p| p.tool_path.clear());
    fails(|p| p.order.clear());
    fails(|p| p.order = vec![usize::MAX, 1]);
    fails(|p| p.plates.clear());
    fails(|p| p.segments[1].plate = usize::MAX);
    fails(|p| p.tool_path[2].plate = 99);
    fails(|p| p.clearance_pairs.clear());
    fails(|p| p.segments.iter_mut().for_each(|s| s.t_end_s = s.t_start_s));
    fails(|p| p.scenario.job.program = crate::scenario::Program::Paper);
    let crowded = changed(|p| p.segments = vec![p.segments[0]; 1000]);
    assert!(matches!(crowded, Err(VerifyError::TooManySegments { found: 1000, .. })));
}

#[test]
fn shapes_that_are_no_curves_are_not_followed() {
    use crate::tool_path::Shape;
    let certificate = changed(|p| p.tool_path[2].shape = Shape::Free).unwrap();
    let broken: Vec<_> = certificate.broken().map(|p| p.name).collect();
    assert!(broken.contains(&PromiseName::ToolPath) && broken.contains(&PromiseName::StrokeDeviation));
    fails(|p| {
        p.tool_path[1].shape = Shape::Line {
            foot_m: [1e300; 3],
            normal: [0.0; 3],
            height_m: -1.0,
        }
    });
    for (radius_m, turns) in [(0.0, 3.0), (-1.0, 3.0), (1e300, 3.0), (0.1, 0.0), (0.1, 1e300)] {
        fails(|p| {
            if let Shape::Stroke { stroke, .. } = &mut p.tool_path[2].shape {
                (stroke.radius_m, stroke.turns) = (radius_m, turns);
            }
        });
    }
}

#[test]
fn a_thousand_plates_end_soon_and_more_are_refused() {
    let crowd = |count: usize| {
        move |p: &mut Plan| {
            let plate = |k: usize| Plate {
                x_m: 0.3 + 0.001 * k as f64,
                ..p.plates[0]
            };
            p.plates = (0..count).map(plate).collect();
            p.order = (0..count).collect();
        }
    };
    assert!(matches!(
        changed(crowd(1001)),
        Err(VerifyError::TooManyPlates { found: 1001, .. })
    ));
    fails(crowd(300));
}

#[test]
fn the_certificate_is_the_same_on_one_thread_and_on_many_and_survives_json() {
    let plan = resealed(good());
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| serde_json::to_string(&verify(&plan, &irb120()).unwrap()).unwrap())
    };
    let text = on(1);
    assert_eq!(text, on(4));
    let read: crate::certificate::Certificate = serde_json::from_str(&text).unwrap();
    assert_eq!(serde_json::to_string(&read).unwrap(), text);
}
