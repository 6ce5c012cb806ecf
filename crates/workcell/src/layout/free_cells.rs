//! Cells that may still hold a free point: exact sampling from any small remaining room, and the proof that none is left.
//!
//! Discs around earlier plates that are forbidden to later ones.

use crate::layout::count::MAX_PLATES;
use crate::layout::region::{Area, QuadCell};

/// Greatest number of halvings of cells: to 2⁻³⁰ of the region's box, below 1e-9 m for a box of 1 m.
const MAX_LEVEL: u32 = 30;

/// Number of cells above which they are not halved any further.
const MAX_CELLS: usize = 1 << 16;

/// Equal rectangles of one level of a quadtree over the region's box. Together they contain every free point.
#[derive(Debug)]
pub(crate) struct Cells {
    level: u32,
    /// Number of discs at the time when closed cells were last removed.
    discs_seen: usize,
    items: Vec<[u32; 2]>,
}

/// Result of [`Cells::refine`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Refinement {
    /// There are fewer or smaller cells.
    Yes,
    /// No cell is left: there is no room, up to rounding.
    Empty,
    /// The cells are as small or as many as allowed.
    Exhausted,
}

impl Cells {
    /// Returns one cell, the whole box.
    pub(crate) fn root() -> Self {
        Self {
            level: 0,
            discs_seen: 0,
            items: vec![[0, 0]],
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.items.len()
    }

    /// Returns a uniform point of the cells, from three numbers that are uniform in [0, 1).
    pub(crate) fn point(&self, space: &Space, [pick, u, v]: [f64; 3]) -> [f64; 2] {
        let index = (pick * self.items.len() as f64) as usize;
        let [i, j] = self.items[index.min(self.items.len() - 1)];
        let [width, height] = self.cell_size(space);
        let [x, y] = space.area.low();
        [x + (f64::from(i) + u) * width, y + (f64::from(j) + v) * height]
    }

    /// Returns the middles of all cells.
    pub(crate) fn middles(&self, space: &Space) -> impl Iterator<Item = [f64; 2]> {
        self.items.iter().map(|&item| self.cell(space, item).middle)
    }

    /// Removes the cells that new discs have closed or, if there is no new disc, halves the cells first. Adds the number of examined cells
    /// to `examined`.
    pub(crate) fn refine(&mut self, space: &Space, examined: &mut u64) -> Refinement {
        let discs_are_new = space.discs.len() > self.discs_seen;
        if !discs_are_new && (self.level == MAX_LEVEL || self.items.len() > MAX_CELLS) {
            return Refinement::Exhausted;
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
            Refinement::Empty
        } else {
            Refinement::Yes
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

/// Number of discs up to which a linear search is faster than buckets.
const LINEAR_LIMIT: usize = 24;

/// Greatest number of buckets along x and along y.
const MAX_BUCKETS: usize = 64;

/// Discs of one radius around the plates placed so far. Large numbers of them are kept in square buckets at least one radius wide, so that
/// a query examines nine buckets only.
#[derive(Debug)]
pub(crate) struct Discs {
    radius_squared: f64,
    centres: Vec<[f64; 2]>,
    buckets: Option<Buckets>,
}

#[derive(Debug)]
struct Buckets {
    origin: [f64; 2],
    per_metre: [f64; 2],
    counts: [usize; 2],
    lists: Vec<Vec<[f64; 2]>>,
}

impl Discs {
    /// Returns an empty set in a box given by its lower corner and size, for about `count` discs.
    pub(crate) fn new(radius: f64, origin: [f64; 2], size: [f64; 2], count: usize) -> Self {
        let buckets = (count > LINEAR_LIMIT && radius > 0.0).then(|| Buckets::new(radius, origin, size));
        Self {
            radius_squared: radius * radius,
            centres: Vec::with_capacity(count.min(MAX_PLATES)),
            buckets,
        }
    }

    pub(crate) fn push(&mut self, centre: [f64; 2]) {
        self.centres.push(centre);
        if let Some(buckets) = &mut self.buckets {
            let [i, j] = buckets.index(centre);
            buckets.lists[j * buckets.counts[0] + i].push(centre);
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.centres.len()
    }

    pub(crate) fn into_centres(self) -> Vec<[f64; 2]> {
        self.centres
    }

    /// True if a disc within one radius of `p` meets a condition on its centre and its squared radius. Discs farther from `p` may be
    /// examined as well.
    pub(crate) fn any_near(&self, p: [f64; 2], condition: impl Fn([f64; 2], f64) -> bool) -> bool {
        let met = |centres: &[[f64; 2]]| centres.iter().any(|&centre| condition(centre, self.radius_squared));
        match &self.buckets {
            None => met(&self.centres),
            Some(buckets) => buckets.around(p).any(met),
        }
    }
}

impl Buckets {
    fn new(radius: f64, origin: [f64; 2], size: [f64; 2]) -> Self {
        // A little wider than one radius, so that rounding cannot make a bucket narrower.
        let counts = size.map(|s| ((s / (radius * 1.000_001)) as usize).clamp(1, MAX_BUCKETS));
        let per_metre = [counts[0] as f64 / size[0], counts[1] as f64 / size[1]];
        Self {
            origin,
            per_metre,
            counts,
            lists: vec![Vec::new(); counts[0] * counts[1]],
        }
    }

    fn index(&self, p: [f64; 2]) -> [usize; 2] {
        // A cast from float saturates: what lies below the box falls into bucket 0.
        [0, 1].map(|k| (((p[k] - self.origin[k]) * self.per_metre[k]) as usize).min(self.counts[k] - 1))
    }

    fn around(&self, p: [f64; 2]) -> impl Iterator<Item = &[[f64; 2]]> {
        let [i, j] = self.index(p);
        let columns = i.saturating_sub(1)..=(i + 1).min(self.counts[0] - 1);
        let rows = j.saturating_sub(1)..=(j + 1).min(self.counts[1] - 1);
        rows.flat_map(move |row| {
            columns
                .clone()
                .map(move |column| self.lists[row * self.counts[0] + column].as_slice())
        })
    }
}

/// The region, the free space around the base, and the discs around earlier plates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Space<'a> {
    pub(crate) area: &'a Area,
    pub(crate) base_radius_squared: f64,
    pub(crate) discs: &'a Discs,
}

impl Space<'_> {
    /// True if a point is in the region and strictly outside of every disc.
    pub(crate) fn is_free(&self, p: [f64; 2]) -> bool {
        p[0] * p[0] + p[1] * p[1] > self.base_radius_squared
            && !self.discs.any_near(p, |[x, y], radius_squared| {
                let (dx, dy) = (p[0] - x, p[1] - y);
                dx * dx + dy * dy <= radius_squared
            })
            && self.area.contains(p)
    }

    /// True if a cell of the region's box certainly holds no free point: it lies wholly in one disc or outside the region.
    pub(crate) fn is_closed(&self, cell: &QuadCell) -> bool {
        cell.farthest_squared([0.0; 2]) <= self.base_radius_squared
            || self.discs.any_near(cell.middle, |centre, radius_squared| {
                cell.farthest_squared(centre) <= radius_squared
            })
            || self.area.excludes(cell)
    }
}
