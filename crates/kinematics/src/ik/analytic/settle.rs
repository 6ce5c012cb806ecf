//! Closing a branch that ends beyond a limit by no more than its joints are uncertain.

use super::arm::AnalyticArm;
use super::tolerance::{CLOSED, LIMIT_ROUNDING_RAD};
use crate::rotation::{Rigid, rotation_vector};
use crate::trig::sin_cos;
use crate::{AXES, JointLimits, JointVector};
use nalgebra::{Complex, Matrix6, Vector6};

/// Most Gauss–Newton steps.
const STEPS: usize = 6;
/// Damping: keeps the normal matrix definite where the free joints are singular.
const DAMPING: f64 = 1e-16;
/// Regularity times distance beyond the limit above which nothing within the limit near by meets the pose to [`CLOSED`]: moving
/// by δ costs a pose error of about the regularity times δ, unless both are so small that the curvature counts.
const HOPELESS: f64 = 50.0 * CLOSED;

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
        let beyond = (here - q).amax();
        if beyond <= LIMIT_ROUNDING_RAD {
            return Some(here);
        }
        if self.regularity(&q) * beyond > HOPELESS {
            return None;
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

    /// |det J| but for a constant factor: `|sin ψ · X / (L₂ + L₃) · sin(q₅ + α₅)|`, zero at full stretch or fold, with
    /// the wrist centre beside axis 1, and with axes 4 and 6 parallel.
    fn regularity(&self, q: &JointVector) -> f64 {
        let [upper, fore] = self.lengths;
        let [sign_2, sign_3] = self.signs;
        let (s, c) = sin_cos(sign_2 * q[1]);
        let upper_arm = self.upper_at_zero * Complex::new(c, s);
        let (s, c) = sin_cos(self.bend_at_zero + sign_3 * q[2]);
        let out = self.shoulder_offset + (upper_arm * (Complex::new(c, s) * fore + upper)).im;
        let (wrist, _) = sin_cos(q[4] + self.wrist_at_zero[0]);
        (s * out / (upper + fore) * wrist).abs()
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
