//! The listed starts: a fixed, evenly spread set of configurations within the limits.
//!
//! They are the first [`LISTED`] points of the six-dimensional Halton sequence ([`halton`]), scaled to the joint limits, with joints that turn further than ±π kept within it. For
//! a target, the starts whose frame is nearest to it are tried first: squared distance of the origins in
//! metres plus 0.05 of the squared chord between the rotations.

use crate::model::Frame;
use crate::rotation::RigidTransform;
use crate::{JointVector, RobotModel, halton};
use std::f64::consts::PI;

/// Length of the list.
pub const LISTED: usize = 256;

const ROTATION_WEIGHT: f64 = 0.05;

/// List of starts for one frame of one arm.
#[derive(Debug, Clone)]
pub(crate) struct Starts {
    entries: Vec<(JointVector, RigidTransform)>,
}

impl Starts {
    pub fn new(robot: &RobotModel, frame: &Frame) -> Self {
        let entry = |k| {
            let q = scaled(robot, k);
            (q, robot.fk(&q).rigid(frame))
        };
        Self {
            entries: (1..=LISTED as u32).map(entry).collect(),
        }
    }

    /// Returns all starts, with the frame's pose at each.
    pub fn entries(&self) -> &[(JointVector, RigidTransform)] {
        &self.entries
    }

    /// Returns the `count` starts nearest to the target, nearest first (ties by position in the list).
    pub fn nearest(&self, target: &RigidTransform, count: usize) -> Vec<JointVector> {
        let ranked = self.entries.iter().map(|(q, pose)| (distance(pose, target), q));
        let mut ranked: Vec<_> = ranked.collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        ranked.into_iter().take(count).map(|(_, q)| *q).collect()
    }
}

/// Distance of a pose from the target: squared metres plus a weighted squared chord.
pub(crate) fn distance(pose: &RigidTransform, target: &RigidTransform) -> f64 {
    let chord = (pose.rotation - target.rotation).norm_squared();
    (pose.translation - target.translation).norm_squared() + ROTATION_WEIGHT * chord
}

/// Returns point `k` of the sequence within the arm's limits \[rad\].
fn scaled(robot: &RobotModel, k: u32) -> JointVector {
    let shares = halton::point(k);
    JointVector::from_fn(|joint, _| {
        let [lower, upper] = robot.limits().sampling_range(joint);
        let within_a_turn = [lower.max(-PI), upper.min(PI)];
        let [lower, upper] = if within_a_turn[0] < within_a_turn[1] && !robot.limits().is_wide(joint) {
            within_a_turn
        } else {
            [lower, upper]
        };
        lower + (upper - lower) * shares[joint]
    })
}
