//! What the benchmarks share: workloads, the solvers under comparison, their score and an interleaved timing.
//!
//! A time says little without what it bought, so every solver's answers are checked by platewash's own
//! forward kinematics, to the same tolerances and the joint limits, and the share that passes stands beside
//! its time. On a shared machine absolute times drift; the ratios come from rounds in which all solvers take
//! turns ([`interleaved`]).

pub mod interleaved;
pub mod problems;
pub mod score;
pub mod solvers;

/// Largest accepted distance from the target \[m\], for every solver.
pub const POSITION_TOLERANCE_M: f64 = 1e-6;
/// Largest accepted angle from the target \[rad\], for every solver.
pub const ORIENTATION_TOLERANCE_RAD: f64 = 1e-6;
