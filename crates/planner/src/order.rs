//! The order of the plates that takes the least travel time.

use platewash_workcell::cancel::{CancelToken, Cancelled};
use serde::Serialize;

/// Up to this many plates the order is exact.
pub const EXACT_UP_TO: usize = 12;

/// Times \[s\] from home to each plate, between plates (row: from), and from each plate home.
#[derive(Debug, Clone, PartialEq)]
pub struct TravelTimes {
    /// Travel time from home to each plate.
    pub out: Vec<f64>,
    /// Travel time from the plate of the row to the plate of the column.
    pub between: Vec<Vec<f64>>,
    /// Travel time from each plate to home.
    pub back: Vec<f64>,
}

/// Proof level of an order: the best of all, or only a local optimum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Optimality {
    /// No order takes less.
    Exact,
    /// No exchange of two stretches, and no move of up to three plates, makes it better.
    Local,
}

impl TravelTimes {
    /// Time of a whole tour from home to home \[s\].
    #[must_use]
    pub fn duration_s(&self, order: &[usize]) -> f64 {
        let (Some(&first), Some(&last)) = (order.first(), order.last()) else {
            return 0.0;
        };
        let between: f64 = order.windows(2).map(|pair| self.between[pair[0]][pair[1]]).sum();
        self.out[first] + between + self.back[last]
    }

    /// Always the plate that is reached soonest; ties go to the lower index.
    #[must_use]
    pub fn nearest_next(&self) -> Vec<usize> {
        let mut open: Vec<usize> = (0..self.out.len()).collect();
        let mut order: Vec<usize> = Vec::with_capacity(open.len());
        while !open.is_empty() {
            let time = |plate: usize| match order.last() {
                None => self.out[plate],
                Some(&last) => self.between[last][plate],
            };
            let next = (0..open.len())
                .min_by(|&a, &b| time(open[a]).total_cmp(&time(open[b])))
                .unwrap_or(0);
            order.push(open.remove(next));
        }
        order
    }

    /// The best order: exact up to [`EXACT_UP_TO`] plates (dynamic programming over subsets, Held & Karp 1962), beyond that
    /// nearest-next improved by exchanges (2-opt and or-opt; Croes 1958, Or 1976) until none helps.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn best(&self, cancel: &CancelToken) -> Result<(Vec<usize>, Optimality), Cancelled> {
        if self.out.len() <= EXACT_UP_TO {
            return Ok((self.exact(), Optimality::Exact));
        }
        Ok((self.improved(self.nearest_next(), cancel)?, Optimality::Local))
    }

    /// `T(S, j) = min over i in S∖j of T(S∖j, i) + between(i, j)`.
    fn exact(&self) -> Vec<usize> {
        let n = self.out.len();
        if n == 0 {
            return Vec::new();
        }
        let states = 1_usize << n;
        let mut least = vec![f64::INFINITY; states * n];
        let mut before = vec![usize::MAX; states * n];
        for j in 0..n {
            least[(1 << j) * n + j] = self.out[j];
        }
        for set in 1..states {
            for j in (0..n).filter(|j| set >> j & 1 == 1) {
                let here = least[set * n + j];
                for k in (0..n).filter(|k| set >> k & 1 == 0) {
                    let state = (set | 1 << k) * n + k;
                    let time = here + self.between[j][k];
                    if time < least[state] {
                        (least[state], before[state]) = (time, j);
                    }
                }
            }
        }
        let mut set = states - 1;
        let total = |j: &usize| least[set * n + j] + self.back[*j];
        let mut last = (0..n).min_by(|a, b| total(a).total_cmp(&total(b))).unwrap_or(0);
        let mut order = vec![last];
        while before[set * n + last] != usize::MAX {
            let previous = before[set * n + last];
            set &= !(1 << last);
            last = previous;
            order.push(last);
        }
        order.reverse();
        order
    }

    fn improved(&self, mut order: Vec<usize>, cancel: &CancelToken) -> Result<Vec<usize>, Cancelled> {
        let mut time = self.duration_s(&order);
        // Each round gains at least this share, so that there are finitely many.
        let enough = |new: f64, old: f64| new < old * (1.0 - 1e-9);
        loop {
            let mut better = None;
            for other in self.neighbours(&order) {
                cancel.check()?;
                if enough(self.duration_s(&other), time) {
                    better = Some(other);
                    break;
                }
            }
            match better {
                Some(other) => (time, order) = (self.duration_s(&other), other),
                None => return Ok(order),
            }
        }
    }

    /// Orders with one stretch reversed, or one to three plates moved elsewhere.
    fn neighbours<'a>(&'a self, order: &'a [usize]) -> impl Iterator<Item = Vec<usize>> + 'a {
        let n = order.len();
        let reversed = (0..n)
            .flat_map(move |a| (a + 2..=n).map(move |b| (a, b)))
            .map(|(a, b)| {
                let mut other = order.to_vec();
                other[a..b].reverse();
                other
            });
        let stretches = (1..=3).flat_map(move |length| (0..=n - length).map(move |from| (from, length)));
        let moved = stretches.flat_map(move |(from, length)| {
            (0..=n - length).filter(move |to| *to != from).map(move |to| {
                let mut other = order.to_vec();
                let stretch: Vec<_> = other.drain(from..from + length).collect();
                other.splice(to..to, stretch);
                other
            })
        });
        reversed.chain(moved)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn times(n: std::ops::Range<usize>) -> impl Strategy<Value = TravelTimes> {
        n.prop_flat_map(|n| {
            let row = move || prop::collection::vec(0.1..5.0f64, n);
            (row(), prop::collection::vec(row(), n), row()).prop_map(|(out, between, back)| TravelTimes {
                out,
                between,
                back,
            })
        })
    }

    fn permutations(n: usize) -> Vec<Vec<usize>> {
        if n == 0 {
            return vec![vec![]];
        }
        let smaller = permutations(n - 1);
        let with = |at: usize| {
            smaller.iter().map(move |p| {
                let mut p = p.clone();
                p.insert(at, n - 1);
                p
            })
        };
        (0..n).flat_map(with).collect()
    }

    proptest! {
        #[test]
        fn no_order_beats_the_exact_one(times in times(1..7)) {
            let (best, optimality) = times.best(&CancelToken::new()).unwrap();
            prop_assert_eq!(optimality, Optimality::Exact);
            let least = permutations(times.out.len()).iter().map(|p| times.duration_s(p)).fold(f64::INFINITY, f64::min);
            prop_assert!((times.duration_s(&best) - least).abs() < 1e-12);
        }

        #[test]
        fn many_plates_come_once_each_and_no_slower_than_nearest_next(times in times(13..20)) {
            let (best, optimality) = times.best(&CancelToken::new()).unwrap();
            prop_assert_eq!(optimality, Optimality::Local);
            let mut sorted = best.clone();
            sorted.sort_unstable();
            prop_assert_eq!(sorted, (0..times.out.len()).collect::<Vec<_>>());
            prop_assert!(times.duration_s(&best) <= times.duration_s(&times.nearest_next()));
        }
    }

    #[test]
    fn an_empty_tour_takes_no_time() {
        let none = TravelTimes {
            out: vec![],
            between: vec![],
            back: vec![],
        };
        assert!(none.best(&CancelToken::new()).unwrap().0.is_empty() && none.duration_s(&[]) == 0.0);
    }
}
