//! Joint limits with the start from which distances are measured, and the configuration nearest to it.

use crate::ik::analytic::branch::{Degeneracies, Label};
use crate::ik::analytic::tolerances::{LIMIT_NEAR_RAD, LIMIT_ROUNDING_RAD, MOST_TURNS};
use crate::joints::JointVector;
use crate::limits::{JointLimits, LimitViolation};
use serde::Serialize;
use std::f64::consts::TAU;

/// Configuration within the limits, with its distance from the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NearestConfiguration {
    /// Joint positions within the limits \[rad\].
    pub q: JointVector,
    /// Label of its branch.
    pub label: Label,
    /// Degeneracies of the branch.
    pub degenerate: Degeneracies,
    /// Distance `‖q − start‖` \[rad\].
    pub distance_rad: f64,
}

/// Joint limits and a start.
pub(crate) struct Window<'a> {
    pub limits: &'a JointLimits,
    pub start: JointVector,
    /// Start clamped to the limits: the value within limits that is nearest to it is nearest to the start too.
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

    /// Returns the window with another configuration for the joints that are free \[rad\].
    pub fn anchored(&self, anchor: JointVector) -> Self {
        Self {
            limits: self.limits,
            start: self.start,
            anchor,
        }
    }

    /// Returns the anchor with other values of one joint, the finite ones, those nearest to the anchor first \[rad\].
    pub fn anchors_with(&self, joint: usize, values: impl Iterator<Item = f64>) -> Vec<JointVector> {
        let far = |value: &f64| (value - self.anchor[joint]).abs();
        let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        values.sort_by(|a, b| far(a).total_cmp(&far(b)));
        let anchored = |value| {
            let mut anchor = self.anchor;
            anchor[joint] = value;
            anchor
        };
        values.into_iter().map(anchored).collect()
    }

    /// Returns the value `angle + 2πk` within the limits that is nearest to the start, or failing that the one within [`LIMIT_NEAR_RAD`] of
    /// them.
    #[inline]
    pub fn value(&self, joint: usize, angle: f64) -> Option<f64> {
        let q = angle + TAU * nearest_integer((self.anchor[joint] - angle) * (1.0 / TAU));
        self.within(joint, q, LIMIT_ROUNDING_RAD)
            .or_else(|| self.within(joint, q, LIMIT_NEAR_RAD))
    }

    /// Returns [`Window::value`] of every joint.
    pub fn nearest(&self, q: &JointVector) -> Option<JointVector> {
        let mut near = *q;
        for joint in 0..near.len() {
            near[joint] = self.value(joint, q[joint])?;
        }
        Some(near)
    }

    /// Returns `q`, at most half a turn from the anchor, or the next turn towards the limits.
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

    /// Returns the turn of `angle` that misses the limits by least: the distance by which it misses them, and its value \[rad\].
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

/// Returns the nearest integer, halves away from zero; the argument must fit an `i32`.
#[inline]
pub(crate) fn nearest_integer(x: f64) -> f64 {
    f64::from((x + 0.5_f64.copysign(x)) as i32)
}
