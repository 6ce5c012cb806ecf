//! The longest step with which foam on a plate is integrated stably.
//!
//! About a configuration without drive, M δq̈ = −S δq − C δq̇, where S = λ M and C = τ S on the stiffest motion there is, λ the greatest
//! eigenvalue of M⁻¹ S, so that δẍ = −λ δx − τ λ δẋ. Semi-implicit Euler is stable while h² λ + 2 h τ λ < 4 (Jury's criterion); Runge–Kutta
//! while |h z| ≤ 2.61 for the roots z of z² + τ λ z + λ, as its region of stability holds that half-disc. Both hold for every softer
//! motion, too. Friction of joints only helps; gravity and the change of the lever are left out, being smaller by far.

use crate::dynamics::MassMatrix;
use crate::plant::sponge::ContactSlope;
use platewash_workcell::simulation::Integrator;

/// Radius of a half-disc in the left half-plane within Runge and Kutta's region of stability.
const HALF_DISC: f64 = 2.61;

/// The longest stable step \[s\]; infinite where nothing touches, 0 where the mass matrix is not positive definite.
#[must_use]
pub fn longest_step_s(mass: &MassMatrix, slope: &ContactSlope, integrator: Integrator) -> f64 {
    let Some(lower) = mass.cholesky() else { return 0.0 };
    let Some(inverse) = lower.l().try_inverse() else {
        return 0.0;
    };
    let scaled = inverse * slope.stiffness * inverse.transpose();
    // The largest magnitude; a NaN stays one, and gives 0.
    let stiffest = scaled
        .symmetric_eigenvalues()
        .iter()
        .fold(0.0_f64, |most, value| most.max(value.abs()));
    if !scaled.iter().all(|value| value.is_finite()) {
        return 0.0;
    }
    if stiffest == 0.0 {
        return f64::INFINITY;
    }
    // C is in proportion to S.
    let damping = stiffest * slope.damping.norm() / slope.stiffness.norm();
    match integrator {
        Integrator::SemiImplicitEuler => 4.0 / (damping + (damping * damping + 4.0 * stiffest).sqrt()),
        Integrator::Rk4 => {
            let half = 0.5 * damping;
            let beyond = half * half - stiffest;
            let root = if beyond > 0.0 {
                half + beyond.sqrt()
            } else {
                stiffest.sqrt()
            };
            HALF_DISC / root
        }
    }
}
