//! The dose that every place of a cell gets near the edges of its time in contact.
//!
//! Over the patch the compression is at least that over its middle less the greatest loss over the patch. The sponge slides in a direction
//! d at least as fast as over the middle less ω times the greatest distance of a place from there. Between two moments both are above lines
//! through their values at the ends, less their sags; and a place in contact is compressed by no less than the compression that counts. So
//! its dose until a time is at least a function Q of that time, the integral of a product of two lines; near t₀, where that product is
//! between q₀ and q₁, Q(t₀ + u) is at least Q(t₀) + (q₀ + q₁)/2 u − (q₁ − q₀)/2 |u|.
//!
//! The dose of any place over a run of moments comes from sums.
//!
//! Between two moments h apart the compression at a point x is at least a line in time less its sag, and the sliding speed is at least that
//! in one direction d, another line less its sag: w(x) = (c + p·a) − a·x and v(x) = d·P(ṗ + ω × (x − p)), both affine in x. Where w is not
//! below 0 their product is not above the true one, whatever the sign of v, and its integral
//!
//! h ((w₀ + w₁)(v₀ + v₁)/4 + (w₁ − w₀)(v₁ − v₀)/12)
//!
//! is a polynomial of the second degree in x. So one sum from the first moment on tells the dose of every place that is in contact all
//! along a run, as the difference of two.

use crate::washing::face_shares::edges::{Edges, Gain, LeavingTimes, Window};
use crate::washing::face_shares::face_cell::{CellState, FaceCell};
use crate::washing::face_shares::lower::Lower;
use crate::washing::face_shares::sags::Sags;
use nalgebra::{Matrix3, Vector3, Vector4};
use platewash_bodies::contact::{Foundation, Moment, SpongePose, at_least_0, both};
use std::ops::{Add, Sub};

/// Lower bounds of the factors of q at a moment: compression \[m\] and sliding speed \[m/s\].
#[derive(Clone, Copy)]
struct Factors {
    at_s: f64,
    compression_m: f64,
    speed_m_s: f64,
    /// Likely upper bounds on the amounts by which the true factors exceed these.
    spread: [f64; 2],
}

impl Factors {
    fn towards(&self, other: &Self, share: f64) -> Self {
        let mean = |from: f64, to: f64| from + (to - from) * share;
        Self {
            at_s: mean(self.at_s, other.at_s),
            compression_m: mean(self.compression_m, other.compression_m),
            speed_m_s: mean(self.speed_m_s, other.speed_m_s),
            spread: self.spread,
        }
    }

    /// Likely upper bound on the amount by which the true q exceeds this one.
    fn likely_excess(&self) -> f64 {
        let [w, v] = self.spread;
        (self.compression_m + w) * (self.speed_m_s + v) - self.compression_m * self.speed_m_s
    }
}

