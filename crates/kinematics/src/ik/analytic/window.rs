//! Joint limits and the start against which values are weighed.

use super::tolerance::{LIMIT_NEAR_RAD, LIMIT_ROUNDING_RAD, MOST_TURNS};
use crate::{JointLimits, JointVector, LimitViolation};
use std::f64::consts::TAU;

/// Limits and a start.
pub(super) struct Window<'a> {
    pub limits: &'a JointLimits,
    pub start: JointVector,
    /// The start within the limits: the value within limits that is nearest to it is nearest to the start too.
    pub anchor: JointVector,
}

impl<'a> Window<'a> {
    #[inline]
    pub fn new(limits: &'a JointLimits, start: &JointVector) -> Self {
        let reach = JointVector::repeat(MOST_TURNS * TAU);
        Self {
            limits,
            start: *start,
            anchor: limits.clamp(start).sup(&-reach).inf(&reach),
        }
    }

    /// The same window with joint 1, where it is free, kept at another value \[rad\].
    pub fn anchored(&self, q1: f64) -> Self {
        let mut anchor = self.anchor;
        anchor[0] = q1;
        Self {
            limits: self.limits,
            start: self.start,
            anchor,
        }
    }

    /// The value `angle + 2πk` within the limits that is nearest to the start, or failing that the one
    /// within [`LIMIT_NEAR_RAD`] of them.
    #[inline]
    pub fn value(&self, joint: usize, angle: f64) -> Option<f64> {
        let q = angle + TAU * nearest_integer((self.anchor[joint] - angle) * (1.0 / TAU));
        self.within(joint, q, LIMIT_ROUNDING_RAD)
            .or_else(|| self.within(joint, q, LIMIT_NEAR_RAD))
    }

    /// `q`, at most half a turn from the anchor, or the next turn towards the limits.
    #[inline]
    fn within(&self, joint: usize, q: f64, slack: f64) -> Option<f64> {
        let (lower, upper) = (self.limits.lower[joint] - slack, self.limits.upper[joint] + slack);
        let q = if q > upper {
            q - TAU
        } else if q < lower {
            q + TAU
        } else {
            q
        };
        (lower <= q && q <= upper).then_some(q)
    }

    /// How far the turn of `angle` that misses the limits by least misses them, and at which value \[rad\].
    pub fn miss(&self, joint: usize, angle: f64) -> (f64, LimitViolation) {
        let (lower, upper) = (self.limits.lower[joint], self.limits.upper[joint]);
        let q = angle + TAU * nearest_integer((self.anchor[joint] - angle) / TAU);
        let miss = |position_rad: f64| {
            let limit_rad = if position_rad < lower { lower } else { upper };
            let violation = LimitViolation {
                joint,
                position_rad,
                limit_rad,
            };
            ((lower - position_rad).max(position_rad - upper), violation)
        };
        [q - TAU, q + TAU]
            .map(miss)
            .into_iter()
            .fold(miss(q), |best, other| if other.0 < best.0 { other } else { best })
    }

    /// Squared distance of the first joints' values from the start \[rad²\].
    #[inline]
    pub fn squared_distance(&self, q: &[f64]) -> f64 {
        let squared = |(q, start): (&f64, &f64)| (q - start) * (q - start);
        q.iter().zip(self.start.iter()).map(squared).sum()
    }
}

/// The nearest integer, halves away from zero; the argument must fit an `i32`.
#[inline]
pub(super) fn nearest_integer(x: f64) -> f64 {
    f64::from((x + 0.5_f64.copysign(x)) as i32)
}
