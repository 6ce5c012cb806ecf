//! What all plates of a layout share, and the distances that they keep.

use crate::plate::{Foot, Plate};
use crate::surface::Surface;
use platewash_kinematics::Pose;
use serde::{Deserialize, Serialize};

use super::error::{LayoutError, finite, not_negative, positive, range};

/// The largest number of plates that a layout may have.
pub const MAX_PLATES: usize = 1000;

/// Shape and height that all plates of a layout share.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlateGeometry {
    /// The washing surface; plates keep apart by the radius of its rim.
    pub surface: Surface,
    /// Height of the pole of the washing surface (z, base frame), metres.
    pub height_m: f64,
    /// Thickness, from the washing surface down, metres.
    pub thickness_m: f64,
    /// The ring that a plate stands on, where it has one.
    pub foot: Option<Foot>,
}

/// The rule by which plates keep their distance. It concerns centres: it does not keep plates from overlapping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spacing {
    /// Centres must be farther apart than this, metres.
    pub min_distance_m: f64,
    /// Centres must be farther from the base axis than this, metres.
    pub base_radius_m: f64,
}

/// The rectangle that the robot's base covers, base frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BaseFootprint {
    /// Least and greatest x, metres.
    pub x_m: [f64; 2],
    /// Least and greatest y, metres.
    pub y_m: [f64; 2],
}

impl PlateGeometry {
    /// Refuses a radius or thickness that is not greater than zero, a height that is not finite, and a foot of no size.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the key.
    pub fn validate(&self) -> Result<(), LayoutError> {
        positive("plate_radius_m", self.surface.rim_m())?;
        finite("plate_height_m", self.height_m)?;
        positive("plate_thickness_m", self.thickness_m)?;
        for size in self.foot.iter().flat_map(|foot| [foot.radius_m, foot.height_m]) {
            positive("plate_foot_m", size)?;
        }
        Ok(())
    }

    /// Plates of this geometry at the centres `[x, y]`, metres, base frame.
    pub(super) fn plates(&self, centres: &[[f64; 2]]) -> Vec<Plate> {
        let at = |&[x, y]: &[f64; 2]| Plate {
            surface: self.surface,
            thickness_m: self.thickness_m,
            foot: self.foot,
            pose: Pose::translation(x, y, self.height_m),
        };
        centres.iter().map(at).collect()
    }
}

impl Spacing {
    /// Refuses distances that are negative or not finite.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`], naming the key.
    pub fn validate(&self) -> Result<(), LayoutError> {
        not_negative("min_distance_m", self.min_distance_m)?;
        not_negative("base_radius_m", self.base_radius_m)
    }
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

    /// How far a plate that lies level with the base is apart from it, seen from above; negative where it lies over it \[m\]. `None` of a plate
    /// that does not lie level: what it meets is for the bodies to tell.
    #[must_use]
    pub fn gap_m(&self, plate: &Plate) -> Option<f64> {
        let away_m = plate.is_level().then(|| self.signed_distance(plate.centre_xy()));
        away_m.map(|away_m| away_m - plate.rim_m())
    }

    /// Distance of a point \[m\], negative inside.
    fn signed_distance(&self, [x, y]: [f64; 2]) -> f64 {
        let beyond = |value: f64, [low, high]: [f64; 2]| (low - value).max(value - high);
        let (dx, dy) = (beyond(x, self.x_m), beyond(y, self.y_m));
        let (outside_x, outside_y) = (dx.max(0.0), dy.max(0.0));
        (outside_x * outside_x + outside_y * outside_y).sqrt() + dx.max(dy).min(0.0)
    }
}
