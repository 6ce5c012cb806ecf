//! Limits on one interval between two knots, as constraints on x = ṡ² at its ends.
//!
//! Between knots the motion is the cubic Hermite piece of the promised trajectory, not the path itself. With σ = √x,
//! duration `h = 2 Δ / (σ₀ + σ₁)` (s̈ constant), `d = (q₁ − q₀)/Δ` and slopes `q′`, its accelerations at the ends are
//!
//! `2 Δ q̈₀ = (3 d − 4 q′₀) x₀ + (3 d − 2 q′₁) x₁ + (6 d − 4 q′₀ − 2 q′₁) σ₀ σ₁`,
//! `2 Δ q̈₁ = (2 q′₀ − 3 d) x₀ + (4 q′₁ − 3 d) x₁ + (2 q′₀ + 4 q′₁ − 6 d) σ₀ σ₁`.
//!
//! `σ₀ σ₁ = (x₀ + x₁)/2 − (σ₁ − σ₀)²/2`; without the last term, which is of second order in h, both are linear in
//! (x₀, x₁). As a piece's acceleration is a line in time, its ends are all that counts. So a joint's limit is a pair of
//! strips `|α x₀ + β x₁| ≤ 1`, and the tip's is the same with vectors. The effect of the dropped term is found when the motion is
//! checked, and then taken off the interval's limits ([`Interval::tighten_joints`]).
//!
//! The linear program of one interval: the largest x₀ from which some x₁ within limits can be reached.
//!
//! Two variables, so that Seidel's incremental algorithm solves it exactly: go through the constraints; where the
//! optimum so far breaks one, the new optimum lies on that constraint's line, and is the end of an intersection of
//! intervals (de Berg et al., *Computational Geometry*, §4.4). The constraint that bound last is taken first at the next
//! interval. The tip's limit, an ellipse, enters as its tangents where the optimum breaks it (Kelley 1960), and the last
//! thousandth of a per cent by scaling the answer.

use crate::timing::grid::PathKnot;
use crate::timing::limits::MotionLimits;
use nalgebra::Vector3;
use platewash_kinematics::AXES;

/// Strips of an interval: six joints at both ends.
pub(crate) const STRIPS: usize = 2 * AXES;

/// The acceleration limits of an interval, each scaled to 1.
#[derive(Debug, Clone)]
pub(crate) struct Interval {
    /// Length in s.
    pub width: f64,
    /// α of the strips.
    pub at_start: [f64; STRIPS],
    /// β of the strips.
    pub at_end: [f64; STRIPS],
    /// The tip's acceleration at both ends.
    pub tip: Option<[VectorStrip; 2]>,
    /// Divisor of the joints' limits.
    joints_tightened: f64,
    /// Divisor of the tip's limit.
    tip_tightened: f64,
}

/// `|A x₀ + B x₁| ≤ 1`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VectorStrip {
    /// A.
    pub at_start: Vector3<f64>,
    /// B.
    pub at_end: Vector3<f64>,
}

impl VectorStrip {
    /// A x₀ + B x₁.
    #[inline]
    pub fn at(&self, x: [f64; 2]) -> Vector3<f64> {
        self.at_start * x[0] + self.at_end * x[1]
    }

    /// The largest x₁ with |A x₀ + B x₁| ≤ 1, given that there is one.
    #[inline]
    fn furthest(&self, x0: f64) -> f64 {
        let (b, c) = (self.at_end, self.at_start * x0);
        let (a, half, rest) = (b.norm_squared(), b.dot(&c), c.norm_squared() - 1.0);
        if a <= 0.0 {
            return f64::INFINITY;
        }
        let root = (half * half - a * rest).max(0.0).sqrt();
        // The numerically stable form of the larger root (Numerical Recipes, §5.6).
        if half > 0.0 {
            -rest / (half + root)
        } else {
            (root - half) / a
        }
    }
}