impl Edges<'_> {
    /// Returns a lower bound on the dose of a cell from the first moment of a window until its places leave \[Pa·m\]: E/H times Q(t₀ + u)
    /// of the head of this file, E the least stiffness. `leaving` has t₀ and u = g·δ + g_e e − η (`leaving.rs`).
    pub(crate) fn dose(&self, cell: &FaceCell, window: Window<'_>, leaving: &LeavingTimes) -> Lower {
        let LeavingTimes {
            at_s,
            sooner_s,
            spread_s,
            ..
        } = *leaving;
        let first_s = at_s - spread_s - sooner_s;
        let direction = self.direction(cell, window, leaving.last);
        let (mut until, mut slack) = (0.0, 0.0);
        let mut rates = [f64::INFINITY, 0.0_f64];
        let mut before: Option<(&CellState, Factors)> = None;
        for seen in window.states_until(leaving.last) {
            let here = self.factors(cell, seen, &direction, self.elapsed_s(window, seen));
            if let Some((last, before)) = before {
                let ends = self.between([last, seen], [before, here]);
                if here.at_s > first_s {
                    let [a, b] = &ends;
                    let least = a.compression_m.min(b.compression_m) * a.speed_m_s.min(b.speed_m_s);
                    let most = a.compression_m.max(b.compression_m) * a.speed_m_s.max(b.speed_m_s);
                    rates = [rates[0].min(least), rates[1].max(most)];
                }
                let share = ((at_s - before.at_s) / (here.at_s - before.at_s)).min(1.0);
                if share > 0.0 {
                    let to = ends[0].towards(&ends[1], share);
                    let along_s = to.at_s - before.at_s;
                    until += along_s * mean_product(&ends[0], &to);
                    slack += along_s * ends[0].likely_excess();
                }
            }
            before = Some((seen, here));
        }
        let [low, high] = rates;
        if !(low.is_finite() && high.is_finite() && until.is_finite()) {
            return Lower::default();
        }
        let pressure = self.pressure();
        let (rate, off) = (
            0.5 * pressure * (low + high),
            0.5 * pressure * (high - low) * (spread_s + sooner_s),
        );
        Lower {
            value: pressure * until - rate * sooner_s - off,
            slope: leaving.slope.map(|slope| rate * slope),
            over_height: rate * leaving.over_height,
            slack: pressure * (slack + high * sooner_s) + 2.0 * off,
        }
    }

    /// Pressure of the softest foam per compression, E/H of formula (27.1) \[Pa/m\].
    fn pressure(&self) -> f64 {
        self.foundation.pressure_pa_m()[0]
    }

    /// Sliding velocity of the sponge over the middle of a cell, across the sponge's axis \[m/s\].
    fn slide(&self, cell: &FaceCell, state: &CellState) -> Vector3<f64> {
        let moment = self.moment(state.index);
        let SpongePose { tip, axis } = &moment.pose;
        let slide = moment.speed + moment.turning.cross(&(cell.point - tip));
        slide - axis * slide.dot(axis)
    }

    /// Mean sliding direction over a window, a unit vector.
    fn direction(&self, cell: &FaceCell, window: Window<'_>, last: usize) -> Vector3<f64> {
        let ends =
            [window.at(0), window.at(last)].map(|seen| seen.map_or_else(Vector3::zeros, |seen| self.slide(cell, seen)));
        (ends[0] + ends[1]).try_normalize(0.0).unwrap_or_else(Vector3::zeros)
    }

    /// Returns the factors at a moment.
    fn factors(&self, cell: &FaceCell, state: &CellState, direction: &Vector3<f64>, at_s: f64) -> Factors {
        self.factors_of(cell, state, &self.slide(cell, state), direction, at_s)
    }

    /// Returns the factors at a moment, from the sliding velocity.
    fn factors_of(
        &self,
        cell: &FaceCell,
        state: &CellState,
        slide: &Vector3<f64>,
        direction: &Vector3<f64>,
        at_s: f64,
    ) -> Factors {
        let look = self.look(state.index);
        let turning = look.turning;
        let away = turning * (cell.max_distance_m() + self.thresholds.height_error_m);
        Factors {
            at_s,
            compression_m: state.compression_m - look.shallower_m(state.sloping_m),
            speed_m_s: slide.dot(direction) - away,
            spread: [2.0 * state.sloping_m, 2.0 * turning * cell.max_distance_m()],
        }
    }

    /// Returns lines between two moments that bound the factors of every place in contact from below: compression not below the one that
    /// counts, speed not below 0.
    fn between(&self, seen: [&CellState; 2], ends: [Factors; 2]) -> [Factors; 2] {
        let sags = self.sags(seen[0], seen[1]);
        let slower = sags.slide_m / (ends[1].at_s - ends[0].at_s);
        let above = |a: f64, b: f64, least: f64| {
            if a >= least && b >= least {
                (a, b)
            } else {
                let low = a.min(b).max(least);
                (low, low)
            }
        };
        let [mut from, mut to] = ends;
        (from.compression_m, to.compression_m) = above(
            from.compression_m - sags.compression_m,
            to.compression_m - sags.compression_m,
            self.thresholds.compression_m,
        );
        (from.speed_m_s, to.speed_m_s) = above(from.speed_m_s - slower, to.speed_m_s - slower, 0.0);
        [from, to]
    }

    /// Returns the gain that places of a large cell are likely to get at most through a window in which not all of it is in contact. The
    /// proved gain is 0.
    pub(crate) fn greatest_likely_gain(&self, cell: &FaceCell, window: &[CellState]) -> Gain {
        let near = |state: &&CellState| {
            state.pressed_m + 2.0 * state.sloping_m >= 0.0 && state.inside_m + 2.0 * cell.max_distance_m() >= 0.0
        };
        let (Some(first), Some(last)) = (window.iter().find(near), window.iter().rfind(near)) else {
            return Gain::default();
        };
        let along_s = self.moment(last.index).t_s - self.moment(first.index).t_s;
        let most_m = window
            .iter()
            .map(|seen| seen.compression_m + seen.sloping_m)
            .fold(0.0, f64::max);
        let fastest = [first, last].map(|seen| self.slide(cell, seen).norm());
        Gain {
            time: Lower::flat(0.0, along_s),
            dose: Lower::flat(0.0, self.pressure() * most_m * fastest[0].max(fastest[1]) * along_s),
            until_s: 0.0,
        }
    }

    /// Returns the time and dose that all of a cell gets between two moments, with the likely slack; `None` if there is neither.
    #[inline]
    pub(crate) fn flat(&self, cell: &FaceCell, ends: [&CellState; 2]) -> Option<Gain> {
        let sags = self.sags(ends[0], ends[1]);
        // Smaller cells help against what differs over this one alone.
        let likely = common(
            ends.map(|end| end.pressed_m - sags.compression_m + 2.0 * end.sloping_m),
            ends.map(|end| end.inside_m - sags.aside_m + 2.0 * cell.max_distance_m()),
        );
        likely.map(|likely| self.flat_within(cell, ends, sags, likely))
    }

    /// Returns the gain of [`Self::flat`] in the part of the interval in which places of the cell are likely to be in contact.
    fn flat_within(&self, cell: &FaceCell, ends: [&CellState; 2], sags: &Sags, [from, to]: [f64; 2]) -> Gain {
        let least = common(
            ends.map(|end| end.pressed_m - sags.compression_m),
            ends.map(|end| end.inside_m - sags.aside_m),
        );
        let slides = ends.map(|end| self.slide(cell, end));
        let direction = (slides[0] + slides[1])
            .try_normalize(0.0)
            .unwrap_or_else(Vector3::zeros);
        let whole_s = self.look(ends[1].index).t_s - self.look(ends[0].index).t_s;
        let factors = [
            self.factors_of(cell, ends[0], &slides[0], &direction, 0.0),
            self.factors_of(cell, ends[1], &slides[1], &direction, whole_s),
        ];
        let lines = self.between(ends, factors);
        let pressure = self.pressure();
        let (mut time_s, mut dose) = (0.0, 0.0);
        if let Some(shares) = least {
            let [from, to] = shares.map(|share| lines[0].towards(&lines[1], share));
            time_s = to.at_s - from.at_s;
            dose = pressure * time_s * mean_product(&from, &to);
        }
        let hope_s = (to - from) * whole_s;
        let most = |of: fn(&Factors) -> f64| of(&factors[0]).max(of(&factors[1]));
        let hope = pressure * hope_s * most(|f| f.compression_m + f.spread[0]) * most(|f| f.speed_m_s + f.spread[1]);
        Gain {
            time: Lower::flat(time_s, hope_s - time_s),
            dose: Lower::flat(dose, hope - dose),
            until_s: 0.0,
        }
    }
}

