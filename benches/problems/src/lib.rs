//! What the benchmarks measure: inverse-kinematics problems with the solvers of this project, and the stages of the
//! certified job, cells with a wall in them. The benchmarks at the root and those beside the peers (`benches/peers`) measure these same problems.
//!
//! A time says little without what it bought, so every solver's answers are checked by platewash's own
//! forward kinematics, to the same tolerances and the joint limits, and the share that passes stands beside
//! its time ([`score`]).

// What the benchmarks ask may differ between machines in the last bit.
#![allow(clippy::disallowed_methods)]

pub mod crowded;
pub mod ours;
pub mod problems;
pub mod score;
pub mod solver;
pub mod stages;
pub mod transits;
pub mod walls;

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
