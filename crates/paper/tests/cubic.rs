//! The curves through waypoints: at rest at each of them, or with a continuous acceleration.

use nalgebra::Vector3;
use platewash_paper::cubic::{Interpolation, sample};
use proptest::prelude::*;

fn points() -> impl Strategy<Value = Vec<Vector3<f64>>> {
    let point = prop::array::uniform3(-1.0..1.0f64).prop_map(Vector3::from);
    prop::collection::vec(point, 2..9)
}

proptest! {
    #[test]
    fn both_curves_pass_every_waypoint_and_start_and_end_at_rest(points in points()) {
        let segments = points.len() - 1;
        for kind in [Interpolation::ZeroVelocity, Interpolation::C2Spline] {
            let fine = 1000;
            let curve = sample(&points, kind, segments * fine + 1);
            for (i, p) in points.iter().enumerate() {
                prop_assert!((curve[i * fine] - p).norm() < 1e-12);
            }
            let n = curve.len();
            prop_assert!((curve[1] - curve[0]).norm() < 1e-3 * 0.05);
            prop_assert!((curve[n - 1] - curve[n - 2]).norm() < 1e-3 * 0.05);
        }
    }

    #[test]
    fn the_papers_curve_stops_at_every_waypoint_and_the_spline_keeps_its_acceleration(points in points()) {
        prop_assume!(points.len() >= 3);
        let (segments, fine) = (points.len() - 1, 10_000);
        let h = 1.0 / fine as f64;
        let paper = sample(&points, Interpolation::ZeroVelocity, segments * fine + 1);
        let spline = sample(&points, Interpolation::C2Spline, segments * fine + 1);
        for i in 1..segments {
            let k = i * fine;
            prop_assert!((paper[k + 1] - paper[k - 1]).norm() / (2.0 * h) < 0.01);
            let second = |k: usize| (spline[k + 1] - spline[k] * 2.0 + spline[k - 1]) / (h * h);
            prop_assert!((second(k - 1) - second(k + 1)).norm() < 0.1, "acceleration jumps at waypoint {i}");
        }
    }
}

/// By hand: p(t) = a₃t³ + a₂t² + a₁t + a₀ between 0 and 1 at rest is 3t² − 2t³.
#[test]
fn one_segment_is_the_smooth_step() {
    let ends = [Vector3::zeros(), Vector3::new(1.0, -2.0, 0.5)];
    for kind in [Interpolation::ZeroVelocity, Interpolation::C2Spline] {
        let curve = sample(&ends, kind, 5);
        for (k, p) in curve.iter().enumerate() {
            let t = k as f64 / 4.0;
            assert!((p - ends[1] * (3.0 * t * t - 2.0 * t * t * t)).norm() < 1e-15);
        }
    }
}

#[test]
fn accepts_degenerate_input() {
    assert!(sample(&[], Interpolation::C2Spline, 5).is_empty());
    assert_eq!(sample(&[Vector3::x()], Interpolation::ZeroVelocity, 5), [Vector3::x()]);
}
