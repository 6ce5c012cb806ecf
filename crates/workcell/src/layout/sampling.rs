//! Random layouts by the paper's law, without its endless loop.
//!
//! The law is sequential: each plate is uniform over the part of the region that is strictly farther than `min_distance_m`
//! from every earlier plate and strictly farther than `base_radius_m` from the base axis. When nothing is left, the layout
//! is a dead end and is begun anew.
//!
//! Each plate is drawn by rejection from the region's box first. If that fails, a quadtree over the box is refined: cells
//! wholly in one disc or outside the region are dropped, and rejection goes on from the cells that remain. Both draw from a
//! superset of the free part, so that an accepted point is exactly uniform over it. When no cell remains, the free part is
//! proven empty.
//!
//! There is a possible loss: cells are not halved beyond 2⁻³⁰ of the box, nor when there are more than 65,536 of them. Then 64 draws per
//! cell and 4096 more decide, and a free part that all of them miss counts as empty. A free part with the area of a last cell is missed
//! with a probability below e⁻⁶⁴; a smaller one with a probability of at most e^(−64 · its share of a cell). Free parts with a short
//! outline end in cells of about 1e-9 m; a long thin one (a ring of rho_m, a strip along an edge) ends with larger cells, so that the loss
//! there is an area, not a width.
//! Source of the refinement: G. Zhang and S. Torquato, "Precise algorithm to generate random sequential addition of hard
//! hyperspheres at saturation", Physical Review E 88 (2013) 053312.
//!
//! Free points for the next plate.

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;

use crate::layout::error::{EmptyReason, LayoutError};
use crate::layout::free_cells::{Cells, Discs, Refinement, Space};
use crate::layout::region::{Area, Region};
use crate::layout::spacing::Spacing;
use rand::Rng;

/// Number of draws from the box before cells are used.
const BOX_DRAWS: u64 = 64;

/// Number of draws from cells that may not be refined any further, in addition to 64 for each cell. A free part that they miss counts as
/// empty.
const LAST_DRAWS: u64 = 4096;

/// Sampler that draws plates into one region with one spacing.
#[derive(Clone, Debug)]
pub struct Sampler {
    area: Area,
    spacing: Spacing,
    box_draws: u64,
}

/// Result of one layout.
#[derive(Clone, Debug, PartialEq)]
pub enum Attempt {
    /// All plates are placed: their centres `[x, y]` \[m\], base frame, in the order they were drawn.
    Placed(Vec<[f64; 2]>),
    /// There is no room for the next plate.
    DeadEnd {
        /// Number of plates placed until then.
        placed: usize,
    },
}

/// Room for a first plate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Room {
    /// A free point was found.
    Found,
    /// It is proved that there is no room.
    None,
    /// No free point was found with cells as small or as many as allowed; there may be one.
    NotFound,
}

/// Work done so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Work {
    /// Number of candidate positions drawn.
    pub(crate) draws: u64,
    /// Number of quadtree cells examined.
    pub(crate) cells: u64,
}

impl Sampler {
    /// Prepares a region and a spacing.
    ///
    /// # Errors
    ///
    /// [`LayoutError::InvalidInput`] for an invalid number, [`LayoutError::EmptyRegion`] if not even a first plate has room.
    pub fn new(region: &Region, spacing: &Spacing) -> Result<Self, LayoutError> {
        region.validate()?;
        spacing.validate()?;
        let sampler = Self {
            area: Area::new(region),
            spacing: *spacing,
            box_draws: BOX_DRAWS,
        };
        let base_radius_m = spacing.base_radius_m;
        let reason = match (
            sampler.room_for_first_plate(0.0),
            sampler.room_for_first_plate(base_radius_m),
        ) {
            (Room::Found, Room::Found) => return Ok(sampler),
            (Room::Found, _) => EmptyReason::WithinBase { base_radius_m },
            (Room::NotFound, _) => EmptyReason::TooThin,
            (Room::None, _) => EmptyReason::Disjoint,
        };
        Err(LayoutError::EmptyRegion { reason })
    }

    /// Draws `count` plates one after the other and stops at a dead end. Takes a bounded number of steps, and does not
    /// depend on the machine: the same generator state gives the same plates.
    pub fn attempt<R: Rng + ?Sized>(&self, count: usize, rng: &mut R) -> Attempt {
        self.attempt_counting(count, rng, &mut Work::default())
    }