impl Interval {
    /// The constraints between two knots that are `width` apart in s.
    pub fn between(from: &PathKnot, to: &PathKnot, width: f64, limits: &MotionLimits) -> Self {
        let (m0, m1) = (&from.slope, &to.slope);
        let six = (to.q - from.q) * (6.0 / width);
        let per = 0.5 / width;
        let start = [(six - m0 * 6.0 - m1) * per, (m0 * 3.0 + m1 * 2.0 - six) * per];
        let end = [(six - m0 * 2.0 - m1 * 3.0) * per, (m0 + m1 * 6.0 - six) * per];
        let lane = |rows: &[_; 2], k: usize| {
            let (side, joint) = (k / AXES, k % AXES);
            let row: &platewash_kinematics::JointVector = &rows[side];
            row[joint] / limits.acceleration[joint]
        };
        let tip = match (&limits.tip, &from.tip, &to.tip) {
            (Some(tip), Some(here), Some(there)) => {
                let per = tip.acceleration_m_s2.recip();
                Some([
                    VectorStrip {
                        at_start: here.acceleration(&start[0]) * per,
                        at_end: here.velocity(&end[0]) * per,
                    },
                    VectorStrip {
                        at_start: there.velocity(&start[1]) * per,
                        at_end: there.acceleration(&end[1]) * per,
                    },
                ])
            }
            _ => None,
        };
        Self {
            width,
            at_start: std::array::from_fn(|k| lane(&start, k)),
            at_end: std::array::from_fn(|k| lane(&end, k)),
            tip,
            joints_tightened: 1.0,
            tip_tightened: 1.0,
        }
    }

    /// Divides the joints' limits by `by` ≥ 1.
    pub fn tighten_joints(&mut self, by: f64) {
        self.joints_tightened *= by;
        for k in 0..STRIPS {
            self.at_start[k] *= by;
            self.at_end[k] *= by;
        }
    }

    /// Divides the tip's limit by `by` ≥ 1.
    pub fn tighten_tip(&mut self, by: f64) {
        self.tip_tightened *= by;
        for strip in self.tip.iter_mut().flatten() {
            strip.at_start *= by;
            strip.at_end *= by;
        }
    }

    /// Tightens as much as `other` was.
    pub fn tighten_like(&mut self, other: &Self) {
        self.tighten_joints(other.joints_tightened);
        self.tighten_tip(other.tip_tightened);
    }

    /// The largest x₁ that the limits allow after x₀, given that there is one; infinite where nothing limits it.
    pub fn furthest(&self, x0: f64) -> f64 {
        let mut most = f64::INFINITY;
        for k in 0..STRIPS {
            let (a, b) = (self.at_start[k], self.at_end[k]);
            let most_here = (1.0 - a * x0 * b.signum()) / b.abs();
            most = if most_here < most { most_here } else { most };
        }
        for strip in self.tip.iter().flatten() {
            most = most.min(strip.furthest(x0));
        }
        most
    }

    /// Load of (x₀, x₁) relative to the limits: above 1 it breaks one.
    pub fn load(&self, x: [f64; 2]) -> f64 {
        let mut most = 0.0;
        for k in 0..STRIPS {
            let here = (self.at_start[k] * x[0] + self.at_end[k] * x[1]).abs();
            most = if here > most { here } else { most };
        }
        let tip = self.tip.iter().flatten().map(|strip| strip.at(x).norm());
        tip.fold(most, f64::max)
    }
}

#[cfg(test)]
impl Interval {
    /// An interval of given constraints.
    pub fn raw(at_start: [f64; STRIPS], at_end: [f64; STRIPS], tip: Option<[VectorStrip; 2]>) -> Self {
        Self {
            width: 1.0,
            at_start,
            at_end,
            tip,
            joints_tightened: 1.0,
            tip_tightened: 1.0,
        }
    }
}

/// Tangents of the tip's ellipses that may be added.
const TANGENTS: usize = 16;
/// Excess over an ellipse that is tolerated before the answer is scaled.
const TANGENT_TOLERANCE: f64 = 1e-5;
/// Excess over a strip that is tolerated before it counts as broken.
const TOLERANCE: f64 = 1e-12;
/// Variation of a constraint over a range below which it says nothing about a place in it.
const FLAT: f64 = 1e-10;

/// The solver, with the order in which constraints are taken.
#[derive(Debug)]
pub(crate) struct LinearProgram {
    order: [usize; STRIPS],
    at_start: [f64; STRIPS + TANGENTS],
    at_end: [f64; STRIPS + TANGENTS],
    count: usize,
    most: [f64; 2],
}

/// A range of one variable, narrowed by constraints.
#[derive(Debug, Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
    /// Slope of a constraint below which it is flat.
    flat: f64,
}

impl Range {
    fn new(high: f64) -> Self {
        Self {
            low: 0.0,
            high,
            flat: FLAT / high,
        }
    }

