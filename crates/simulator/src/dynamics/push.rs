//! A force on the tool.

use super::model::DynamicsModel;
use nalgebra::{Point3, Vector3};
use platewash_kinematics::{Frame, JointVector};

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
