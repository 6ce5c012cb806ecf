//! A force on the tool; how the joints move it.

use super::model::DynamicsModel;
use nalgebra::{Point3, Vector3};
use platewash_kinematics::rotation::Rigid;
use platewash_kinematics::{AXES, Frame, JointVector};

impl DynamicsModel {
    /// Torques Jᵀ f \[N·m\] by which a force \[N\], base frame, on the origin of `frame` drives the joints at `q` \[rad\]:
    /// τ_j = z_j · ((p − p_j) × f) for the joints that move the frame.
    #[must_use]
    pub fn torque_of_force(&self, q: &JointVector, frame: &Frame, force: &Vector3<f64>) -> JointVector {
        let poses = self.poses(q);
        let Some(last) = frame.body().checked_sub(1) else {
            return JointVector::zeros();
        };
        let at = poses[last].then(frame.on_body()).translation;
        JointVector::from_fn(|j, _| {
            let axis = poses[j].rotation.column(2);
            if j <= last {
                axis.dot(&(at - poses[j].translation).cross(force))
            } else {
                0.0
            }
        })
    }

    /// Origin of `frame` at `q` \[rad\], base frame \[m\].
    #[must_use]
    pub fn position(&self, q: &JointVector, frame: &Frame) -> Point3<f64> {
        match frame.body().checked_sub(1) {
            Some(body) => self.poses(q)[body].then(frame.on_body()).translation.into(),
            None => frame.on_body().translation.into(),
        }
    }
}

/// A frame on the arm, and how the joints move it.
#[derive(Debug, Clone, Copy)]
pub struct FrameMotion {
    /// `T_base_frame`.
    pub pose: Rigid,
    /// z_j: axes of the joints that move it, zeros of the others.
    axes: [Vector3<f64>; AXES],
    /// z_j × (p − p_j): velocity of its origin when joint j turns at 1 rad/s \[m\].
    levers: [Vector3<f64>; AXES],
}

impl FrameMotion {
    /// Torques of a force \[N\] at the origin and a moment \[N·m\], base frame \[N·m\].
    #[inline]
    #[must_use]
    pub fn torque(&self, force: &Vector3<f64>, moment: &Vector3<f64>) -> JointVector {
        JointVector::from_fn(|j, _| self.levers[j].dot(force) + self.axes[j].dot(moment))
    }

    /// Velocity of the origin \[m/s\] and angular velocity \[rad/s\], base frame, at joint speeds `qd` \[rad/s\].
    #[inline]
    #[must_use]
    pub fn twist(&self, qd: &JointVector) -> [Vector3<f64>; 2] {
        let sum = |of: &[Vector3<f64>; AXES]| (0..AXES).fold(Vector3::zeros(), |sum, j| sum + of[j] * qd[j]);
        [sum(&self.levers), sum(&self.axes)]
    }
}

impl DynamicsModel {
    /// A frame at `q` \[rad\].
    #[must_use]
    pub fn frame_motion(&self, q: &JointVector, frame: &Frame) -> FrameMotion {
        let poses = self.poses(q);
        let count = frame.body().min(AXES);
        let pose = match count.checked_sub(1) {
            Some(last) => poses[last].then(frame.on_body()),
            None => *frame.on_body(),
        };
        let mut motion = FrameMotion {
            pose,
            axes: [Vector3::zeros(); AXES],
            levers: [Vector3::zeros(); AXES],
        };
        for (j, joint) in poses.iter().enumerate().take(count) {
            motion.axes[j] = joint.rotation.column(2).into_owned();
            motion.levers[j] = motion.axes[j].cross(&(pose.translation - joint.translation));
        }
        motion
    }
}
