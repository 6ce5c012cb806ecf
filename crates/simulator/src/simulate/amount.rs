//! Bounds on the work of an execution.

use platewash_kinematics::words::{rounded_down, rounded_up};

/// Most samples of an execution, some 500 MB.
pub const MAX_SAMPLES: usize = 2_000_000;

/// Most steps of integration.
pub const MAX_STEPS: usize = 50_000_000;

/// Significant digits of a rate or period that is suggested.
const DIGITS: usize = 3;

/// Periods of an execution that is not too much work, but for two of rounding.
fn most_periods(substeps: usize) -> f64 {
    MAX_SAMPLES.min(MAX_STEPS / substeps.max(1)).saturating_sub(3) as f64
}

/// A rate \[Hz\] at which so much motion is not too much work.
pub(crate) fn highest_rate(duration_s: f64, substeps: usize) -> f64 {
    rounded_down(most_periods(substeps) / duration_s, DIGITS)
}

/// A period \[s\] with which it is not.
pub(crate) fn shortest_period(duration_s: f64, substeps: usize) -> f64 {
    rounded_up(duration_s / most_periods(substeps), DIGITS)
}