/// Part of the interval between two moments, as parameters 0 to 1, in which both values are not below 0.
fn common(pressed: [f64; 2], inside: [f64; 2]) -> Option<[f64; 2]> {
    both(at_least_0(pressed)?, at_least_0(inside)?)
}

/// Mean of the product of two lines: (w₀ + w₁)(v₀ + v₁)/4 + (w₁ − w₀)(v₁ − v₀)/12. `from` is w₀ and v₀, `to` is w₁ and v₁.
fn mean_product(from: &Factors, to: &Factors) -> f64 {
    let (w, v) = (from.compression_m + to.compression_m, from.speed_m_s + to.speed_m_s);
    let (dw, dv) = (to.compression_m - from.compression_m, to.speed_m_s - from.speed_m_s);
    0.25 * w * v + dw * dv / 12.0
}

/// Polynomial of the second degree in the place: k + l·x + xᵀ Q x \[Pa·m\].
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Polynomial {
    constant: f64,
    linear: Vector3<f64>,
    square: Matrix3<f64>,
}

/// Affine function of the place, k + l·x: l, then k.
type Affine = Vector4<f64>;

/// Cumulative doses from the first moment on.
#[derive(Debug)]
pub(crate) struct Sums {
    sums: Vec<Polynomial>,
    /// Bound on the rounding error of any difference of two of them, over the plate \[Pa·m\].
    rounding: f64,
}