    /// Keeps `least ≤ slope · x + offset ≤ most`.
    #[inline]
    fn keep(&mut self, slope: f64, offset: f64, least: f64, most: f64) {
        if slope.abs() <= self.flat * (most - least) {
            return;
        }
        let (a, b) = ((least - offset) / slope, (most - offset) / slope);
        let (a, b) = if a < b { (a, b) } else { (b, a) };
        self.low = if a > self.low { a } else { self.low };
        self.high = if b < self.high { b } else { self.high };
    }

    /// The upper end; the middle where rounding left nothing.
    fn top(&self) -> f64 {
        if self.low <= self.high {
            self.high
        } else {
            0.5 * (self.low + self.high)
        }
    }

    fn bottom(&self) -> f64 {
        if self.low <= self.high { self.low } else { self.top() }
    }
}

impl LinearProgram {
    /// A solver.
    pub fn new() -> Self {
        Self {
            order: std::array::from_fn(|k| k),
            at_start: [0.0; STRIPS + TANGENTS],
            at_end: [0.0; STRIPS + TANGENTS],
            count: 0,
            most: [0.0; 2],
        }
    }

    /// The point (x₀, x₁) of the interval's limits within `[0, most[0]] × [0, most[1]]` that has the largest x₀. It is
    /// always allowed; `most[0]` is positive and finite, `most[1]` finite and not negative.
    pub fn furthest_back(&mut self, interval: &Interval, most: [f64; 2]) -> [f64; 2] {
        self.most = most;
        self.load(interval);
        let mut x = most;
        for k in 0..STRIPS {
            let value = self.value(k, x);
            if value.abs() > 1.0 + TOLERANCE {
                x = self.along(k, value.signum());
                self.order[..=k].rotate_right(1);
            }
        }
        if let Some(tip) = &interval.tip {
            for _ in 0..TANGENTS {
                let [a, b] = [tip[0].at(x), tip[1].at(x)];
                let (norms, first) = ([a.norm(), b.norm()], a.norm() >= b.norm());
                let (strip, normal, norm) = if first {
                    (&tip[0], a, norms[0])
                } else {
                    (&tip[1], b, norms[1])
                };
                if norm <= 1.0 + TANGENT_TOLERANCE {
                    break;
                }
                let normal = normal / norm;
                self.at_start[self.count] = normal.dot(&strip.at_start);
                self.at_end[self.count] = normal.dot(&strip.at_end);
                self.count += 1;
                x = self.along(self.count - 1, 1.0);
            }
        }
        let x = [x[0].clamp(0.0, most[0]), x[1].clamp(0.0, most[1])];
        let share = interval.load(x).max(1.0).recip();
        // A stop until the end is always possible. It counts where rounding spoils the rest.
        let stop = interval.load([1.0, 0.0]).recip().min(most[0]);
        if stop > x[0] * share {
            [stop, 0.0]
        } else {
            [x[0] * share, x[1] * share]
        }
    }

    /// The strips, in order.
    fn load(&mut self, interval: &Interval) {
        for (k, &from) in self.order.iter().enumerate() {
            self.at_start[k] = interval.at_start[from];
            self.at_end[k] = interval.at_end[from];
        }
        self.count = STRIPS;
    }

    #[inline]
    fn value(&self, k: usize, x: [f64; 2]) -> f64 {
        self.at_start[k] * x[0] + self.at_end[k] * x[1]
    }

