//! The mass matrix: the composite-rigid-body algorithm (Featherstone 2008, §6.2), in one common frame.
//!
//! With S_i = (z_i, r_i × z_i) the joint's motion and Iᶜ_i the inertia of everything from body i outwards, taken as rigid,
//! M_ij = S_jᵀ Iᶜ_i S_i for j ≤ i: in a common frame Iᶜ_{i−1} = I_{i−1} + Iᶜ_i is a plain sum.

use super::model::DynamicsModel;
use platewash_kinematics::{AXES, JointVector};

/// The joint-space mass matrix M(q) \[kg·m²\], symmetric and positive definite.
pub type MassMatrix = nalgebra::Matrix6<f64>;

impl DynamicsModel {
    /// The joint-space mass matrix M(q) \[kg·m²\] at `q` \[rad\]; symmetric bit for bit.
    #[must_use]
    pub fn mass_matrix(&self, q: &JointVector) -> MassMatrix {
        let mut pass = self.pass(q);
        let mut matrix = MassMatrix::zeros();
        for i in (0..AXES).rev() {
            let composite = pass.bodies[i];
            let (moment, force) = composite.times(&pass.axes[i], &pass.moments[i]);
            for j in 0..=i {
                let entry = pass.axes[j].dot(&moment) + pass.moments[j].dot(&force);
                matrix[(i, j)] = entry;
                matrix[(j, i)] = entry;
            }
            if let Some(before) = i.checked_sub(1) {
                let body = &mut pass.bodies[before];
                body.mass += composite.mass;
                body.first_moment += composite.first_moment;
                body.inertia += composite.inertia;
            }
        }
        matrix
    }
}
