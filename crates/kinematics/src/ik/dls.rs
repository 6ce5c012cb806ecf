//! Damped least squares: `Δq = (JᵀJ + λI)⁻¹ Jᵀ e`.
//!
//! Damping of the least-squares step.
//!
//! The 6 × 6 symmetric positive definite system of every damped step, by LDLᵀ without square roots.
//!
//! The pose error and its Jacobian at one configuration.

use crate::ik::settings::IkSettings;
use crate::model::{Axes, BodyPoses, Frame, Jacobian, manipulability};
use crate::rotation::{RigidTransform, rotation_vector};
use crate::{AXES, JointVector, RobotModel};
use nalgebra::{Matrix6, Vector6};

/// Smallest damping: keeps the normal matrix definite at an exact singularity without slowing convergence.
pub(crate) const LEAST_DAMPING: f64 = 1e-11;
/// Ratio of squared errors above which the descent stagnates: the error norm fell by less than 10 % (its square by less than 19 %) within
/// [`STAGNATION_WINDOW`] iterations.
const STAGNATION_RATIO: f64 = 0.81;
/// Number of iterations over which stagnation is judged.
const STAGNATION_WINDOW: usize = 8;
/// Number of accepted steps in a row that were clamped, from which on a limit counts as active.
pub(crate) const CLAMPED_IN_A_ROW: usize = 3;

/// Joints that may move; the others keep their positions.
pub(crate) type FreeJoints = [bool; AXES];

/// Every joint may move.
pub(crate) const ALL_FREE: FreeJoints = [true; AXES];

/// Descends from `start` (within the limits) moving the free joints only.
pub(crate) fn descend(task: &Task<'_>, start: Iterate, free: &FreeJoints, settings: &IkSettings) -> Descent {
    let limits = task.robot.limits();
    let mut here = start;
    let mut boost = 1.0;
    let mut clamped = 0;
    let mut milestone = here.cost;
    for iterations in 0..settings.max_iterations {
        let stopped = |stop| Descent {
            best: here,
            iterations,
            stop,
        };
        if task.solved(&here) {
            return stopped(Stop::Solved);
        }
        if clamped >= CLAMPED_IN_A_ROW {
            return stopped(Stop::ActiveLimit);
        }
        if iterations > 0 && iterations % STAGNATION_WINDOW == 0 {
            if here.cost > milestone * STAGNATION_RATIO {
                return stopped(Stop::Stagnation);
            }
            milestone = here.cost;
        }
        let jacobian = task.jacobian(&here);
        let lambda = settings.damping.lambda(here.cost, &jacobian).max(LEAST_DAMPING) * boost;
        let Some(step) = step(&jacobian, &here.error, lambda, free) else {
            return stopped(Stop::Stagnation);
        };
        let aim = here.q + bounded(step, settings.step_bound_rad);
        let next = task.at(limits.clamp(&aim));
        if next.cost < here.cost {
            clamped = if next.q == aim { 0 } else { clamped + 1 };
            boost = f64::max(boost * 0.1, 1.0);
            here = next;
        } else {
            boost *= 10.0;
        }
    }
    let stop = if task.solved(&here) {
        Stop::Solved
    } else {
        Stop::Iterations
    };
    Descent {
        best: here,
        iterations: settings.max_iterations,
        stop,
    }
}

/// Returns the damped step on the free joints; `None` if the normal matrix is not positive definite (NaN).
fn step(jacobian: &Matrix6<f64>, error: &Vector6<f64>, lambda: f64, free: &FreeJoints) -> Option<JointVector> {
    let mut jacobian = *jacobian;
    for (mut column, _) in jacobian.column_iter_mut().zip(free).filter(|(_, free)| !**free) {
        column.fill(0.0);
    }
    let normal = jacobian.tr_mul(&jacobian) + Matrix6::from_diagonal_element(lambda);
    solve_spd(&normal, &jacobian.tr_mul(error))
}

/// Returns the step shortened so that no joint moves more than `bound` \[rad\]; its direction is kept.
fn bounded(step: JointVector, bound: f64) -> JointVector {
    let largest = step.amax();
    if largest > bound {
        step * (bound / largest)
    } else {
        step
    }
}

