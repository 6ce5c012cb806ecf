//! Forward kinematics: joint positions in, the pose of every frame out.
//!
//! The chain is folded once, when the model is built: each joint gets a frame whose z axis is the joint's
//! axis, and the constant transforms between neighbours absorb everything fixed. At run time a joint costs
//! one sine–cosine pair and one product,
//!
//! `T_base_i = T_base_{i−1} · F_i · Rot_z(q_i)`,
//!
//! the product of exponentials written in local frames (Lynch & Park, *Modern Robotics*, ch. 4).

use crate::frame::Frame;
use crate::model::RobotModel;
use crate::rotation::Rigid;
use crate::trig::{Separate, sin_cos_lanes};
use crate::{AXES, JointVector, Pose};
use nalgebra::Vector3;

/// Poses of the seven bodies at one configuration, in the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyPoses {
    /// `T_base_body`; index 0 is the identity, index i the folded frame of joint i (z = its axis).
    pub(crate) bodies: [Rigid; AXES + 1],
}

impl BodyPoses {
    /// `T_base_body`: the identity for the base, then for each joint a frame on its axis, z along it.
    #[must_use]
    pub fn bodies(&self) -> &[Rigid; AXES + 1] {
        &self.bodies
    }

    /// Directions of the six joint axes, base frame, unit length.
    #[must_use]
    pub fn joint_axes(&self) -> [Vector3<f64>; AXES] {
        std::array::from_fn(|i| self.bodies[i + 1].rotation.column(2).into_owned())
    }

    /// `T_base_frame` as matrix and vector.
    #[inline]
    #[must_use]
    pub fn rigid(&self, frame: &Frame) -> Rigid {
        self.bodies[frame.body].then(&frame.offset)
    }

    /// `T_base_frame`.
    #[must_use]
    pub fn pose(&self, frame: &Frame) -> Pose {
        Pose::from(&self.rigid(frame))
    }
}

impl RobotModel {
    /// Poses of all bodies at the joint positions `q` \[rad\]. Limits are not checked; NaN in, NaN out.
    #[must_use]
    pub fn fk(&self, q: &JointVector) -> BodyPoses {
        // All six at once: the lanes have the bits of `sin_cos`, at less than half its cost.
        let (sines, cosines) = sin_cos_lanes::<Separate, AXES>(q.as_ref());
        let mut bodies = [Rigid::identity(); AXES + 1];
        for (i, folded) in self.folded().iter().enumerate() {
            bodies[i + 1] = bodies[i].then(folded).turned_about_z(sines[i], cosines[i]);
        }
        BodyPoses { bodies }
    }

    /// Pose `T_base_frame` of one frame at `q` \[rad\].
    #[must_use]
    pub fn pose(&self, q: &JointVector, frame: &Frame) -> Pose {
        self.fk(q).pose(frame)
    }
}