    /// Draws one more plate beside those at `placed` (`[x, y]`, metres in the base frame): uniform over the free part of
    /// the region, or `None` when nothing is free.
    pub fn place<R: Rng + ?Sized>(&self, placed: &[[f64; 2]], rng: &mut R) -> Option<[f64; 2]> {
        let mut discs = self.no_discs(placed.len());
        placed.iter().for_each(|&centre| discs.push(centre));
        self.draw(&discs, &mut None, rng, &mut Work::default())
    }

    pub(crate) fn attempt_counting<R: Rng + ?Sized>(&self, count: usize, rng: &mut R, work: &mut Work) -> Attempt {
        let mut discs = self.no_discs(count);
        let mut cells = None;
        while discs.len() < count {
            match self.draw(&discs, &mut cells, rng, work) {
                Some(centre) => discs.push(centre),
                None => return Attempt::DeadEnd { placed: discs.len() },
            }
        }
        Attempt::Placed(discs.into_centres())
    }

    /// The next plate, or `None` at a dead end. Cells, once begun, are kept for the plates that follow.
    fn draw<R: Rng + ?Sized>(
        &self,
        discs: &Discs,
        cells: &mut Option<Cells>,
        rng: &mut R,
        work: &mut Work,
    ) -> Option<[f64; 2]> {
        let space = self.space(discs, self.spacing.base_radius_m);
        if cells.is_none() {
            let ([x, y], [width, height]) = (self.area.low(), self.area.size());
            let in_box = |rng: &mut R| [x + unit(rng) * width, y + unit(rng) * height];
            if let Some(found) = first_free(&space, self.box_draws, in_box, rng, work) {
                return Some(found);
            }
        }
        let cells = cells.get_or_insert_with(Cells::root);
        loop {
            let count = cells.len() as u64;
            let in_cells = |rng: &mut R| cells.point(&space, [unit(rng), unit(rng), unit(rng)]);
            if let Some(found) = first_free(&space, 4 + count / 4, in_cells, rng, work) {
                return Some(found);
            }
            match cells.refine(&space, &mut work.cells) {
                Refinement::Yes => {}
                Refinement::Empty => return None,
                Refinement::Exhausted => {
                    let in_cells = |rng: &mut R| cells.point(&space, [unit(rng), unit(rng), unit(rng)]);
                    return first_free(&space, LAST_DRAWS + 64 * count, in_cells, rng, work);
                }
            }
        }
    }

    fn space<'a>(&'a self, discs: &'a Discs, base_radius_m: f64) -> Space<'a> {
        Space {
            area: &self.area,
            base_radius_squared: base_radius_m * base_radius_m,
            discs,
        }
    }

    fn no_discs(&self, count: usize) -> Discs {
        Discs::new(self.spacing.min_distance_m, self.area.low(), self.area.size(), count)
    }

    /// Refines until the middle of a cell is free, so that no generator is needed.
    fn room_for_first_plate(&self, base_radius_m: f64) -> Room {
        if self.area.size().iter().any(|&s| s <= 0.0) {
            return Room::None;
        }
        let discs = self.no_discs(0);
        let space = self.space(&discs, base_radius_m);
        let mut cells = Cells::root();
        loop {
            if cells.middles(&space).any(|p| space.is_free(p)) {
                return Room::Found;
            }
            match cells.refine(&space, &mut 0) {
                Refinement::Yes => {}
                Refinement::Empty => return Room::None,
                Refinement::Exhausted => return Room::NotFound,
            }
        }
    }
}

/// Returns the first of a number of random points that is free.
fn first_free<R: Rng + ?Sized>(
    space: &Space,
    draws: u64,
    point: impl Fn(&mut R) -> [f64; 2],
    rng: &mut R,
    work: &mut Work,
) -> Option<[f64; 2]> {
    (0..draws).find_map(|_| {
        work.draws += 1;
        Some(point(rng)).filter(|&p| space.is_free(p))
    })
}

/// Returns a uniform number in [0, 1), from the upper 53 bits of one word: the same on every machine and with every version of `rand`.
fn unit<R: Rng + ?Sized>(rng: &mut R) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}
