//! Answer of the solver, and the reasons that there is none.

use crate::joints::JointVector;
use serde::Serialize;

/// Method that found the answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// Damped least squares.
    Dls,
    /// The quadratic program, polished by damped least squares on the free joints.
    Qp,
}

/// Start from which the answer was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// The caller's seed.
    Seed,
    /// The analytic branch nearest to the seed.
    Analytic,
    /// An entry of the listed starts, counted in the order tried.
    Listed(usize),
    /// A random restart, counted in the order tried.
    Random(usize),
}

/// Configuration within the limits that meets both tolerances.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IkSolution {
    /// Joint positions \[rad\].
    pub q: JointVector,
    /// Number of linear systems and QPs solved, over all starts.
    pub iterations: usize,
    /// Method that found the answer.
    pub method: Method,
    /// Start that led to the answer.
    pub start: Start,
    /// Distance of the frame's origin from the target's \[m\].
    pub position_error_m: f64,
    /// Angle between the frame and the target \[rad\].
    pub orientation_error_rad: f64,
}

/// Reason that no start led to the target, read at the best configuration found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, thiserror::Error)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum IkCause {
    /// The target lies beyond the arm's reach bound, or no analytic branch reaches it: proven.
    #[error("unreachable")]
    Unreachable,
    /// No joint motion reduces the error to first order (`‖Jᵀe‖ ≤ 10⁻³ ‖J‖ ‖e‖`) and no limit is in the way: most likely out
    /// of reach, but that is not proven.
    #[error("no nearer configuration")]
    LocalMinimum,
    /// A joint stands at its limit and would have to go on (the one with the largest pull is named), or every analytic branch
    /// breaks a limit (the joint of the branch that breaks it by least).
    #[error("stopped by the limit of joint {}", .joint + 1)]
    Limit {
        /// Joint index, 0 for joint 1.
        joint: usize,
    },
    /// The Jacobian has nearly lost a direction (smallest singular value below 10⁻³) that is needed.
    #[error("singular")]
    Singular,
    /// The iterations ran out while the error was still falling.
    #[error("out of iterations")]
    Iterations,
}

/// Failure to find a solution: the best configuration and the reason that it stopped there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct IkFailure {
    /// Configuration with the smallest error found, within the limits \[rad\].
    pub q: JointVector,
    /// Number of linear systems and QPs solved, over all starts.
    pub iterations: usize,
    /// Reason of the failure.
    pub cause: IkCause,
    /// Distance by which the joint would have to go beyond its limit \[rad\], for a limit found by the analytic branches.
    pub limit_excess_rad: Option<f64>,
    /// Distance of the frame's origin from the target's \[m\].
    pub position_error_m: f64,
    /// Angle between the frame and the target \[rad\].
    pub orientation_error_rad: f64,
}

/// Reason that [`IkSolver::solve`](crate::ik::IkSolver::solve) did not answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IkError {
    /// The target pose has NaN or infinite entries.
    #[error("the target pose is not finite: position {position:?} m")]
    Target {
        /// Position of the target \[m\].
        position: [f64; 3],
    },
    /// The seed has a NaN or infinite entry.
    #[error("the seed of joint {} is not finite: {found}", .joint + 1)]
    Seed {
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Value given \[rad\].
        found: f64,
    },
    /// No start led to the target.
    #[error(
        "no solution ({}): best configuration is {:.3e} m and {:.3e} rad off after {} iterations",
        .0.cause, .0.position_error_m, .0.orientation_error_rad, .0.iterations
    )]
    NotSolved(IkFailure),
}
