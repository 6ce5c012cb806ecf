//! Damping of the least-squares step.

use crate::jacobian::{Jacobian, manipulability};

/// How strongly a step is damped: the λ of `(JᵀJ + λI) Δq = Jᵀe`. Whatever is chosen, a step that does not reduce the error raises it tenfold, and
/// accepted steps let it fall again (Levenberg–Marquardt).
///
/// A motion of the joints that moves the tip by σ (m, rad) per radian is damped where σ² is not far above λ: with a constant
/// 1e-5, along directions within about 3e-3 of singular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Damping {
    /// `λ = gain ‖e‖²` (e in m and rad): strong far from the target, vanishing at it, so that convergence is quadratic
    /// (Sugihara, *IEEE Trans. Robotics* 2011). The default, with gain 0.3.
    ErrorProportional {
        /// From 0 to 1e6.
        gain: f64,
    },
    /// `λ` itself: the classical scheme (Wampler 1986); convergence is linear.
    Constant {
        /// From 0 to 1e6.
        lambda: f64,
    },
    /// `λ = largest (1 − w/threshold)²` where the manipulability `w = |det J|` is below the threshold, none elsewhere
    /// (Nakamura & Hanafusa 1986): damped near singularities only.
    NearSingularities {
        /// From 0 to 1e6.
        largest: f64,
        /// Manipulability below which damping begins \[m³\]; above 0.
        threshold: f64,
    },
}

impl Default for Damping {
    fn default() -> Self {
        Self::ErrorProportional { gain: 0.3 }
    }
}

impl Damping {
    /// λ at a squared error and a Jacobian.
    #[inline]
    pub(super) fn lambda(&self, squared_error: f64, jacobian: &Jacobian) -> f64 {
        match *self {
            Self::ErrorProportional { gain } => gain * squared_error,
            Self::Constant { lambda } => lambda,
            Self::NearSingularities { largest, threshold } => {
                let short = (1.0 - manipulability(jacobian) / threshold).max(0.0);
                largest * short * short
            }
        }
    }

    /// The first number out of its range, if any.
    pub(super) fn misfit(&self) -> Option<f64> {
        let fits = |v: f64| (0.0..=1e6).contains(&v);
        match *self {
            Self::ErrorProportional { gain: v } | Self::Constant { lambda: v } => (!fits(v)).then_some(v),
            Self::NearSingularities { largest, threshold } => {
                let above_zero = threshold > 0.0 && fits(threshold);
                (!fits(largest))
                    .then_some(largest)
                    .or((!above_zero).then_some(threshold))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_scheme_by_hand() {
        let regular = Jacobian::identity();
        let singular = Jacobian::zeros();
        let sugihara = Damping::default();
        assert_eq!(
            [sugihara.lambda(0.04, &regular), sugihara.lambda(0.0, &singular)],
            [0.3 * 0.04, 0.0]
        );
        assert_eq!(Damping::Constant { lambda: 1e-3 }.lambda(9.0, &regular), 1e-3);
        let nakamura = Damping::NearSingularities {
            largest: 0.1,
            threshold: 2.0,
        };
        assert_eq!(
            [nakamura.lambda(1.0, &regular), nakamura.lambda(1.0, &singular)],
            [0.1 * 0.25, 0.1]
        );
        assert_eq!(nakamura.lambda(1.0, &(regular * 2.0)), 0.0);
    }

    #[test]
    fn numbers_out_of_range_are_found() {
        assert_eq!(Damping::default().misfit(), None);
        assert_eq!(Damping::Constant { lambda: -1.0 }.misfit(), Some(-1.0));
        assert!(Damping::ErrorProportional { gain: f64::NAN }.misfit().is_some());
        let flat = Damping::NearSingularities {
            largest: 0.1,
            threshold: 0.0,
        };
        assert_eq!(flat.misfit(), Some(0.0));
    }
}
