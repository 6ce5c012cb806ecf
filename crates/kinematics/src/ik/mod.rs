//! Inverse kinematics: damped least squares with a QP fallback.
//!
//! # What is solved
//!
//! Find `q` within the joint limits whose frame pose `T_base_frame(q)` equals the target, to
//! [`IkSettings::position_tolerance_m`] and [`IkSettings::orientation_tolerance_rad`]. The error is
//!
//! `e(q) = (p* − p(q),  log(R* R(q)ᵀ))` — metres and radians, in base axes, one weight each,
//!
//! and `J(q)` the geometric Jacobian in base axes.
//!
//! # Which method answers when
//!
//! | call | answers |
//! | --- | --- |
//! | [`IkSolver::solve`] | one configuration for one pose, by the cascade below |
//! | [`IkSolver::solve_all`] | every branch and wrap within the limits, and why each other branch is none (arms that [`analytic`] recognises) |
//! | [`IkSolver::spread`] | several configurations for one pose, by descents from many starts; no proof that there are no others ([`spread`]) |
//! | [`IkSolver::solve_path`] | one configuration per waypoint, without jumps, or where and why not ([`path`]) |
//! | [`batch::solve`](crate::batch::solve) | `solve` for many poses, each from a seed of its own; warm ones four at a time ([`crate::batch`]) |
//! | [`IkSolver::solve_generalized`] | one configuration for a pose with freedom, bounds on the motion and clearance rows ([`generalized`]) |
//!
//! # The cascade of `solve`, in order
//!
//! 1. **Analytic branches**, on arms that [`analytic`] recognises, when the seed is cold (`‖e‖ > 0.3` at the seed): the in-limit
//!    branch nearest to the seed is where DLS starts, and mostly ends. When the seed is warm this step comes after step 3.
//!    On these arms the steps from 4 on never run: where no branch is within the limits there is no solution, and
//!    the failure says which filter left none.
//! 2. **DLS** from the caller's seed ([`dls`]): `Δq = (JᵀJ + λI)⁻¹ Jᵀ e`, with `λ` in
//!    proportion to `‖e‖²` (Sugihara, *IEEE Trans. Robotics* 2011), raised tenfold after a step that does not reduce the
//!    error and let fall again by those that do (Levenberg–Marquardt); steps are bounded and clamped to the limits.
//! 3. **QP** ([`qp`]), from where DLS stopped, when it stopped for one of two reasons: *stagnation* (the
//!    error fell by less than 10 % in 8 iterations) or an *active limit* (three accepted steps in a row were
//!    clamped). It solves `min ‖J Δq − e‖² + λ‖Δq‖²` within the joint position bounds and a step bound
//!    (clarabel) until DLS on the joints that are free of their limits can polish the answer to the
//!    same tolerance. It runs at once where DLS stopped near the target (`‖e‖ < 0.1`), and otherwise after the listed starts,
//!    because a program costs as much as a hundred DLS steps.
//! 4. A target beyond the arm's [reach bound](crate::RobotModel::reach_bound) ends here, as unreachable.
//! 5. **Listed starts** ([`starts`]): DLS from a fixed list of configurations, the nearest in pose first;
//!    then the QP from the seed's stop (if it is still due) and from the best six stops of the list that hit a limit.
//!    The list depends on the arm alone, so the answer depends on the arguments alone.
//! 6. **Random restarts**, only when the caller asks for them with a seed of their own
//!    ([`RandomRestarts`]): DLS, then QP where a limit stopped it.
//!
//! A failure reports the configuration with the smallest error over all starts, which may be on another branch than the
//! seed: MATLAB's solver, which the paper uses, restarts and does the same.
//!
//! The result of every step is checked once more in one place: it is within the limits and within both tolerances, or it is an error.

pub mod analytic;
mod answer;
mod cascade;
pub mod dls;
pub mod freedom;
pub mod generalized;
pub mod path;
pub mod qp;
mod settings;
pub mod spread;
pub mod starts;

pub use crate::ik::answer::{IkCause, IkError, IkFailure, IkSolution, Method, Start};
pub use crate::ik::cascade::{AllBranchesError, IkSolver};
pub use crate::ik::freedom::{TaskFreedom, TaskFreedomError, Yaw};
pub use crate::ik::generalized::{ClearanceRow, ClearanceRows, GeneralizedError, GeneralizedSolution, GeneralizedTask};
pub use crate::ik::path::{IkPath, IkPathError, PathBreak};
pub use crate::ik::settings::{AnalyticStarts, IkSettings, IkSettingsError, RandomRestarts};
