//! The cells that may still hold a free point: exact sampling from however little room is left, and the proof that none is.

/// Cells are halved at most this often: to 2⁻³⁰ of the region's box, below 1e-9 m for a box of 1 m.
const MAX_LEVEL: u32 = 30;

/// More cells than this are not halved any further.
const MAX_CELLS: usize = 1 << 16;

use super::region::QuadCell;
use super::space::Space;

/// Equal rectangles of one level of a quadtree over the region's box, which together contain every free point.
#[derive(Debug)]
pub(super) struct Cells {
    level: u32,
    /// Number of discs that were there when closed cells were last sorted out.
    discs_seen: usize,
    items: Vec<[u32; 2]>,
}

/// What [`Cells::refine`] could do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refined {
    /// There are fewer or smaller cells now.
    Yes,
    /// No cell is left: there is no room, up to rounding.
    Empty,
    /// As small or as many as is allowed.
    Exhausted,
}

impl Cells {
    /// One cell, the whole box.
    pub(super) fn root() -> Self {
        Self {
            level: 0,
            discs_seen: 0,
            items: vec![[0, 0]],
        }
    }

    pub(super) fn len(&self) -> usize {
        self.items.len()
    }

    /// A uniform point of the cells, from three numbers that are uniform in [0, 1).
    pub(super) fn point(&self, space: &Space, [pick, u, v]: [f64; 3]) -> [f64; 2] {
        let index = (pick * self.items.len() as f64) as usize;
        let [i, j] = self.items[index.min(self.items.len() - 1)];
        let [width, height] = self.cell_size(space);
        let [x, y] = space.area.low();
        [x + (f64::from(i) + u) * width, y + (f64::from(j) + v) * height]
    }

    /// The middles of all cells.
    pub(super) fn middles(&self, space: &Space) -> impl Iterator<Item = [f64; 2]> {
        self.items.iter().map(|&item| self.cell(space, item).middle)
    }

    /// Sorts out the cells that new discs have closed, or, when there is no new disc, halves the cells first. Adds to
    /// `examined` the number of cells looked at.
    pub(super) fn refine(&mut self, space: &Space, examined: &mut u64) -> Refined {
        let discs_are_new = space.discs.len() > self.discs_seen;
        if !discs_are_new && (self.level == MAX_LEVEL || self.items.len() > MAX_CELLS) {
            return Refined::Exhausted;
        }
        if !discs_are_new {
            self.level += 1;
            let quarters = |[i, j]: [u32; 2]| {
                [
                    [2 * i, 2 * j],
                    [2 * i + 1, 2 * j],
                    [2 * i, 2 * j + 1],
                    [2 * i + 1, 2 * j + 1],
                ]
            };
            self.items = self.items.iter().flat_map(|&item| quarters(item)).collect();
        }
        let mut items = std::mem::take(&mut self.items);
        *examined += items.len() as u64;
        items.retain(|&item| !space.is_closed(&self.cell(space, item)));
        self.items = items;
        self.discs_seen = space.discs.len();
        if self.items.is_empty() {
            Refined::Empty
        } else {
            Refined::Yes
        }
    }

    fn cell_size(&self, space: &Space) -> [f64; 2] {
        let parts = f64::from(1_u32 << self.level);
        space.area.size().map(|s| s / parts)
    }

    fn cell(&self, space: &Space, [i, j]: [u32; 2]) -> QuadCell {
        let [width, height] = self.cell_size(space);
        let [x, y] = space.area.low();
        let middle = [x + (f64::from(i) + 0.5) * width, y + (f64::from(j) + 0.5) * height];
        QuadCell {
            middle,
            half: [0.5 * width, 0.5 * height],
        }
    }
}
