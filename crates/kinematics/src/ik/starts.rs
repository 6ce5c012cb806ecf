//! The listed starts: a fixed, evenly spread set of configurations within the limits.
//!
//! They are the first [`LISTED`] points of the six-dimensional Halton sequence ([`halton`]), scaled to the joint limits, with joints that turn further than ±π kept
//! within it; a joint of many turns has one turn, the nearest to ±π. For
//! a target, the starts whose frame is nearest to it are tried first: squared distance of the origins in
//! metres plus 0.05 of the squared chord between the rotations.

use crate::halton;
use crate::joints::JointVector;
use crate::model::Frame;
use crate::model::RobotModel;
use crate::rotation::RigidTransform;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::irb120::IRB120_URDF;
    use crate::urdf::MeshSource;

    /// Joint 6 of ±400° starts within ±180°; of limits on one side of 0 it starts all round, too, as near to 0 as they allow.
    #[test]
    fn joints_start_all_round() {
        let stated = "lower=\"-6.98132\" upper=\"6.98132\"";
        assert!(IRB120_URDF.contains(stated));
        for (limits, from) in [
            ("lower=\"-6.98132\" upper=\"6.98132\"", -PI),
            ("lower=\"-100\" upper=\"100\"", -PI),
            ("lower=\"0\" upper=\"100\"", 0.0),
            ("lower=\"-90\" upper=\"-60\"", -60.0 - 2.0 * PI),
        ] {
            let robot = RobotModel::from_urdf(&IRB120_URDF.replace(stated, limits), &MeshSource::none()).unwrap();
            let starts = Starts::new(&robot, &robot.last_link_frame());
            let shares: Vec<f64> = starts
                .entries()
                .iter()
                .map(|(q, _)| (q[5] - from) / (2.0 * PI))
                .collect();
            let [least, most] = [f64::min, f64::max].map(|of| shares.iter().copied().reduce(of).unwrap());
            let all_round = (0.0..0.02).contains(&least) && (0.98..=1.0).contains(&most);
            assert!(all_round, "{limits}: {least} {most}");
        }
    }
}