    /// The point with the largest x₀ on the line `α_k x₀ + β_k x₁ = side`, within the constraints before k.
    fn along(&self, k: usize, side: f64) -> [f64; 2] {
        let (a, b) = (self.at_start[k], self.at_end[k]);
        if a.abs() * self.most[0] <= b.abs() * self.most[1] {
            // x₁ = offset − slope x₀
            let (slope, offset) = (a / b, side / b);
            let mut range = Range::new(self.most[0]);
            range.keep(-slope, offset, 0.0, self.most[1]);
            for i in 0..k {
                let (start, end) = (self.at_start[i], self.at_end[i]);
                range.keep(start - end * slope, end * offset, -1.0, 1.0);
            }
            let x0 = range.top();
            [x0, offset - slope * x0]
        } else {
            // x₀ = offset − slope x₁
            let (slope, offset) = (b / a, side / a);
            let mut range = Range::new(self.most[1]);
            range.keep(-slope, offset, 0.0, self.most[0]);
            for i in 0..k {
                let (start, end) = (self.at_start[i], self.at_end[i]);
                range.keep(end - start * slope, start * offset, -1.0, 1.0);
            }
            let x1 = if slope > 0.0 { range.bottom() } else { range.top() };
            [offset - slope * x1, x1]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{VectorStrip, *};
    use nalgebra::Vector3;
    use proptest::prelude::*;

    fn coefficient() -> impl Strategy<Value = f64> {
        prop_oneof![4 => -3.0..3.0f64, 1 => Just(0.0), 1 => -1e-9..1e-9f64, 1 => -1e4..1e4f64]
    }

    fn vector() -> impl Strategy<Value = Vector3<f64>> {
        prop::array::uniform3(coefficient()).prop_map(Vector3::from)
    }

    fn intervals() -> impl Strategy<Value = Interval> {
        let strips = || prop::array::uniform12(coefficient());
        let tip = prop::option::of([(vector(), vector()), (vector(), vector())]);
        (strips(), strips(), tip).prop_map(|(at_start, at_end, tip)| {
            let tip = tip.map(|pair| pair.map(|(at_start, at_end)| VectorStrip { at_start, at_end }));
            Interval::raw(at_start, at_end, tip)
        })
    }

    /// The largest x₀ by looking at many x₁: independent of the algorithm, and never above the truth.
    fn searched(interval: &Interval, most: [f64; 2]) -> f64 {
        let best = |x1: f64| {
            let (mut low, mut high) = (0.0, most[0]);
            // The allowed x₀ of a given x₁ are an interval; find one by the least load, then bisect upwards.
            let (mut a, mut b) = (0.0, most[0]);
            for _ in 0..200 {
                let (l, r) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
                if interval.load([l, x1]) <= interval.load([r, x1]) {
                    b = r;
                } else {
                    a = l;
                }
            }
            if interval.load([a, x1]) > 1.0 {
                return 0.0;
            }
            low = f64::max(low, a);
            for _ in 0..100 {
                let middle = 0.5 * (low + high);
                if interval.load([middle, x1]) <= 1.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            low
        };
        // best is concave in x₁.
        let (mut a, mut b) = (0.0, most[1]);
        for _ in 0..100 {
            let (l, r) = (a + (b - a) / 3.0, b - (b - a) / 3.0);
            if best(l) >= best(r) {
                b = r;
            } else {
                a = l;
            }
        }
        best(a).max(best(0.0))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(128))]
        #[test]
        fn the_speed_is_allowed_and_the_largest(
            interval in intervals(),
            most in (1e-3..2.0f64, prop_oneof![Just(0.0), 1e-3..2.0f64]),
        ) {
            let most: [f64; 2] = most.into();
            let x = LinearProgram::new().furthest_back(&interval, most);
            prop_assert!(x[0] > 0.0 && x[0] <= most[0] && x[1] >= 0.0 && x[1] <= most[1], "{x:?}");
            prop_assert!(interval.load(x) <= 1.0 + 1e-12, "{x:?}: {}", interval.load(x));
            let searched = searched(&interval, most);
            prop_assert!(x[0] >= searched * (1.0 - 1e-4) - 1e-9, "{x:?}, searched {searched}");
        }

        #[test]
        fn the_furthest_value_is_the_largest_allowed_one(interval in intervals(), share in 0.0..0.99f64) {
            let x = LinearProgram::new().furthest_back(&interval, [1.0, 1.0]);
            let x0 = x[0] * share;
            let most = interval.furthest(x0);
            prop_assume!(most.is_finite());
            prop_assert!(most >= 0.0);
            prop_assert!(interval.load([x0, most * (1.0 - 1e-6)]) <= 1.0 + 1e-6);
            prop_assert!(interval.load([x0, most * (1.0 + 1e-6) + 1e-9]) >= 1.0 - 1e-7);
        }
    }

    /// By hand: |x₁ − x₀| ≤ 1 from x₁ ≤ 1/2 lets x₀ be at most 3/2.
    #[test]
    fn braking_agrees_with_hand_calculation() {
        let mut at_start = [0.0; STRIPS];
        let mut at_end = [0.0; STRIPS];
        (at_start[3], at_end[3]) = (-1.0, 1.0);
        let x = LinearProgram::new().furthest_back(&Interval::raw(at_start, at_end, None), [9.0, 0.5]);
        assert!((x[0] - 1.5).abs() < 1e-14 && (x[1] - 0.5).abs() < 1e-14, "{x:?}");
    }
}
