//! Bounds on the arm's reach.

use nalgebra::Vector3;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, RobotModel};
use proptest::prelude::*;
use std::f64::consts::PI;

fn arms() -> [RobotModel; 3] {
    let other = |urdf| RobotModel::from_urdf(urdf, &MeshSource::none()).unwrap();
    [
        RobotModel::irb120().unwrap(),
        other(include_str!("fixtures/ur5_lengths.urdf")),
        other(include_str!("fixtures/kr5_lengths.urdf")),
    ]
}

proptest! {
    #[test]
    fn no_configuration_is_beyond_the_bounds(
        q in prop::array::uniform6(-PI..PI),
        offset in prop::array::uniform3(-0.3..0.3f64),
    ) {
        let offset = RigidTransform { translation: Vector3::from(offset), ..RigidTransform::identity() };
        for arm in arms() {
            let tool = arm.last_link_frame().offset(&offset);
            for frame in [arm.wrist_frame(), arm.last_link_frame(), tool] {
                let at = arm.fk(&JointVector::from(q)).rigid(&frame).translation;
                for (centre, bound_m) in [arm.reach_bound(&frame), arm.sharp_reach_bound(&frame)] {
                    prop_assert!((at - centre.coords).norm() <= bound_m + 1e-12);
                }
            }
        }
    }
}

/// The centre of the wrist gets as far from joint 2 as the upper arm and the way from joint 3 are long together.
#[test]
fn the_sharp_bound_of_the_wrist_is_reached() {
    let arm = RobotModel::irb120().unwrap();
    let wrist = arm.wrist_frame();
    let (centre, bound_m) = arm.sharp_reach_bound(&wrist);
    let expected_m = 0.27 + (0.07_f64 * 0.07 + 0.302 * 0.302).sqrt();
    assert!((bound_m - expected_m).abs() < 1e-9, "{bound_m}");
    assert!((centre.coords - Vector3::new(0.0, 0.0, 0.29)).norm() < 1e-9, "{centre}");
    let straight = -(0.302_f64 / 0.07).atan();
    let at = arm
        .fk(&JointVector::new(0.3, 0.4, straight, 1.0, 0.5, 2.0))
        .rigid(&wrist)
        .translation;
    assert!(((at - centre.coords).norm() - bound_m).abs() < 1e-9);
    assert!(arm.reach_bound(&wrist).1 > bound_m + 0.05);
}
