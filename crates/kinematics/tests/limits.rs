//! Joint limits: margins, violations and the nearest point inside.

use platewash_kinematics::limits::WIDE_RAD;
use platewash_kinematics::{AXES, JointLimits, JointVector};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn limits() -> JointLimits {
    JointLimits {
        lower: JointVector::new(-1.0, -2.0, f64::NEG_INFINITY, 0.5, -1.0, -1.0),
        upper: JointVector::new(1.0, 3.0, f64::INFINITY, 0.75, 1.0, 1.0),
        velocity: JointVector::repeat(1.0),
        effort: [None; AXES],
        acceleration: [None; AXES],
        jerk: [None; AXES],
        is_soft: [[false; 2]; AXES],
    }
}

#[test]
fn margins_are_signed_distances_to_the_nearer_limit() {
    let q = JointVector::new(0.25, 3.5, 100.0, 0.625, -1.0, f64::NAN);
    let margins = limits().margins(&q);
    assert_eq!(margins[0], 0.75);
    assert_eq!(margins[1], -0.5);
    assert_eq!(margins[2], f64::INFINITY);
    assert_eq!(margins[3], 0.125);
    assert_eq!(margins[4], 0.0);
}

#[test]
fn nan_is_never_inside() {
    let mut q = JointVector::new(0.0, 0.0, 0.0, 0.6, 0.0, 0.0);
    assert!(limits().contain(&q));
    assert_eq!(limits().violation(&q), None);
    q[5] = f64::NAN;
    assert!(!limits().contain(&q));
    assert_eq!(limits().violation(&q).map(|v| v.joint), Some(5));
}

#[test]
fn clamp_returns_the_nearest_point_inside() {
    let q = limits().clamp(&JointVector::new(9.0, -9.0, 9.0, 0.0, 0.0, 0.0));
    assert_eq!(q, JointVector::new(1.0, -2.0, 9.0, 0.5, 0.0, 0.0));
    assert!(limits().contain(&q));
}

#[test]
fn a_continuous_joint_is_sampled_over_one_turn() {
    assert_eq!(limits().sampling_range(2), [-PI, PI]);
    assert_eq!(limits().sampling_range(3), [0.5, 0.75]);
}

/// Limits of joint 1 \[rad\], and its range around two positions \[rad\].
fn range(lower: f64, upper: f64, positions: [f64; 2]) -> [f64; 2] {
    let mut limits = limits();
    (limits.lower[0], limits.upper[0]) = (lower, upper);
    limits.sampling_range_around(0, positions)
}

#[test]
fn a_joint_of_many_turns_is_sampled_over_one_turn() {
    for (lower, upper, expected) in [
        (-6.98, 6.98, [-6.98, 6.98]),
        (-100.0, 100.0, [-PI, PI]),
        (0.0, 100.0, [0.0, TAU]),
        (-100.0, -80.0, [-80.0 - TAU, -80.0]),
        (7.0, f64::INFINITY, [7.0, 7.0 + TAU]),
    ] {
        assert_eq!(range(lower, upper, [0.0; 2]), expected, "{lower} {upper}");
    }
    assert_eq!(range(-100.0, 100.0, [60.0, 62.0]), [61.0 - PI, 61.0 + PI]);
    assert_eq!(range(-100.0, 100.0, [-1.0, 20.0]), [-1.0, 20.0]);
    assert_eq!(range(-100.0, 100.0, [100.0; 2]), [100.0 - TAU, 100.0]);
    assert_eq!(range(-6.0, 6.0, [5.0; 2]), [-6.0, 6.0]);
}

#[test]
fn a_position_near_a_limit_is_turned_inside() {
    let turned = |lower: f64, upper: f64, position: f64| {
        let mut limits = limits();
        (limits.lower[0], limits.upper[0]) = (lower, upper);
        limits.turned_inside(0, position)
    };
    assert_eq!(turned(-100.0, 100.0, 99.0), Some(99.0 - TAU));
    assert_eq!(turned(-100.0, 100.0, -99.0), Some(-99.0 + TAU));
    assert_eq!(turned(-100.0, 100.0, 95.0), Some(95.0));
    assert_eq!(turned(0.0, 100.0, 0.0), Some(TAU));
    assert_eq!(turned(-100.0, -90.0, 0.0), Some(-15.0 * TAU));
    assert_eq!(turned(f64::NEG_INFINITY, f64::INFINITY, 7e3), Some(7e3));
    assert_eq!(turned(-3.0, 3.0, 0.0), None);
    assert_eq!(turned(-3.0, 4.0, 2.0), None);
}

proptest! {
    /// Between the limits, with both positions in it, and every angle; beyond what lies between them no more than a turn.
    #[test]
    fn the_sampled_turn_holds_every_pose_and_both_positions(
        lower in -100.0..100.0f64, width in 0.1..200.0f64, shares in prop::array::uniform2(0.0..1.0f64),
    ) {
        let upper = lower + width;
        let positions = shares.map(|share| (lower + share * width).min(upper));
        let [from, to] = range(lower, upper, positions);
        prop_assert!(lower <= from && to <= upper);
        prop_assert!(positions.iter().all(|at| (from..=to).contains(at)));
        prop_assert!(to - from >= TAU.min(width) - 1e-12);
        let between = (positions[1] - positions[0]).abs();
        prop_assert!(to - from <= between.max(WIDE_RAD.min(width)) + 1e-12, "{from} {to}");
    }
}
