//! Where the plates of a job come from: given one by one, or drawn.

use super::{
    BaseFootprint, Layout, LayoutError, PlateGeometry, Region, SampleRequest, SampleSettings, Spacing, check_explicit,
    sample,
};
use rand::Rng;

/// Where the plates of a job come from.
#[derive(Debug, Clone, PartialEq)]
pub enum Placement {
    /// Given by their centres.
    Given {
        /// Centres `[x, y]` \[m\].
        centres_m: Vec<[f64; 2]>,
        /// Where they should be, if anywhere; only findings rest on it.
        region: Option<Region>,
    },
    /// Drawn from a random stream.
    Sampled {
        /// Where centres may be.
        region: Region,
        /// Number of plates.
        count: usize,
        /// Whether layouts are drawn until every plate can be washed whole.
        washable_only: bool,
    },
}

impl Placement {
    /// Whether layouts are to be drawn until one can be washed whole, which takes a planner to tell.
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

    /// Places plates of one shape round a base. Whether they can be washed is for a planner to tell.
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
                sample(&request, &SampleSettings::default(), rng)
            }
        }
    }
}
