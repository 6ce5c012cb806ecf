//! Joints of a description that a caller holds still, such as those of a gripper.

use crate::joints::AXES;
use crate::rotation::RigidTransform;
use crate::trig::sin_cos;
use crate::urdf::error::UrdfError;
use crate::urdf::tree::unit_axis;
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

/// Fixes joints at stated positions, with the joints that mimic them, the outermost first, as long as more than six joints move that mimic
/// none. A joint that is left moving is one of the six axes. Names that the description does not have are ignored.
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
        let is_independent = |joint: &&Joint| joint.joint_type != JointType::Fixed && joint.mimic.is_none();
        if robot.joints.iter().filter(is_independent).count() <= AXES {
            break;
        }
        check(joint, position)?;
        let mut stopped = vec![(joint.name.clone(), position)];
        while let Some((name, position)) = stopped.pop() {
            for joint in &mut robot.joints {
                if joint.name == name {
                    fixed.displacements.insert(name.clone(), displacement(joint, position)?);
                    fixed.positions.insert(name.clone(), position);
                    joint.joint_type = JointType::Fixed;
                    joint.mimic = None;
                } else if let Some(mimic) = joint.mimic.as_ref().filter(|mimic| mimic.joint == name) {
                    let follows = mimic.multiplier.unwrap_or(1.0) * position + mimic.offset.unwrap_or(0.0);
                    stopped.push((joint.name.clone(), follows));
                }
            }
        }
    }
    let differs = |(joint, at): (&String, &f64)| fixed.positions.get(joint).is_some_and(|found| found != at);
    match stated.iter().find(|(joint, at)| differs((joint, at))) {
        Some((joint, _)) => Err(UrdfError::FixedFollowerElsewhere {
            joint: joint.clone(),
            found: fixed.positions[joint],
        }),
        None => Ok(fixed),
    }
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
