//! Kinetic and potential energy.

use super::model::DynamicsModel;
use platewash_kinematics::JointVector;
use serde::Serialize;

/// Energy of the moving arm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Energy {
    /// ½ q̇ᵀ M(q) q̇ \[J\].
    pub kinetic_j: f64,
    /// −Σ m g · c, c the centre of mass in the base frame \[J\]; its derivative by q is g(q).
    pub potential_j: f64,
}

impl Energy {
    /// Both together \[J\].
    #[must_use]
    pub fn total_j(&self) -> f64 {
        self.kinetic_j + self.potential_j
    }
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
