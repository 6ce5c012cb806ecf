//! Which points are free for the next plate.

use super::discs::Discs;
use super::region::{Area, QuadCell};

/// The region, the free space around the base and the discs around earlier plates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Space<'a> {
    pub(super) area: &'a Area,
    pub(super) base_radius_squared: f64,
    pub(super) discs: &'a Discs,
}

impl Space<'_> {
    /// In the region and strictly outside of every disc.
    pub(super) fn is_free(&self, p: [f64; 2]) -> bool {
        p[0] * p[0] + p[1] * p[1] > self.base_radius_squared
            && !self.discs.any_near(p, |[x, y], radius_squared| {
                let (dx, dy) = (p[0] - x, p[1] - y);
                dx * dx + dy * dy <= radius_squared
            })
            && self.area.contains(p)
    }

    /// Whether a cell of the region's box surely holds no free point: it lies wholly in one disc or outside the region.
    pub(super) fn is_closed(&self, cell: &QuadCell) -> bool {
        cell.farthest_squared([0.0; 2]) <= self.base_radius_squared
            || self.discs.any_near(cell.middle, |centre, radius_squared| {
                cell.farthest_squared(centre) <= radius_squared
            })
            || self.area.excludes(cell)
    }
}
