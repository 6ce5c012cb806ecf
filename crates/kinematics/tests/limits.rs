//! Joint limits: margins, violations and the nearest point inside.

use platewash_kinematics::{AXES, JointLimits, JointVector};

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
    use std::f64::consts::PI;
    assert_eq!(limits().sampling_range(2), [-PI, PI]);
    assert_eq!(limits().sampling_range(3), [0.5, 0.75]);
}
