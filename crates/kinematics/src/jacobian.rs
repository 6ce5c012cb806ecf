//! Geometric Jacobian and manipulability.

use crate::fk::BodyPoses;
use crate::frame::Frame;
use nalgebra::Matrix6;

/// Geometric Jacobian: maps joint speeds \[rad/s\] to the twist (linear m/s, angular rad/s) of a frame.
pub type Jacobian = Matrix6<f64>;

/// The axes in which a twist is expressed. The point whose velocity it is stays the frame's origin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axes {
    /// Axes of the base frame.
    Base,
    /// Axes of the frame itself.
    Local,
}

impl BodyPoses {
    /// Geometric Jacobian of `frame`, twist of its origin in the given axes.
    ///
    /// Column i is `(z_i × (p − p_i), z_i)` for the joints between the base and the frame's body, and zero
    /// for the joints beyond it (Siciliano et al., *Robotics*, eq. 3.30).
    #[must_use]
    pub fn jacobian(&self, frame: &Frame, axes: Axes) -> Jacobian {
        let tip = self.rigid(frame);
        let mut jacobian = Jacobian::zeros();
        for (i, joint) in self.bodies[1..=frame.body()].iter().enumerate() {
            let z = joint.rotation.column(2).into_owned();
            let linear = z.cross(&(tip.translation - joint.translation));
            let (linear, angular) = match axes {
                Axes::Base => (linear, z),
                Axes::Local => (tip.rotation.tr_mul(&linear), tip.rotation.tr_mul(&z)),
            };
            jacobian.fixed_view_mut::<3, 1>(0, i).copy_from(&linear);
            jacobian.fixed_view_mut::<3, 1>(3, i).copy_from(&angular);
        }
        jacobian
    }
}

/// Manipulability `√det(J Jᵀ) = |det J|` (Yoshikawa 1985) \[m³, as three rows are lengths\]; 0 exactly at
/// a singularity.
#[must_use]
pub fn manipulability(jacobian: &Jacobian) -> f64 {
    jacobian.determinant().abs()
}
