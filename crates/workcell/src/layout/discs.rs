//! The discs that earlier plates forbid to later ones.

use super::spacing::MAX_PLATES;

/// Up to here a linear search is faster than buckets.
const LINEAR_LIMIT: usize = 24;

/// At most this many buckets along x and along y.
const MAX_BUCKETS: usize = 64;

/// Discs of one radius around the plates placed so far. Many of them are kept in square buckets at least one radius wide,
/// so that a query looks at nine buckets only.
#[derive(Debug)]
pub(super) struct Discs {
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
    /// No disc yet, in a box given by its lower corner and size, about `count` of which are to come.
    pub(super) fn new(radius: f64, origin: [f64; 2], size: [f64; 2], count: usize) -> Self {
        let buckets = (count > LINEAR_LIMIT && radius > 0.0).then(|| Buckets::new(radius, origin, size));
        Self {
            radius_squared: radius * radius,
            centres: Vec::with_capacity(count.min(MAX_PLATES)),
            buckets,
        }
    }

    pub(super) fn push(&mut self, centre: [f64; 2]) {
        self.centres.push(centre);
        if let Some(buckets) = &mut self.buckets {
            let [i, j] = buckets.index(centre);
            buckets.lists[j * buckets.counts[0] + i].push(centre);
        }
    }

    pub(super) fn len(&self) -> usize {
        self.centres.len()
    }

    pub(super) fn into_centres(self) -> Vec<[f64; 2]> {
        self.centres
    }

    /// Whether a disc within one radius of `p` meets a condition on (its centre, radius squared). Discs farther from `p`
    /// may be asked as well.
    pub(super) fn any_near(&self, p: [f64; 2], condition: impl Fn([f64; 2], f64) -> bool) -> bool {
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