impl Sums {
    /// Builds the sums of some moments, for places no farther than `far_m` from the origin.
    pub fn new(foundation: &Foundation, (moments, sags): (&[Moment], &[Sags]), far_m: f64) -> Self {
        let mut sums = vec![Polynomial::default()];
        let (mut sum, mut size) = (Polynomial::default(), 0.0);
        for (pair, sags) in moments.windows(2).zip(sags) {
            let part = Polynomial::of_pair(foundation, [&pair[0], &pair[1]], sags);
            // A dose that is not finite belongs to a pair of moments that is in no run.
            if part.size(far_m).is_finite() {
                sum = sum + part;
                size += part.size(far_m);
            }
            sums.push(sum);
        }
        // Each of n sums of some ten products is off by no more than some 10 n units of its last place.
        let rounding = 1e-15 * (10.0 + sums.len() as f64) * size;
        Self { sums, rounding }
    }

    /// Returns the dose between two moments, `from` not after `to`.
    pub fn between(&self, from: u32, to: u32) -> Polynomial {
        match (self.sums.get(from as usize), self.sums.get(to as usize)) {
            (Some(from), Some(to)) => *to - *from,
            _ => Polynomial::default(),
        }
    }

    /// Bound on the rounding error of a dose \[Pa·m\].
    pub const fn rounding(&self) -> f64 {
        self.rounding
    }
}

impl Polynomial {
    /// Returns a lower bound on the dose between two moments h apart, as a polynomial of the place: E/H times the integral of the head of this
    /// file, E the least stiffness. `sags` are those of formula (28.1).
    fn of_pair(foundation: &Foundation, ends: [&Moment; 2], sags: &Sags) -> Self {
        let whole_s = ends[1].t_s - ends[0].t_s;
        let slides = ends.map(|end| across(&end.speed, &end.pose.axis));
        let direction = (slides[0] + slides[1])
            .try_normalize(0.0)
            .unwrap_or_else(Vector3::zeros);
        let [w0, w1] = ends.map(|end| {
            let constant = foundation.compression_m + end.pose.tip.dot(&end.pose.axis) - sags.compression_m;
            (-end.pose.axis).push(constant)
        });
        let [v0, v1] = ends.map(|end| {
            let direction = across(&direction, &end.pose.axis);
            // d·(ω × x) = (d × ω)·x.
            let linear = direction.cross(&end.turning);
            let constant = direction.dot(&end.speed) - linear.dot(&end.pose.tip) - sags.slide_m / whole_s;
            linear.push(constant)
        });
        let pressure = foundation.pressure_pa_m()[0];
        let [even, odd] = [w0 + w1, w1 - w0];
        let [v_even, v_odd] = [v0 + v1, v1 - v0];
        let scales = [0.25 * pressure * whole_s, pressure * whole_s / 12.0];
        Self::product(&(even * scales[0]), &v_even) + Self::product(&(odd * scales[1]), &v_odd)
    }

    fn product(a: &Affine, b: &Affine) -> Self {
        Self {
            constant: a.w * b.w,
            linear: a.xyz() * b.w + b.xyz() * a.w,
            square: a.xyz() * b.xyz().transpose(),
        }
    }

    /// Returns the value and the gradient at a place.
    pub fn at(&self, place: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let turned = self.square * place;
        (
            self.constant + self.linear.dot(place) + place.dot(&turned),
            self.linear + turned + self.square.transpose() * place,
        )
    }

    /// Bound on the difference from the tangent at a place, up to the distance `away_m` from it.
    pub fn bend(&self, away_m: f64) -> f64 {
        self.square.norm() * away_m * away_m
    }

    fn size(&self, far_m: f64) -> f64 {
        self.constant.abs() + self.linear.norm() * far_m + self.bend(far_m)
    }
}

/// Part of a vector across an axis.
fn across(v: &Vector3<f64>, axis: &Vector3<f64>) -> Vector3<f64> {
    v - axis * v.dot(axis)
}

impl Add for Polynomial {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            constant: self.constant + other.constant,
            linear: self.linear + other.linear,
            square: self.square + other.square,
        }
    }
}

impl Sub for Polynomial {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self {
            constant: self.constant - other.constant,
            linear: self.linear - other.linear,
            square: self.square - other.square,
        }
    }
}
