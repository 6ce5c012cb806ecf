//! Values ordered by a number, for heaps.

use std::cmp::Ordering;

/// Value with a rank. The order is that of the ranks, and among equal ones that of `order`; the value itself does not count.
#[derive(Debug, Clone, Copy)]
pub struct Ranked<T> {
    /// Rank, in the total order of floating-point numbers.
    pub rank: f64,
    /// Order among equal ranks.
    pub order: usize,
    /// Value.
    pub value: T,
}

impl<T> Ord for Ranked<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.rank.total_cmp(&other.rank).then(self.order.cmp(&other.order))
    }
}

impl<T> PartialOrd for Ranked<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> PartialEq for Ranked<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<T> Eq for Ranked<T> {}
