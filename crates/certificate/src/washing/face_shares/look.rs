//! Sponge at a moment, as all cells see it.

use crate::washing::face_shares::sags::Sags;
use nalgebra::Vector3;

/// Sponge at a moment, as all cells see it.
pub(crate) struct Look {
    pub index: u32,
    pub t_s: f64,
    pub tip: Vector3<f64>,
    pub axis: Vector3<f64>,
    /// Sine of the angle between the sponge's axis and the plate's, and the magnitude of its cosine.
    pub tilt: f64,
    pub upright: f64,
    /// Angular speed \[rad/s\].
    pub turning: f64,
    /// Shift of a point off the axis by the height error, and the compression that it takes \[m\].
    pub aside_m: f64,
    pub(super) lower_m: f64,
    /// Sags from the moment before, and up to the next one; infinite where nothing is known.
    pub sags: [Sags; 2],
}

impl Look {
    /// Greatest loss of compression over a patch, for every plate height within its error, from that at its stated height \[m\].
    pub fn shallower_m(&self, sloping_m: f64) -> f64 {
        sloping_m + self.lower_m
    }
}
