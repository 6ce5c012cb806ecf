//! Losses between two moments: how far a quantity leaves the line through its values at both.
//!
//! Formula (28.1) in `docs/contact.md`.

/// Bounds on the difference between a quantity and the line through its values at two moments: h²/8 times the bound of the second
/// derivative, h the time between them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sags {
    /// Sag of the compression w at any point in contact \[m\], the first of formula (28.1).
    pub compression_m: f64,
    /// Sag of the distance of such a point from the sponge's axis \[m\], the second of formula (28.1).
    pub aside_m: f64,
    /// Sag of the sliding way over such a point: h times the error of its velocity across the axis \[m\].
    pub slide_m: f64,
}
