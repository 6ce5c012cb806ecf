//! Shares of a plate's face that are pressed, and for how long and with which dose: bounds over cells of the face.
//!
//! Requirements 27 to 29, formulas (27.1) and (28.1) in `docs/contact.md`.
//!
//! Seen along its axis, the face is cut into squares (`face_cell.rs`), which are halved where more is likely to keep what is wanted than is
//! shown, down to a least size, until as much is shown as was asked for. Of the moments that reach a cell, one after the other, those
//! between which all of it is in contact count by what two sums differ (`doses.rs`) and are not looked at again in its quarters. What is
//! left are windows in which places of the cell leave the sponge or get under it (`leaving.rs`): together they give lower bounds of time
//! and dose that are affine over the cell (`bounds.rs` puts them together), so that of a cell at the edge of what is wanted the part counts that keeps it.
//!
//! A place that is not shown to get an amount counts as not getting it, with the greatest area that it may have. So the shares are lower
//! bounds.

pub(crate) mod bounds;
pub(crate) mod doses;
pub(crate) mod edges;
pub(crate) mod face_cell;
pub(crate) mod leaving;
pub(crate) mod look;
pub(crate) mod lower;
pub(crate) mod sags;
#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;
pub(crate) mod touch;

use crate::washing::face_shares::bounds::{CellAmounts, Passes, Scratch};
use crate::washing::face_shares::face_cell::FaceCell;
use crate::washing::face_shares::lower::Lower;
use crate::washing::face_shares::sags::Sags;
use nalgebra::Vector3;
use platewash_bodies::contact::{Foundation, Moment};
use platewash_bodies::coverage::{SMALLEST_CELL, reaches};
use platewash_workcell::job::ContactThresholds;
use platewash_workcell::surface::Surface;
use std::ops::Range;

/// Share of a cell above which the cell is halved: the part that may get the wanted amount and is not shown to.
const WORTH: f64 = 0.02;

/// Greatest edge of the first cells, as a part of the sponge's radius, and below their greatest number along an edge of the face.
const FIRST_CELLS: f64 = 0.4;
const MOST_FIRST_CELLS: f64 = 128.0;

/// Resolution at which a face is bounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// Edge of the smallest cells \[m\].
    pub cell_m: f64,
    /// Shares of the face for contact, time and dose that suffice. The face is not refined once they are shown.
    pub enough: [f64; 3],
}

/// Share of a plate's face, by its area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Lower bound on the share of the face that gets the wanted amount.
    pub at_least: f64,
    /// Middle of the smallest cell with the least amount, plate frame \[m\]; `None` where all cells get enough.
    pub worst_m: Option<[f64; 3]>,
    /// Amount there: compression \[m\], time \[s\] or dose \[Pa·m\].
    pub worst: Option<f64>,
}

/// Shares of a plate's face that get the wanted amounts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shares {
    /// Share that is compressed enough at some moment.
    pub contact: Share,
    /// Share that is in contact long enough.
    pub time: Share,
    /// Share that gets enough dose.
    pub dose: Share,
}

/// Bounds the shares of a face that get the wanted amounts through some moments in order (27 to 29). `sags[k]`, of formula (28.1), belongs to the
/// interval between the moments k and k + 1; nothing is known of an interval without one. `foundation` has s, H, c and E, `thresholds` has c_min
/// and δ.
#[must_use]
pub fn shares(
    surface: &Surface,
    foundation: &Foundation,
    (moments, sags): (&[Moment], &[Sags]),
    thresholds: &ContactThresholds,
    fineness: &Fineness,
) -> Shares {
    let rim_m = surface.rim_m();
    // An edge that is not a number, or too small to end soon, is replaced by the least one.
    let least = 0.5 * fineness.cell_m.max(SMALLEST_CELL * rim_m);
    let mut half = least;
    while half < rim_m {
        half *= 2.0;
    }
    while half > least && 2.0 * half > FIRST_CELLS * foundation.radius_m && half * MOST_FIRST_CELLS > rim_m {
        half *= 0.5;
    }
    let passes = Passes::new(surface, foundation, (moments, sags), thresholds);
    let mut missing = [MissingArea::default(); 3];
    let mut level = passes.first(half);
    let area_m2 = surface.area_m2();
    loop {
        let mut open = missing;
        level.nodes.iter().for_each(|node| node.add_missing(&mut open));
        let left = [0, 1, 2].map(|k| !reaches(open[k].share(area_m2).at_least, fineness.enough[k]));
        if half <= least || left == [false; 3] {
            let [contact, time, dose] = open.map(|missing| missing.share(area_m2));
            return Shares { contact, time, dose };
        }
        half *= 0.5;
        level = passes.halved(&level, half, left, &mut missing);
    }
}

/// Area that is not shown to get an amount.
#[derive(Debug, Clone, Copy, Default)]
struct MissingArea {
    area_m2: f64,
    /// Value and position of the worst place.
    worst: Option<(f64, [f64; 3])>,
}

impl MissingArea {
    fn add(&mut self, area_m2: f64, found: f64, place: &Vector3<f64>) {
        self.area_m2 += area_m2;
        if self.worst.is_none_or(|(worst, _)| found < worst) {
            self.worst = Some((found, (*place).into()));
        }
    }

