//! A random layout, begun anew at every dead end.

use crate::layout::count::check_count;
use crate::layout::error::LayoutError;
use crate::layout::findings;
use crate::layout::footprint::BaseFootprint;
use crate::layout::packing::packing_bound;
use crate::layout::placed_plates::{Layout, LayoutSource};
use crate::layout::plate_geometry::PlateGeometry;
use crate::layout::region::Region;
use crate::layout::sampling::{Attempt, Sampler, Work};
use crate::layout::spacing::Spacing;
use rand::Rng;

/// Request for a random layout.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleRequest {
    /// Region of the plates' centres.
    pub region: Region,
    /// Distances of the centres from each other and from the base axis.
    pub spacing: Spacing,
    /// Number of plates, 1 to [`MAX_PLATES`](crate::layout::MAX_PLATES).
    pub count: usize,
    /// Shape and height of the plates.
    pub geometry: PlateGeometry,
    /// Footprint of the robot's base, only for [`Finding::OverlapsBase`](crate::layout::Finding::OverlapsBase); `None` if no plate is
    /// level with it.
    pub base: Option<BaseFootprint>,
}

/// Greatest number of restarts after the first layout came to a dead end, and number of steps (positions drawn plus quadtree cells examined)
/// after which no layout is begun. It is a count and not a time, so that the outcome does not depend on the machine.
const MOST_WORK: (u32, u64) = (1000, 20_000_000);

/// The same for a count that is impossible: enough to measure how many plates random layouts hold.
const WORK_OF_A_MEASURE: (u32, u64) = (99, 1_000_000);

/// Draws a layout by the paper's law (see [`Sampler`]), and begins anew at every dead end. It ends in bounded time for every request. The
/// same generator state gives the same layout on every machine. Findings are overlaps, which the law allows: with the paper's numbers
/// plates of 0.145 m radius may be 0.28 m apart.
///
/// # Errors
///
/// [`LayoutError::InvalidInput`] names the invalid number; [`LayoutError::EmptyRegion`] if not even a first plate has room;
/// [`LayoutError::NoRoom`] if every layout came to a dead end. If [`packing_bound`] rules the request out, at most a hundred layouts are
/// begun, only to measure how many plates they held.
pub fn sample<R: Rng + ?Sized>(request: &SampleRequest, rng: &mut R) -> Result<Layout, LayoutError> {
    let SampleRequest {
        region,
        spacing,
        count,
        geometry,
        base,
    } = request;
    let count = *count;
    geometry.validate()?;
    base.as_ref().map_or(Ok(()), BaseFootprint::validate)?;
    check_count(count)?;
    let sampler = Sampler::new(region, spacing)?;
    let upper_bound = packing_bound(region, spacing.min_distance_m);
    let (max_restarts, max_steps) = match upper_bound {
        Some(bound) if count > bound => WORK_OF_A_MEASURE,
        _ => MOST_WORK,
    };
    let mut work = Work::default();
    let (mut most_placed, mut restarts) = (0, 0);
    loop {
        match sampler.attempt_counting(count, rng, &mut work) {
            Attempt::Placed(centres) => {
                let plates = geometry.plates(&centres);
                let findings = findings::overlaps(&plates, base.as_ref());
                let source = LayoutSource::Sampled {
                    restarts,
                    draws: work.draws,
                };
                return Ok(Layout {
                    plates,
                    source,
                    findings,
                });
            }
            Attempt::DeadEnd { placed } => most_placed = most_placed.max(placed),
        }
        if restarts == max_restarts || work.draws + work.cells >= max_steps {
            return Err(LayoutError::NoRoom {
                count,
                most_placed,
                layouts_tried: restarts.saturating_add(1),
                upper_bound,
            });
        }
        restarts += 1;
    }
}
