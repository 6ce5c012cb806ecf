//! Shape and height that all plates of a layout share.

use crate::layout::error::{LayoutError, finite, positive};
use crate::plate::{Foot, Plate, PlateTerms};
use crate::surface::Surface;
use platewash_kinematics::Pose;
use serde::{Deserialize, Serialize};

/// Shape and height that all plates of a layout share.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlateGeometry {
    /// Washing surface; plates keep apart by the radius of its rim.
    pub surface: Surface,
    /// Height of the pole of the washing surface (z, base frame) \[m\].
    pub height_m: f64,
    /// Thickness, from the washing surface down \[m\].
    pub thickness_m: f64,
    /// Ring that a plate stands on, if it has one.
    pub foot: Option<Foot>,
    /// Terms of plates of this kind, where they differ from those of the job.
    pub terms: PlateTerms,
}

impl PlateGeometry {
    /// Refuses a radius or thickness that is not greater than zero, a height that is not finite, and an invalid foot.
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

    /// Returns plates of this geometry at the centres `[x, y]` \[m\], base frame.
    pub(super) fn plates(&self, centres: &[[f64; 2]]) -> Vec<Plate> {
        let at = |&[x, y]: &[f64; 2]| Plate {
            surface: self.surface,
            thickness_m: self.thickness_m,
            foot: self.foot,
            pose: Pose::translation(x, y, self.height_m),
            terms: self.terms,
        };
        centres.iter().map(at).collect()
    }
}
