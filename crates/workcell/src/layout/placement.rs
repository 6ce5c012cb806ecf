//! Source of a job's plates: given one by one, or drawn.

use crate::layout::draw::{SampleRequest, sample};
use crate::layout::error::LayoutError;
use crate::layout::explicit::check_explicit;
use crate::layout::footprint::BaseFootprint;
use crate::layout::placed_plates::Layout;
use crate::layout::plate_geometry::PlateGeometry;
use crate::layout::region::Region;
use crate::layout::spacing::Spacing;
use rand::Rng;

/// Source of a job's plates.
#[derive(Debug, Clone, PartialEq)]
pub enum Placement {
    /// Given by their centres.
    Given {
        /// Centres `[x, y]` \[m\].
        centres_m: Vec<[f64; 2]>,
        /// Region in which they should be, if any. Only findings depend on it.
        region: Option<Region>,
    },
    /// Drawn from a random stream.
    Sampled {
        /// Region of the centres.
        region: Region,
        /// Number of plates.
        count: usize,
        /// True if layouts are drawn until every plate can be washed completely.
        washable_only: bool,
    },
}

impl Placement {
    /// True if layouts are drawn until one can be washed completely, which only a planner can decide.
    #[must_use]
    pub fn needs_planner(&self) -> bool {
        matches!(
            self,
            Self::Sampled {
                washable_only: true,
                ..
            }
        )
    }

    /// Places plates of one shape round a base. A planner decides later if they can be washed.
    ///
    /// # Errors
    /// As [`sample`] and [`check_explicit`].
    pub fn place<R: Rng + ?Sized>(
        &self,
        spacing: &Spacing,
        geometry: &PlateGeometry,
        base: Option<&BaseFootprint>,
        rng: &mut R,
    ) -> Result<Layout, LayoutError> {
        match self {
            Self::Given { centres_m, region } => check_explicit(centres_m, region.as_ref(), spacing, geometry, base),
            Self::Sampled { region, count, .. } => {
                let request = SampleRequest {
                    region: *region,
                    spacing: *spacing,
                    count: *count,
                    geometry: *geometry,
                    base: base.copied(),
                };
                sample(&request, rng)
            }
        }
    }
}
