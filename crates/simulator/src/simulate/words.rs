//! Numbers as people read them.

use platewash_kinematics::words::rounded;

/// Significant digits of what a job states.
const SHOWN_DIGITS: usize = 6;

/// What a job states, as people read it.
pub(super) fn shown(value: f64) -> f64 {
    rounded(value, SHOWN_DIGITS)
}
