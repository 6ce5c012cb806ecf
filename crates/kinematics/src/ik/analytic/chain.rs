//! Newton steps on the chain as described: they move a branch onto its limits, and close the answers of arms whose description is rounded.

use crate::ik::analytic::mismatch::StructureMismatch;
use crate::ik::analytic::tolerances::{CLOSED, LIMIT_ROUNDING_RAD};
use crate::joints::{AXES, JointVector};
use crate::limits::JointLimits;
use crate::rotation::{RigidTransform, rotation_vector};
use crate::trig::sin_cos;
use nalgebra::{Matrix6, Vector6};

/// Greatest number of Gauss–Newton steps.
const STEPS: usize = 6;
/// Greatest correction of a joint \[rad\]: one that moves farther has left the branch, as it may near a singularity.
const FARTHEST_RAD: f64 = 0.05;
/// Damping: keeps the normal matrix definite where the free joints are singular.
const DAMPING: f64 = 1e-16;
/// Regularity times distance beyond the limit above which nothing within the limit near by meets the pose to [`CLOSED`]: moving
/// by δ costs a pose error of about the regularity times δ, unless both are so small that the curvature counts.
const HOPELESS: f64 = 50.0 * CLOSED;

/// The chain as described: what an answer of a closed form is held to.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Chain {
    /// `F_i` of the model.
    pub folded: [RigidTransform; AXES],
    /// First property of the structure that holds only up to rounding.
    pub rounding: Option<StructureMismatch>,
}

impl Chain {
    /// Returns `q` within the limits, if it is so up to rounding or the free joints can make up for the rest. On a rounded arm all joints
    /// are corrected, as the closed form holds only nearly. `regularity` is |det J| up to a constant factor.
    #[cold]
    pub fn move_within_limits(
        &self,
        target: &RigidTransform,
        q: JointVector,
        limits: &JointLimits,
        regularity: impl FnOnce() -> f64,
    ) -> Option<JointVector> {
        let mut here = limits.clamp(&q);
        let beyond = (here - q).amax();
        if self.rounding.is_none() {
            if beyond <= LIMIT_ROUNDING_RAD {
                return Some(here);
            }
            if regularity() * beyond > HOPELESS {
                return None;
            }
        }
        for _ in 0..STEPS {
            let (error, mut jacobian) = self.error_and_jacobian(target, &here);
            let (linear, angular) = (error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm());
            if linear <= CLOSED && angular <= CLOSED {
                return ((here - q).amax() <= FARTHEST_RAD).then_some(here);
            }
            // Joints that stand on a limit stay there.
            for joint in (0..AXES).filter(|&i| here[i] == limits.lower[i] || here[i] == limits.upper[i]) {
                jacobian.column_mut(joint).fill(0.0);
            }
            let normal = jacobian.tr_mul(&jacobian) + Matrix6::from_diagonal_element(DAMPING);
            here = limits.clamp(&(here + normal.cholesky()?.solve(&jacobian.tr_mul(&error))));
        }
        None
    }

    /// Returns `(p* − p, log(R* Rᵀ))` of body 6 and its geometric Jacobian, in base axes \[m, rad\].
    fn error_and_jacobian(&self, target: &RigidTransform, q: &JointVector) -> (Vector6<f64>, Matrix6<f64>) {
        let mut body = RigidTransform::identity();
        let bodies: [RigidTransform; AXES] = std::array::from_fn(|i| {
            let (s, c) = sin_cos(q[i]);
            body = body.then(&self.folded[i]).turned_about_z(s, c);
            body
        });
        let linear = target.translation - body.translation;
        let angular = rotation_vector(&(target.rotation * body.rotation.transpose()));
        let mut jacobian = Matrix6::zeros();
        for (i, joint) in bodies.iter().enumerate() {
            let z = joint.rotation.column(2).into_owned();
            let lever = z.cross(&(body.translation - joint.translation));
            jacobian.fixed_view_mut::<3, 1>(0, i).copy_from(&lever);
            jacobian.fixed_view_mut::<3, 1>(3, i).copy_from(&z);
        }
        let error = Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z);
        (error, jacobian)
    }
}
