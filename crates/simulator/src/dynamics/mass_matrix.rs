//! Inertia of the arm at a configuration: the mass matrix by the composite-rigid-body algorithm (Featherstone 2008, §6.2), in one common
//! frame; energy; the largest inertia that each joint meets.
//!
//! With S_i = (z_i, r_i × z_i) the joint's motion and Iᶜ_i the inertia of everything from body i outwards, taken as rigid,
//! M_ij = S_jᵀ Iᶜ_i S_i for j ≤ i: in a common frame Iᶜ_{i−1} = I_{i−1} + Iᶜ_i is a plain sum.

use crate::dynamics::model::DynamicsModel;
use platewash_kinematics::{AXES, JointLimits, JointVector, halton};
use serde::Serialize;

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

/// Energy of the moving arm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Energy {
    /// ½ q̇ᵀ M(q) q̇ \[J\].
    pub kinetic_j: f64,
    /// −Σ m g · c, c the centre of mass in the base frame \[J\]; its derivative by q is g(q).
    pub potential_j: f64,
}

impl DynamicsModel {
    /// Energy at positions `q` \[rad\] and speeds `qd` \[rad/s\].
    #[must_use]
    pub fn energy(&self, q: &JointVector, qd: &JointVector) -> Energy {
        let placed = self.poses(q);
        let bodies = self.bodies.iter().zip(&placed);
        let potential = bodies.map(|(body, at)| {
            let com = at.rotation * body.com + at.translation;
            -body.mass * self.gravity.dot(&com)
        });
        Energy {
            kinetic_j: 0.5 * qd.dot(&(self.mass_matrix(q) * qd)),
            potential_j: potential.sum(),
        }
    }
}

/// Number of configurations that are checked: the largest entry found is then within a percent or so of the largest there is.
const CONFIGURATIONS: u32 = 4096;

/// `count` configurations \[rad\] spread evenly over the limits, one turn of a joint of many turns: [`halton`].
pub fn spread(limits: &JointLimits, count: u32) -> impl Iterator<Item = JointVector> + '_ {
    (1..=count).map(|k| {
        let shares = halton::point(k);
        JointVector::from_fn(|joint, _| {
            let [least, most] = limits.sampling_range(joint);
            least + (most - least) * shares[joint]
        })
    })
}

impl DynamicsModel {
    /// The largest diagonal entries of M(q) over configurations within `limits` \[kg·m²\]: the inertia by which gains of
    /// independent joints are scaled.
    #[must_use]
    pub fn largest_inertias(&self, limits: &JointLimits) -> JointVector {
        spread(limits, CONFIGURATIONS).fold(JointVector::zeros(), |largest, q| {
            largest.sup(&self.mass_matrix(&q).diagonal())
        })
    }
}
