//! What the benchmarks share: workloads, the solvers under comparison, their score and an interleaved timing.
//!
//! A time says little without what it bought, so every solver's answers are checked by platewash's own
//! forward kinematics, to the same tolerances and the joint limits, and the share that passes stands beside
//! its time. On a shared machine absolute times drift; the ratios come from rounds in which all solvers take
//! turns ([`interleaved`]).

pub mod edges;
pub mod interleaved;
pub mod judged;
pub mod plain_fk;
pub mod problems;
pub mod score;
pub mod solvers;
pub mod stages;
pub mod tilts;

/// Largest accepted distance from a target, the same for every solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Of the origin \[m\].
    pub position_m: f64,
    /// Of the rotation \[rad\].
    pub orientation_rad: f64,
}

/// What an iterative solver is asked for by default.
pub const NUMERIC: Tolerance = Tolerance {
    position_m: 1e-6,
    orientation_rad: 1e-6,
};

/// What an analytic solver is asked for.
pub const ANALYTIC: Tolerance = Tolerance {
    position_m: 1e-9,
    orientation_rad: 1e-9,
};