    fn share(&self, whole_m2: f64) -> Share {
        Share {
            at_least: (1.0 - self.area_m2 / whole_m2).clamp(0.0, 1.0),
            worst_m: self.worst.map(|(_, place)| place),
            worst: self.worst.map(|(found, _)| found),
        }
    }
}

/// FaceCell that is not shown to get all wanted amounts everywhere.
struct Node {
    middle: [f64; 2],
    point: Vector3<f64>,
    /// Amounts that every place of the cell gets, so that its quarters need not look for them.
    amounts: CellAmounts,
    /// Remaining windows, as a range in its level.
    windows: Range<usize>,
    /// Upper bound on the area that does not get the wanted amount, for contact, time and dose \[m²\].
    missing_m2: [f64; 3],
    /// Part of the cell, seen along the axis, that may get it beyond the part that is shown to.
    worth: [f64; 3],
    /// Amount at the worst place of the cell.
    found: [f64; 3],
    /// Lower bounds over the cell of contact, time and dose.
    bounds: [Lower; 3],
}

impl Node {
    fn add_missing(&self, missing: &mut [MissingArea; 3]) {
        for (k, missing) in missing.iter_mut().enumerate() {
            if self.missing_m2[k] > 0.0 {
                missing.add(self.missing_m2[k], self.found[k].max(0.0), &self.point);
            }
        }
    }
}

/// Cells of one size.
#[derive(Default)]
struct Level {
    nodes: Vec<Node>,
    /// Windows of moments, each as the first and the last one.
    windows: Vec<[u32; 2]>,
}

impl Passes<'_> {
    /// Returns the first cells.
    fn first(&self, half: f64) -> Level {
        let mut level = Level::default();
        let count = (self.surface.rim_m() / (2.0 * half)).ceil() as i32;
        let (mut windows, mut scratch) = (Vec::new(), Scratch::default());
        for (i, j) in (-count..count).flat_map(|i| (-count..count).map(move |j| (i, j))) {
            let middle = [i, j].map(|k| (2.0 * f64::from(k) + 1.0) * half);
            if FaceCell::is_beyond(middle, half, self.surface.rim_m()) {
                continue;
            }
            let cell = FaceCell::new(self.surface, middle, half);
            windows.clear();
            self.windows_near(&cell, &mut windows);
            let found = (&mut level.windows, &mut scratch);
            level
                .nodes
                .extend(self.node(&cell, middle, (CellAmounts::default(), &windows), found));
        }
        level
    }

    /// Returns the quarters of those cells of a level that are likely to get amounts that are not shown yet. The others are counted as
    /// missing.
    fn halved(&self, level: &Level, half: f64, left: [bool; 3], missing: &mut [MissingArea; 3]) -> Level {
        let (mut next, mut scratch) = (Level::default(), Scratch::default());
        for node in &level.nodes {
            if !(0..3).any(|k| left[k] && node.worth[k] > WORTH) {
                node.add_missing(missing);
                continue;
            }
            let windows = level.windows.get(node.windows.clone()).unwrap_or_default();
            for (x, y) in [(-half, -half), (half, -half), (-half, half), (half, half)] {
                let middle = [node.middle[0] + x, node.middle[1] + y];
                if FaceCell::is_beyond(middle, half, self.surface.rim_m()) {
                    continue;
                }
                // What is known of the whole may do for its quarter.
                if self.below(&node.bounds.map(|bound| bound.seen_from([x, y])), half) == [0.0; 3] {
                    continue;
                }
                let cell = FaceCell::new(self.surface, middle, half);
                let found = (&mut next.windows, &mut scratch);
                next.nodes
                    .extend(self.node(&cell, middle, (node.amounts, windows), found));
            }
        }
        next
    }

    /// Bounds a cell through some windows, on top of the amounts `kept`. Returns `None` where it gets all that is wanted.
    fn node(
        &self,
        cell: &FaceCell,
        middle: [f64; 2],
        known: (CellAmounts, &[[u32; 2]]),
        (windows, scratch): (&mut Vec<[u32; 2]>, &mut Scratch),
    ) -> Option<Node> {
        let found = self.bounds(cell, known, scratch, |bounds| self.below(bounds, cell.half))?;
        let (bounds, below) = (found.bounds, found.below);
        let surely_below = self.below(&bounds.map(|bound| bound.likely()), cell.half);
        let first = windows.len();
        windows.extend(scratch.windows());
        Some(Node {
            middle,
            point: cell.point,
            amounts: found.amounts,
            windows: first..windows.len(),
            missing_m2: cell.greatest_areas(self.surface, below),
            worth: [0, 1, 2].map(|k| below[k] - surely_below[k]),
            found: [
                found.compression_m,
                bounds[1].least(cell.half),
                bounds[2].least(cell.half),
            ],
            bounds,
        })
    }

    /// Upper bounds on the shares of a cell that do not get the wanted contact, time and dose.
    fn below(&self, bounds: &[Lower; 3], half: f64) -> [f64; 3] {
        let wanted = self.edges.thresholds;
        let below = |bound: &Lower, threshold: f64| bound.share_below(threshold, half);
        // Nobody gets less than no time and no dose.
        let asked = |bound, threshold: f64| if threshold == 0.0 { 0.0 } else { below(bound, threshold) };
        [
            below(&bounds[0], 0.0),
            asked(&bounds[1], wanted.time_s),
            asked(&bounds[2], wanted.dose_pa_m),
        ]
    }
}