/// Damping of a step: the λ of `(JᵀJ + λI) Δq = Jᵀe`. For every choice, a step that does not reduce the error raises it tenfold, and
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
    /// Returns λ at a squared error and a Jacobian.
    #[inline]
    pub(crate) fn lambda(&self, squared_error: f64, jacobian: &Jacobian) -> f64 {
        match *self {
            Self::ErrorProportional { gain } => gain * squared_error,
            Self::Constant { lambda } => lambda,
            Self::NearSingularities { largest, threshold } => {
                let short = (1.0 - manipulability(jacobian) / threshold).max(0.0);
                largest * short * short
            }
        }
    }

    /// Returns the first number out of its range, if any.
    pub(crate) fn first_out_of_range(&self) -> Option<f64> {
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

const N: usize = 6;

/// Solves `A x = b` for symmetric positive definite `A` (its lower triangle is read); `None` when a pivot is not positive
/// (an indefinite matrix, or NaN).
///
/// `A = L D Lᵀ` column by column, then two triangular solves (Golub & Van Loan, *Matrix Computations*, §4.1.2). One
/// division per pivot; the bounds are constants, so that the compiler unrolls everything.
#[inline]
pub(crate) fn solve_spd(a: &Matrix6<f64>, b: &Vector6<f64>) -> Option<Vector6<f64>> {
    let mut l = *a;
    let mut inverse = [0.0; N];
    for j in 0..N {
        let pivot = l[(j, j)];
        // Written so that NaN fails too.
        if pivot.is_nan() || pivot <= 0.0 {
            return None;
        }
        inverse[j] = 1.0 / pivot;
        for i in j + 1..N {
            let scaled = l[(i, j)] * inverse[j];
            for k in j + 1..=i {
                l[(i, k)] -= scaled * l[(k, j)];
            }
        }
    }
    // Column j of `l` below the diagonal now holds L times the pivot.
    let mut x = *b;
    for j in 0..N {
        let y = x[j] * inverse[j];
        for i in j + 1..N {
            x[i] -= l[(i, j)] * y;
        }
    }
    for j in (0..N).rev() {
        let mut sum = x[j];
        for i in j + 1..N {
            sum -= l[(i, j)] * x[i];
        }
        x[j] = sum * inverse[j];
    }
    Some(x)
}

/// Distance from a limit below which a joint counts as standing on it \[rad\].
pub(crate) const ON_LIMIT_RAD: f64 = 1e-6;

/// Inverse-kinematics problem: an arm, a frame on it, and the target pose of that frame.
pub(crate) struct Task<'a> {
    pub robot: &'a RobotModel,
    pub frame: Frame,
    pub target: RigidTransform,
    /// Tolerances on position \[m\] and orientation \[rad\].
    pub tolerance: [f64; 2],
}

/// Configuration with its error.
#[derive(Clone, Copy)]
pub(crate) struct Iterate {
    pub q: JointVector,
    bodies: BodyPoses,
    /// Error `e = (p* − p, log(R* Rᵀ))`, metres and radians in base axes.
    pub error: Vector6<f64>,
    /// Squared error `‖e‖²`.
    pub cost: f64,
}

impl Task<'_> {
    pub fn at(&self, q: JointVector) -> Iterate {
        let bodies = self.robot.fk(&q);
        let tip = bodies.rigid(&self.frame);
        let linear = self.target.translation - tip.translation;
        let angular = rotation_vector(&(self.target.rotation * tip.rotation.transpose()));
        let error = Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z);
        Iterate {
            q,
            bodies,
            error,
            cost: error.norm_squared(),
        }
    }

    pub fn jacobian(&self, iterate: &Iterate) -> Jacobian {
        iterate.bodies.jacobian(&self.frame, Axes::Base)
    }

    pub fn solved(&self, iterate: &Iterate) -> bool {
        iterate.position_error() <= self.tolerance[0] && iterate.orientation_error() <= self.tolerance[1]
    }
}

impl Iterate {
    /// Distance from the target \[m\].
    pub fn position_error(&self) -> f64 {
        self.error.fixed_rows::<3>(0).norm()
    }

    /// Angle from the target \[rad\].
    pub fn orientation_error(&self) -> f64 {
        self.error.fixed_rows::<3>(3).norm()
    }
}

/// Reason that a descent stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    /// The error is within both tolerances.
    Solved,
    /// The error hardly falls any more.
    Stagnation,
    /// Steps keep being clamped to a limit.
    ActiveLimit,
    /// The iterations ran out.
    Iterations,
}

/// Stop of a descent.
pub(crate) struct Descent {
    pub best: Iterate,
    pub iterations: usize,
    pub stop: Stop,
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn damping_schemes_agree_with_hand_calculation() {
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
    fn finds_numbers_out_of_range() {
        assert_eq!(Damping::default().first_out_of_range(), None);
        assert_eq!(Damping::Constant { lambda: -1.0 }.first_out_of_range(), Some(-1.0));
        assert!(
            Damping::ErrorProportional { gain: f64::NAN }
                .first_out_of_range()
                .is_some()
        );
        let flat = Damping::NearSingularities {
            largest: 0.1,
            threshold: 0.0,
        };
        assert_eq!(flat.first_out_of_range(), Some(0.0));
    }

    proptest! {
        #[test]
        fn agrees_with_a_general_solver(entries in prop::collection::vec(-1.0..1.0f64, 36), b in prop::collection::vec(-1.0..1.0f64, 6)) {
            let m = Matrix6::from_row_slice(&entries);
            let a = m.tr_mul(&m) + Matrix6::from_diagonal_element(1e-3);
            let b = Vector6::from_row_slice(&b);
            let expected = a.lu().solve(&b).ok_or_else(|| TestCaseError::fail("singular"))?;
            let x = solve_spd(&a, &b).ok_or_else(|| TestCaseError::fail("not positive"))?;
            prop_assert!((x - expected).amax() < 1e-9 * (1.0 + expected.amax()));
        }
    }

    #[test]
    fn rejects_matrices_that_are_not_positive_definite() {
        let mut a = Matrix6::identity();
        a[(3, 3)] = -1.0;
        assert_eq!(solve_spd(&a, &Vector6::zeros()), None);
        a[(3, 3)] = f64::NAN;
        assert_eq!(solve_spd(&a, &Vector6::zeros()), None);
    }
}
