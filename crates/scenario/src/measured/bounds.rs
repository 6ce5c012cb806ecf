//! Bounds of what is measured: sizes and deviations of plates, coordinates, noise.

/// Greatest deviation of a plate from its profile \[m\]. Chipped and bent plates are refused.
pub const MOST_DEVIATION_M: f64 = 2e-3;

/// Least diameter of a plate \[m\].
pub const LEAST_PLATE_M: f64 = 0.02;

/// Greatest diameter of a plate \[m\].
pub const MOST_PLATE_M: f64 = 1.0;

/// Length below which differences of heights do not matter \[m\].
pub(super) const NOISE_M: f64 = 1e-5;

/// True for a number that a coordinate can be; false for NaN.
pub(super) fn is_coordinate(c: f64) -> bool {
    c.abs() <= 1e9
}
