//! The greatest value of a quantity over time, bounded from above by halving stretches of time.
//!
//! A first pass over the ends of all pieces finds how bad it is; a second one halves each piece until its bound is no worse
//! than that by more than a resolution, and within the limit where it can be.

use crate::motion::tip::{Arm, Moment, Stretch};
use crate::report::check::ROUNDING;

/// How often a piece is halved at most.
const MOST_HALVINGS: u32 = 24;

/// Halvings that one tracker may spend, whatever it tracks …
const SPLITS: usize = 200_000;

/// … and for every piece more that it tracks: four levels of halving on each. So a long plan can be proved as well as a short
/// one, and none takes longer than in proportion to its pieces. Washes of the IRB 120 take three or so a piece.
const SPLITS_A_PIECE: usize = 15;

/// The greatest value of a quantity so far.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BoundTracker {
    limit: f64,
    resolution: f64,
    splits: usize,
    /// Worst value seen and its time \[s\]; −∞ before anything was.
    pub seen: f64,
    pub time_s: f64,
    pub place: [f64; 3],
    /// What no value is above; −∞ before anything was bounded, +∞ or NaN where nothing could be.
    pub bound: f64,
}

impl BoundTracker {
    /// A tracker of values that shall not be above `limit`; the bound shall be worse than the worst value by at most
    /// `resolution`.
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

    /// The same tracker in other numbers: its bound and its worst value through a function that never falls.
    pub fn through(&self, scale: impl Fn(f64) -> f64) -> Self {
        Self {
            bound: scale(self.bound),
            seen: scale(self.seen),
            ..*self
        }
    }

    /// The worse of two trackers of the same quantity, with a bound for both.
    pub fn and(&self, other: &Self) -> Self {
        let mut both = if other.seen > self.seen { *other } else { *self };
        both.bound = self.bound;
        both.take(other.bound);
        both
    }

    /// Allows for the halvings of so many pieces more.
    pub fn allow_for(&mut self, pieces: usize) {
        self.splits = self.splits.saturating_add(pieces.saturating_mul(SPLITS_A_PIECE));
    }

    /// Takes note of a value at a moment.
    pub fn see(&mut self, value: f64, time_s: f64, moment: &Moment) {
        if value > self.seen {
            self.seen = value;
            self.time_s = time_s;
            self.place = moment.position.into();
        }
    }

    /// Whether a bound needs no refinement.
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

    /// Whether a bound is within the limit.
    pub fn keeps(&self, bound: f64) -> bool {
        bound <= self.limit + ROUNDING * self.limit.abs()
    }

    /// Takes note of a bound that is not refined further.
    pub fn take(&mut self, bound: f64) {
        // NaN must not get lost: nothing is proved then.
        self.bound = if bound.is_nan() || self.bound.is_nan() {
            f64::NAN
        } else {
            self.bound.max(bound)
        };
    }

    /// Whether another halving is allowed; counts it.
    pub fn may_split(&mut self, depth: u32) -> bool {
        let allowed = depth < MOST_HALVINGS && self.splits > 0;
        self.splits -= usize::from(allowed);
        allowed
    }

    /// Sees the ends of a piece.
    pub fn see_ends(&mut self, stretch: &Stretch<'_>, value: impl Fn(&Moment) -> f64) {
        for (moment, time_s) in stretch.ends.iter().zip(stretch.times()) {
            self.see(value(moment), time_s, moment);
        }
    }

    /// Bounds a stretch whose ends were seen: `value` of a moment, and what it may be above the greater of both ends within a
    /// stretch (by its second derivative in the sense of [`crate::motion::tip`], and by rounding where that matters).
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
        let [from, to] = stretch.ends.each_ref().map(value);
        let greater = if from > to || from.is_nan() { from } else { to };
        let bound = greater + beyond(stretch);
        if self.accepts(bound) || !self.may_split(depth) {
            return self.take(bound);
        }
        let Some(halves) = arm.halves(stretch) else {
            return self.take(bound);
        };
        self.see(value(&halves[0].ends[1]), halves[0].times()[1], &halves[0].ends[1]);
        for half in &halves {
            self.halve(arm, half, quantity, depth + 1);
        }
    }
}
