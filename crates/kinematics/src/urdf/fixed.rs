//! Joints of a description that a caller holds still, such as those of a gripper.

use crate::rotation::RigidTransform;
use crate::trig::sin_cos;
use crate::urdf::error::UrdfError;
use crate::{AXES, urdf::unit_axis};
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;
use urdf_rs::{Joint, JointType, Robot};

/// Positions of joints that do not move, by name \[rad, or m for a prismatic joint\].
pub type FixedJoints = BTreeMap<String, f64>;

/// Joints that were fixed: their positions, and the displacement behind each one's origin.
#[derive(Default)]
pub(crate) struct Fixed {
    pub positions: FixedJoints,
    pub displacements: BTreeMap<String, RigidTransform>,
}

/// Fixes joints at stated positions, with the joints that mimic them, the outermost first, as long as more than six joints move. A joint
/// that is left moving is one of the six axes. Names that the description does not have are ignored.
///
/// # Errors
/// [`UrdfError`] for a position that is not finite or beyond the joint's limits, for a joint that follows another one, and for an axis
/// that is zero.
pub(crate) fn fix(robot: &mut Robot, stated: &FixedJoints) -> Result<Fixed, UrdfError> {
    let mut fixed = Fixed::default();
    let mut outermost_first: Vec<usize> = (0..robot.joints.len()).collect();
    outermost_first.sort_by_key(|index| std::cmp::Reverse(depth(robot, *index)));
    for index in outermost_first {
        let joint = &robot.joints[index];
        let Some(&position) = stated.get(&joint.name).filter(|_| joint.joint_type != JointType::Fixed) else {
            continue;
        };
        let moving = robot.joints.iter().filter(|joint| joint.joint_type != JointType::Fixed);
        if moving.count() <= AXES {
            break;
        }
        check(joint, position)?;
        let leader = joint.name.clone();
        for joint in &mut robot.joints {
            let position = match &joint.mimic {
                Some(mimic) if mimic.joint == leader => {
                    mimic.multiplier.unwrap_or(1.0) * position + mimic.offset.unwrap_or(0.0)
                }
                _ if joint.name == leader => position,
                _ => continue,
            };
            let displacement = displacement(joint, position)?;
            fixed.positions.insert(joint.name.clone(), position);
            fixed.displacements.insert(joint.name.clone(), displacement);
            joint.joint_type = JointType::Fixed;
            joint.mimic = None;
        }
    }
    Ok(fixed)
}

/// Number of joints between a joint and the root; at most that of all, if they form a ring.
fn depth(robot: &Robot, index: usize) -> usize {
    let mut link = &robot.joints[index].parent.link;
    for depth in 0..robot.joints.len() {
        match robot.joints.iter().find(|joint| joint.child.link == *link) {
            Some(above) => link = &above.parent.link,
            None => return depth,
        }
    }
    robot.joints.len()
}

fn check(joint: &Joint, position: f64) -> Result<(), UrdfError> {
    let (name, limit) = (joint.name.clone(), &joint.limit);
    if let Some(mimic) = &joint.mimic {
        let follows = mimic.joint.clone();
        return Err(UrdfError::FixedFollower { joint: name, follows });
    }
    let is_limited = joint.joint_type != JointType::Continuous && [limit.lower, limit.upper] != [0.0; 2];
    if !position.is_finite() || is_limited && !(limit.lower..=limit.upper).contains(&position) {
        return Err(UrdfError::FixedBeyond {
            joint: name,
            position,
            lower: limit.lower,
            upper: limit.upper,
        });
    }
    Ok(())
}

/// Displacement of a joint at a position, in its own frame.
fn displacement(joint: &Joint, position: f64) -> Result<RigidTransform, UrdfError> {
    match joint.joint_type {
        JointType::Prismatic => Ok(RigidTransform {
            rotation: Matrix3::identity(),
            translation: unit_axis(joint)? * position,
        }),
        JointType::Revolute | JointType::Continuous => {
            // Rodrigues' formula.
            let (axis, (sin, cos)) = (unit_axis(joint)?, sin_cos(position));
            Ok(RigidTransform {
                rotation: Matrix3::identity() * cos + axis.cross_matrix() * sin + axis * axis.transpose() * (1.0 - cos),
                translation: Vector3::zeros(),
            })
        }
        _ => Err(UrdfError::JointKind {
            joint: joint.name.clone(),
            kind: format!("{:?}", joint.joint_type).to_lowercase(),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::irb120::IRB120_URDF;
    use crate::urdf::MeshSource;
    use crate::{JointVector, RobotModel};

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
}
