//! The longest step with which foam on a plate is integrated stably.
//!
//! About a configuration without drive, M δq̈ = −S δq − C δq̇, where S = λ M and C = τ S on the stiffest motion there is, λ the greatest
//! eigenvalue of M⁻¹ S, so that δẍ = −λ δx − τ λ δẋ. Semi-implicit Euler is stable while h² λ + 2 h τ λ < 4 (Jury's criterion); Runge–Kutta
//! while |h z| ≤ 2.61 for the roots z of z² + τ λ z + λ, as its region of stability holds that half-disc. Both hold for every softer
//! motion, too. Friction of joints only helps; gravity and the change of the lever are left out, being smaller by far.

use super::sponge::ContactSlope;
use crate::dynamics::MassMatrix;
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
    // The largest magnitude; a NaN stays one, and 0 is what it gives.
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

#[cfg(test)]
mod tests {
    use super::*;

    fn slope(stiffness: f64, damping: f64) -> ContactSlope {
        ContactSlope {
            stiffness: MassMatrix::identity() * stiffness,
            damping: MassMatrix::identity() * damping,
        }
    }

    /// Spectral radius of one step on x of a mass of one.
    fn radius(integrator: Integrator, h: f64, stiffness: f64, damping: f64) -> f64 {
        let step = |[x, v]: [f64; 2]| match integrator {
            Integrator::SemiImplicitEuler => {
                let v = v + h * (-stiffness * x - damping * v);
                [x + h * v, v]
            }
            Integrator::Rk4 => {
                let rate = |[x, v]: [f64; 2]| [v, -stiffness * x - damping * v];
                let ahead = |by: f64, r: [f64; 2]| [x + by * r[0], v + by * r[1]];
                let a = rate([x, v]);
                let b = rate(ahead(0.5 * h, a));
                let c = rate(ahead(0.5 * h, b));
                let d = rate(ahead(h, c));
                let sum = [0, 1].map(|k| (a[k] + 2.0 * (b[k] + c[k]) + d[k]) / 6.0);
                ahead(h, sum)
            }
        };
        let (a, b) = (step([1.0, 0.0]), step([0.0, 1.0]));
        let (half, det) = (0.5 * (a[0] + b[1]), a[0] * b[1] - b[0] * a[1]);
        let beyond = half * half - det;
        if beyond > 0.0 {
            half.abs() + beyond.sqrt()
        } else {
            det.sqrt()
        }
    }

    #[test]
    fn steps_up_to_the_longest_are_stable() {
        for integrator in [Integrator::SemiImplicitEuler, Integrator::Rk4] {
            for stiffness in [1.0, 1e3, 1e6] {
                for ratio in [0.0, 0.01, 0.3, 1.0, 3.0, 30.0] {
                    let damping = ratio * f64::sqrt(stiffness);
                    let longest = longest_step_s(&MassMatrix::identity(), &slope(stiffness, damping), integrator);
                    for share in [0.01, 0.3, 0.7, 0.9, 0.999] {
                        let radius = radius(integrator, share * longest, stiffness, damping);
                        assert!(
                            radius <= 1.0 + 1e-9,
                            "{integrator:?} {stiffness} {ratio} {share}: {radius}"
                        );
                    }
                    let beyond = radius(integrator, 1.25 * longest, stiffness, damping);
                    assert!(beyond > 1.0, "{integrator:?} {stiffness} {ratio}: {beyond}");
                }
            }
        }
    }

    #[test]
    fn what_is_no_slope_has_no_step() {
        let one = MassMatrix::identity();
        let euler = Integrator::SemiImplicitEuler;
        assert_eq!(longest_step_s(&one, &slope(0.0, 0.0), euler), f64::INFINITY);
        assert_eq!(longest_step_s(&one, &slope(f64::NAN, 0.0), euler), 0.0);
        assert_eq!(longest_step_s(&-one, &slope(1.0, 0.0), euler), 0.0);
    }
}
