//! Rectangle that the robot's base covers.

use crate::layout::error::{LayoutError, range};
use crate::plate::Plate;
use serde::{Deserialize, Serialize};

/// Rectangle that the robot's base covers, base frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseFootprint {
    /// Least and greatest x \[m\].
    pub x_m: [f64; 2],
    /// Least and greatest y \[m\].
    pub y_m: [f64; 2],
}

impl BaseFootprint {
    /// Refuses sides that are not finite, reversed or of zero length.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the side.
    pub fn validate(&self) -> Result<(), LayoutError> {
        range("base footprint x", self.x_m)?;
        range("base footprint y", self.y_m)
    }

    /// Distance between the footprint and the rim of a level plate, seen from above \[m\]; negative if the plate lies over it. `None` for a
    /// plate that is not level, which is checked by its bodies.
    #[must_use]
    pub fn gap_m(&self, plate: &Plate) -> Option<f64> {
        let away_m = plate.is_level().then(|| self.signed_distance(plate.centre_xy()));
        away_m.map(|away_m| away_m - plate.rim_m())
    }

    /// Distance of a point from the footprint \[m\]; negative inside.
    fn signed_distance(&self, [x, y]: [f64; 2]) -> f64 {
        let beyond = |value: f64, [low, high]: [f64; 2]| (low - value).max(value - high);
        let (dx, dy) = (beyond(x, self.x_m), beyond(y, self.y_m));
        let (outside_x, outside_y) = (dx.max(0.0), dy.max(0.0));
        (outside_x * outside_x + outside_y * outside_y).sqrt() + dx.max(dy).min(0.0)
    }
}
