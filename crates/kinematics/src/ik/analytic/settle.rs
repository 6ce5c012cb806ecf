//! Closing a branch that ends beyond a limit by no more than its joints are uncertain.

use super::{AnalyticArm, CLOSED, LIMIT_ROUNDING_RAD};
use crate::trig::sin_cos;
use crate::rotation::{Rigid, rotation_vector};
use crate::{AXES, JointLimits, JointVector};
use nalgebra::{Matrix6, Vector6};

/// Most Gauss–Newton steps.
const STEPS: usize = 6;
/// Damping: keeps the normal matrix definite where the free joints are singular.
const DAMPING: f64 = 1e-16;

impl AnalyticArm {
    /// `q` within the limits, if it is so up to rounding or the free joints can make up for the rest.
    #[inline]
    pub(super) fn settled(&self, target: &Rigid, q: JointVector, limits: &JointLimits) -> Option<JointVector> {
        if limits.contain(&q) {
            return Some(q);
        }
        self.settle(target, q, limits)
    }

    #[cold]
    fn settle(&self, target: &Rigid, q: JointVector, limits: &JointLimits) -> Option<JointVector> {
        let mut here = limits.clamp(&q);
        if (here - q).amax() <= LIMIT_ROUNDING_RAD {
            return Some(here);
        }
        for _ in 0..STEPS {
            let (error, mut jacobian) = self.error_and_jacobian(target, &here);
            let (linear, angular) = (error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm());
            if linear <= CLOSED && angular <= CLOSED {
                return Some(here);
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

    /// `(p* − p, log(R* Rᵀ))` of body 6 and its geometric Jacobian, in base axes \[m, rad\].
    fn error_and_jacobian(&self, target: &Rigid, q: &JointVector) -> (Vector6<f64>, Matrix6<f64>) {
        let mut body = Rigid::identity();
        let bodies: [Rigid; AXES] = std::array::from_fn(|i| {
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
