//! Numbers as what a verdict rests on tells them.

use platewash_kinematics::words::rounded;

/// Significant digits of a number that are told at most.
const DIGITS: usize = 9;

/// A length in millimetres, as short as it is.
pub(crate) fn mm(length_m: f64) -> String {
    number(1e3 * length_m)
}

/// A number as people write it: as short as it is, up to nine digits.
pub(crate) fn number(value: f64) -> String {
    // A negative zero is 0.
    let told = rounded(value, DIGITS) + 0.0;
    if told == 0.0 || (1e-6..=1e6).contains(&told.abs()) {
        told.to_string()
    } else {
        format!("{told:e}")
    }
}

/// Numbers with commas between.
pub(crate) fn list(numbers: impl IntoIterator<Item = f64>) -> String {
    let each: Vec<_> = numbers.into_iter().map(number).collect();
    each.join(", ")
}
