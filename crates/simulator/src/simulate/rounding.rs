//! Rounding of stated values for people.

use platewash_kinematics::words::rounded;

/// Significant digits of stated values.
const SHOWN_DIGITS: usize = 6;

/// Rounds a stated value to the digits that are shown to people.
pub(crate) fn rounded_for_display(value: f64) -> f64 {
    rounded(value, SHOWN_DIGITS)
}
