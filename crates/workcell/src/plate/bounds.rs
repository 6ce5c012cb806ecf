//! Sizes and places that a plate can have.

/// Least size of a plate \[m\].
pub const LEAST_PLATE_M: f64 = 1e-6;

/// Greatest size of a plate, and greatest distance of one from the origin along each axis \[m\].
pub const GREATEST_M: f64 = 1e3;
