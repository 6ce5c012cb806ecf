//! Analytic answer nearest to a start.
//!
//! Joint limits, and the start from which distances are measured.

use crate::ik::analytic::all::{Rejection, Solutions};
use crate::ik::analytic::branch::{Degeneracies, Label, OutOfReach};
use crate::ik::analytic::{
    AnalyticArm, AnalyticError, ClosedForm, LIMIT_NEAR_RAD, LIMIT_ROUNDING_RAD, MOST_TURNS, check_finite,
};
use crate::rotation::RigidTransform;
use crate::{JointLimits, JointVector, LimitViolation};
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

impl AnalyticArm {
    /// Returns the configuration within `limits` that brings body 6 to `target` (`T_base_body6`, as for [`AnalyticArm::branches`]) and is
    /// nearest to `start` \[rad\]: `min ‖q − start‖`, Euclidean over the six joints, over all branches and whole turns. Ties go to the
    /// first in [`Label::ALL`], and to the turn further from zero.
    ///
    /// Free joints keep their value in `start` (set to the nearer limit if it is outside), as far as the
    /// limits of the others allow. A continuous joint follows the start for up to [`crate::ik::analytic::MOST_TURNS`] turns.
    ///
    /// # Errors
    /// [`AnalyticError`]: input that is not finite, or the branch that misses the reach or the limits by least.
    pub fn nearest(
        &self,
        target: &RigidTransform,
        start: &JointVector,
        limits: &JointLimits,
    ) -> Result<NearestConfiguration, AnalyticError> {
        check_finite(target, start)?;
        let window = Window::new(limits, start);
        match self.form.search(target, &window) {
            Some(found) => Ok(found),
            None => self.search_elsewhere(target, &window),
        }
    }

    /// Searches with other values of the joint that is free, if one is; otherwise returns the reason.
    #[cold]
    fn search_elsewhere(
        &self,
        target: &RigidTransform,
        window: &Window<'_>,
    ) -> Result<NearestConfiguration, AnalyticError> {
        (self.form.elsewhere(target, window).into_iter())
            .find_map(|anchor| self.form.search(target, &window.anchored(anchor)))
            .ok_or_else(|| least_miss(&self.all_within(target, window)))
    }
}

/// The search for the nearest answer.
pub(crate) struct Search<'a, F> {
    form: &'a F,
    target: &'a RigidTransform,
    pub window: &'a Window<'a>,
    pub best: Option<NearestConfiguration>,
    /// Squared distance of the best answer \[rad²\].
    pub least: f64,
}

impl<'a, F: ClosedForm> Search<'a, F> {
    #[inline]
    pub fn new(form: &'a F, target: &'a RigidTransform, window: &'a Window<'a>) -> Self {
        Self {
            form,
            target,
            window,
            best: None,
            least: f64::INFINITY,
        }
    }

    /// Takes the configuration if it is nearer than the best. One beyond a limit must be movable onto it.
    #[inline]
    pub fn offer(&mut self, q: JointVector, label: Label, degenerate: Degeneracies) -> Option<()> {
        if self.window.squared_distance(q.as_slice()) >= self.least {
            return None;
        }
        let q = self.form.moved_within_limits(self.target, q, self.window.limits)?;
        self.least = self.window.squared_distance(q.as_slice());
        self.best = Some(NearestConfiguration {
            q,
            label,
            degenerate,
            distance_rad: self.least.sqrt(),
        });
        Some(())
    }
}

/// Returns the rejection by a limit that misses by least; without any, the least distance from reach.
fn least_miss(solutions: &Solutions) -> AnalyticError {
    let by = |violation: &LimitViolation| (violation.position_rad - violation.limit_rad).abs();
    let cost = |rejection: &Rejection| match rejection {
        Rejection::Limit(violation) => (0, by(violation)),
        Rejection::OutOfReach(miss) => (1, miss.by_m),
    };
    let less = |a: &Rejection, b: &Rejection| cost(a) < cost(b);
    let mut least = (Label::ALL[0], Rejection::OutOfReach(OutOfReach::NOWHERE));
    for (label, rejection) in solutions.rejections() {
        if less(&rejection, &least.1) {
            least = (label, rejection);
        }
    }
    match least {
        (label, Rejection::Limit(violation)) => AnalyticError::Limits { label, violation },
        (_, Rejection::OutOfReach(miss)) => AnalyticError::OutOfReach(miss),
    }
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
