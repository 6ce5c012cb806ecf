//! What the limits say about one interval between two knots, as constraints on x = ṡ² at its ends.
//!
//! Between knots the motion is the cubic Hermite piece of the promised trajectory, not the path itself. With σ = √x,
//! duration `h = 2 Δ / (σ₀ + σ₁)` (s̈ constant), `d = (q₁ − q₀)/Δ` and slopes `q′`, its accelerations at the ends are
//!
//! `2 Δ q̈₀ = (3 d − 4 q′₀) x₀ + (3 d − 2 q′₁) x₁ + (6 d − 4 q′₀ − 2 q′₁) σ₀ σ₁`,
//! `2 Δ q̈₁ = (2 q′₀ − 3 d) x₀ + (4 q′₁ − 3 d) x₁ + (2 q′₀ + 4 q′₁ − 6 d) σ₀ σ₁`.
//!
//! `σ₀ σ₁ = (x₀ + x₁)/2 − (σ₁ − σ₀)²/2`; without the last term, which is of second order in h, both are linear in
//! (x₀, x₁). As a piece's acceleration is a line in time, its ends are all that counts. So a joint's limit is a pair of
//! strips `|α x₀ + β x₁| ≤ 1`, and the tip's is the same with vectors. What the dropped term adds is found when the
//! motion is checked, and then taken off the interval's limits ([`Interval::tighten_joints`]).

use super::grid::PathKnot;
use super::limits::MotionLimits;
use nalgebra::Vector3;
use platewash_kinematics::AXES;

/// Strips of an interval: six joints at both ends.
pub(super) const STRIPS: usize = 2 * AXES;

/// The acceleration limits of an interval, each scaled to 1.
#[derive(Debug, Clone)]
pub(super) struct Interval {
    /// Length in s.
    pub width: f64,
    /// α of the strips.
    pub at_start: [f64; STRIPS],
    /// β of the strips.
    pub at_end: [f64; STRIPS],
    /// The tip's acceleration at both ends.
    pub tip: Option<[VectorStrip; 2]>,
    /// By what the joints' limits were divided.
    joints_tightened: f64,
    /// By what the tip's limit was divided.
    tip_tightened: f64,
}

/// `|A x₀ + B x₁| ≤ 1`.
#[derive(Debug, Clone, Copy)]
pub(super) struct VectorStrip {
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

    /// How far (x₀, x₁) goes towards the limits: above 1 it breaks one.
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
