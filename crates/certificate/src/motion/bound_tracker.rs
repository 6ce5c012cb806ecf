//! The greatest value of a quantity over time, bounded from above by halving stretches of time.
//!
//! A first pass over the ends of all pieces finds how bad it is; a second one halves each piece until its bound is no worse
//! than that by more than a resolution, and within the limit where it can be.

use crate::motion::tip::{Arm, Moment, Stretch};
use crate::report::check::ROUNDING;

/// Greatest depth of halving of a piece.
const MOST_HALVINGS: u32 = 24;

/// Halvings that one tracker may spend in any case.
const SPLITS: usize = 200_000;

/// Halvings added for every tracked piece: four levels of halving on each. A long plan is then proved as well as a short one, and the time
/// stays in proportion to the number of pieces. Washes of the IRB 120 take about three a piece.
const SPLITS_A_PIECE: usize = 15;

/// Greatest value of a quantity found so far, with its bound.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundTracker {
    limit: f64,
    resolution: f64,
    splits: usize,
    /// Worst value found, and below its time \[s\]; −∞ before the first value.
    pub seen: f64,
    pub time_s: f64,
    pub place: [f64; 3],
    /// Upper bound; −∞ before the first stretch, +∞ or NaN where none exists.
    pub bound: f64,
}

impl BoundTracker {
    /// Returns a tracker of values that must not be above `limit`. Stretches are halved until the bound is at most `resolution` above the
    /// worst value.
    pub fn new(limit: f64, resolution: f64) -> Self {
        Self {
            limit,
            resolution,
            splits: SPLITS,
            seen: f64::NEG_INFINITY,
            time_s: 0.0,
            place: [0.0; 3],
            bound: f64::NEG_INFINITY,
        }
    }

    /// Returns the tracker with its bound and its worst value mapped by a non-decreasing function.
    pub fn through(&self, scale: impl Fn(f64) -> f64) -> Self {
        Self {
            bound: scale(self.bound),
            seen: scale(self.seen),
            ..*self
        }
    }

    /// Combines two trackers of the same quantity: the worse value, and a bound for both.
    pub fn and(&self, other: &Self) -> Self {
        let mut both = if other.seen > self.seen { *other } else { *self };
        both.bound = self.bound;
        both.take(other.bound);
        both
    }

    /// Allows the halvings for a number of further pieces.
    pub fn allow_for(&mut self, pieces: usize) {
        self.splits = self.splits.saturating_add(pieces.saturating_mul(SPLITS_A_PIECE));
    }

    /// Records a value at a moment.
    pub fn see(&mut self, value: f64, time_s: f64, moment: &Moment) {
        if value > self.seen {
            self.seen = value;
            self.time_s = time_s;
            self.place = moment.position.into();
        }
    }

    /// True if a bound needs no refinement.
    pub fn accepts(&self, bound: f64) -> bool {
        let slack = ROUNDING * self.limit.abs();
        let within = self.seen + self.resolution;
        bound
            <= if self.seen > self.limit + slack {
                within
            } else {
                within.min(self.limit + slack)
            }
    }

    /// True if a bound is within the limit.
    pub fn is_within_limit(&self, bound: f64) -> bool {
        bound <= self.limit + ROUNDING * self.limit.abs()
    }

    /// Records a bound that is not refined further.
    pub fn take(&mut self, bound: f64) {
        // NaN must not get lost: nothing is proved then.
        self.bound = if bound.is_nan() || self.bound.is_nan() {
            f64::NAN
        } else {
            self.bound.max(bound)
        };
    }

    /// Returns true if another halving is allowed, and counts it.
    pub fn may_split(&mut self, depth: u32) -> bool {
        let allowed = depth < MOST_HALVINGS && self.splits > 0;
        self.splits -= usize::from(allowed);
        allowed
    }

    /// Records the values at both ends of a stretch.
    pub fn see_ends(&mut self, stretch: &Stretch<'_>, value: impl Fn(&Moment) -> f64) {
        for (moment, time_s) in stretch.ends.into_iter().zip(stretch.times()) {
            self.see(value(moment), time_s, moment);
        }
    }

    /// Bounds a stretch whose ends were recorded, by formula (0.1) in `docs/certificate.md`. `value` is ‖f‖ at a moment. `beyond` is
    /// h²/8 · sup ‖f″‖ of a stretch, with the rounding where that matters.
    pub fn refine(
        &mut self,
        arm: &Arm<'_>,
        stretch: &Stretch<'_>,
        value: &impl Fn(&Moment) -> f64,
        beyond: &impl Fn(&Stretch<'_>) -> f64,
    ) {
        self.halve(arm, stretch, (value, beyond), 0);
    }

    fn halve(
        &mut self,
        arm: &Arm<'_>,
        stretch: &Stretch<'_>,
        quantity: (&impl Fn(&Moment) -> f64, &impl Fn(&Stretch<'_>) -> f64),
        depth: u32,
    ) {
        let (value, beyond) = quantity;
        let [from, to] = stretch.ends.map(value);
        let greater = if from > to || from.is_nan() { from } else { to };
        let bound = greater + beyond(stretch);
        if self.accepts(bound) || !self.may_split(depth) {
            return self.take(bound);
        }
        let Some(halves) = arm.halves(stretch) else {
            return self.take(bound);
        };
        let halves = halves.both();
        let middle = halves[0].ends[1];
        self.see(value(middle), halves[0].times()[1], middle);
        for half in &halves {
            self.halve(arm, half, quantity, depth + 1);
        }
    }
}
