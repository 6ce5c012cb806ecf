//! Losses between two moments: how far a quantity leaves the line through its values at both.

/// Bounds on the difference between a quantity and the line through its values at two moments: h²/8 times the bound of the second
/// derivative, h the time between them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sags {
    /// Sag of the compression at any point in contact \[m\].
    pub compression_m: f64,
    /// Sag of the distance of such a point from the sponge's axis \[m\].
    pub aside_m: f64,
    /// Sag of the sliding way over such a point: h times the error of its velocity across the axis \[m\].
    pub slide_m: f64,
}
