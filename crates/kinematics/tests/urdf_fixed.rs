//! Joints that are fixed at a position: grippers and what mimics them.

use nalgebra::Vector3;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::{MeshSource, UrdfError};
use platewash_kinematics::{JointVector, RobotModel};

/// The built-in arm with a finger that slides, one that follows it, and a swivel before them.
fn with_gripper() -> String {
    let joint = |name: &str, kind: &str, parent: &str, rest: &str| {
        format!(
            "<link name=\"{name}_link\"/><joint name=\"{name}\" type=\"{kind}\"><parent link=\"{parent}\"/><child link=\"{name}_link\"/>\
             <origin xyz=\"0 0 0.1\" rpy=\"0 1.5707963267948966 0\"/><axis xyz=\"0 1 0\"/><limit lower=\"-1\" upper=\"1\" velocity=\"1\"/>{rest}</joint>"
        )
    };
    let more = [
        joint("swivel", "revolute", "tool0", ""),
        joint("left", "prismatic", "swivel_link", ""),
        joint(
            "right",
            "prismatic",
            "swivel_link",
            "<mimic joint=\"left\" multiplier=\"-0.5\" offset=\"0.125\"/>",
        ),
    ];
    IRB120_URDF.replace("</robot>", &format!("{}</robot>", more.concat()))
}

fn load(stated: &[(&str, f64)]) -> Result<RobotModel, UrdfError> {
    let stated = stated.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect();
    RobotModel::from_urdf_with_fixed(&with_gripper(), &MeshSource::none(), &stated)
}

#[test]
fn grippers_stand_where_they_are_fixed() {
    let arm = load(&[("left", 0.5), ("swivel", 0.5), ("joint_6", 0.2)]).unwrap();
    let expected = [("left", 0.5), ("right", -0.125), ("swivel", 0.5)];
    let found: Vec<_> = arm
        .fixed_joints()
        .iter()
        .map(|(name, at)| (name.as_str(), *at))
        .collect();
    assert_eq!(found, expected, "joint 6 stays an axis");
    let poses = arm.fk(&JointVector::repeat(0.3));
    let at = |name: &str| poses.pose(&arm.frame(name).unwrap());
    let fingers = at("swivel_link").inverse() * at("left_link");
    assert!(
        (fingers.translation.vector - Vector3::new(0.0, 0.5, 0.1)).norm() < 1e-12,
        "{fingers}"
    );
    let fingers = at("swivel_link").inverse() * at("right_link");
    assert!(
        (fingers.translation.vector - Vector3::new(0.0, -0.125, 0.1)).norm() < 1e-12,
        "{fingers}"
    );
    let turned = at("tool0").inverse() * at("swivel_link");
    let by_hand = nalgebra::Rotation3::from_euler_angles(0.0, std::f64::consts::FRAC_PI_2, 0.0)
        * nalgebra::Rotation3::from_axis_angle(&Vector3::y_axis(), 0.5);
    assert!((turned.rotation.to_rotation_matrix().matrix() - by_hand.matrix()).norm() < 1e-12);
    assert_ne!(arm.sha256(), load(&[("left", 0.02), ("swivel", 0.5)]).unwrap().sha256());
}

#[test]
fn refuses_positions_that_no_joint_can_have() {
    let error = |stated: &[(&str, f64)]| load(stated).unwrap_err().to_string();
    assert!(
        error(&[("left", 1.5), ("swivel", 0.0)]).contains("joint 'left' is fixed at 1.5, beyond its limits -1 … 1")
    );
    assert!(error(&[("right", 0.0), ("swivel", 0.0)]).contains("mimics joint 'left'"));
    assert!(error(&[("left", f64::NAN)]).contains("NaN"));
    assert!(error(&[("left", 0.0)]).contains("six revolute"));
}
