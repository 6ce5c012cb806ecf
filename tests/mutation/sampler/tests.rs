//! The sampler's own parts against what they must give.

use crate::mutation::edit::good;
use crate::mutation::sampler::motion::pieces;
use crate::mutation::sampler::paths::Curve;
use crate::mutation::sampler::places;
use nalgebra::{UnitQuaternion, Vector3};
use platewash::Plate;
use platewash::motion::trajectory::SegmentKind;
use std::f64::consts::PI;

/// The curve of the first wash, on a plate that is turned by 1 rad, and points along it, as the planner evaluates them.
fn washed() -> (Curve, Vec<Vector3<f64>>) {
    let plan = &good()[0].plan;
    let path = &plan.wash_paths[0];
    let mut plate = plan.job.plates[path.plate];
    plate.pose.rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 1.0);
    let place = |k: u32| path.contact(&plate, path.curve.end() * f64::from(k) / 4000.0);
    let curve = Curve::new(&plate, path, SegmentKind::Wash).unwrap();
    (curve, (0..=4000).map(place).collect())
}

#[test]
fn speeds_and_accelerations_are_derivatives_of_positions() {
    for piece in pieces(&good()[1].plan.knots).iter().step_by(50) {
        let h = 1e-3 * piece.length_s;
        for share in [0.1, 0.5, 0.8] {
            let u = share * piece.length_s;
            let slope = (piece.position(u + h) - piece.position(u - h)) / (2.0 * h);
            let bend = (piece.speed(u + h) - piece.speed(u - h)) / (2.0 * h);
            assert!((slope - piece.speed(u)).amax() < 1e-5);
            assert!((bend - piece.acceleration(u)).amax() < 1e-6);
        }
        assert_eq!(piece.position(0.0), piece.q[0]);
        assert!((piece.position(piece.length_s) - piece.q[1]).amax() < 1e-15);
        assert!((piece.speed(piece.length_s) - piece.qd[1]).amax() < 1e-13);
    }
}

#[test]
fn a_path_on_its_wash_path_does_not_leave_it() {
    let (curve, path) = washed();
    assert!(curve.deviation(&path, 2e-4) < 1e-8);
}

#[test]
fn a_path_beside_its_wash_path_is_as_far_from_it() {
    let (curve, mut path) = washed();
    path.iter_mut().for_each(|p| p.z += 1.5e-4);
    assert!((curve.deviation(&path, 2e-4) - 1.5e-4).abs() < 1e-8);
    path[2000].z += 1e-3;
    assert!((curve.deviation(&path, 2e-4) - 1.15e-3).abs() < 1e-8);
}

#[test]
fn a_path_that_runs_back_or_ends_early_leaves_its_wash_path() {
    let (curve, mut path) = washed();
    assert!(curve.deviation(&path[..3990], 2e-4) > 1e-3);
    assert!(curve.deviation(&path[40..], 2e-4) > 1e-3);
    path[2000..2040].reverse();
    assert!(curve.deviation(&path, 2e-4) > 1e-3);
}

#[test]
fn a_ring_sweeps_its_share() {
    let plate = Plate::level_disc([0.3, -0.1, 0.0], 0.1, 0.02);
    let ring = |k: u32| {
        let angle = 2.0 * PI * f64::from(k) / 2000.0;
        [0.3 + 0.06 * angle.cos(), -0.1 + 0.06 * angle.sin()]
    };
    let path: Vec<_> = (0..2000).map(ring).collect();
    // Between the radii 40 and 80 mm of 100 mm.
    let expected = 0.64 - 0.16;
    assert!((places::swept_share(&plate, &path, 0.02) - expected).abs() < 4e-3);
    assert_eq!(places::swept_share(&plate, &[], 0.02), 0.0);
    assert_eq!(places::swept_share(&plate, &[[0.3, -0.1]], 0.2), 1.0);
}

#[test]
fn lines_stand_over_the_ends_of_their_wash_path() {
    let plan = &good()[0].plan;
    let path = &plan.wash_paths[1];
    let plate = &plan.job.plates[path.plate];
    let [start, end] = path.feet(plate);
    let up = Vector3::z() * path.lift_m;
    let line = |kind, at: f64| Curve::new(plate, path, kind).unwrap().at(at);
    for (found, expected) in [
        (line(SegmentKind::Approach, 0.0), start + up),
        (line(SegmentKind::Approach, path.lift_m), start),
        (line(SegmentKind::Retreat, 0.0), end),
        (line(SegmentKind::Retreat, path.lift_m), end + up),
    ] {
        assert!((found - expected).norm() < 1e-12, "{found} {expected}");
    }
    assert!(Curve::new(plate, path, SegmentKind::Transit).is_none());
}
