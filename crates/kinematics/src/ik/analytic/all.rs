//! All analytic answers within the limits, and the reasons that the other branches have none.
//!
//! A branch that ends beyond a limit by no more than the uncertainty of its joints is closed onto the limit.

use crate::ik::analytic::arm::AnalyticArm;
use crate::ik::analytic::branch::{Branch, Degeneracies, Elbow, Label, OutOfReach, Shoulder};
use crate::ik::analytic::branches::Branches;
use crate::ik::analytic::error::{AnalyticError, check_finite};
use crate::ik::analytic::tolerances::LIMIT_ROUNDING_RAD;
use crate::ik::analytic::window::{Window, nearest_integer};
use crate::joints::{AXES, JointVector};
use crate::limits::{JointLimits, LimitViolation};
use crate::rotation::RigidTransform;
use serde::Serialize;
use std::f64::consts::TAU;

/// Filter that rejected a branch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
pub enum Rejection {
    /// Its shoulder side cannot reach the wrist centre.
    #[error("out of reach: {0}")]
    OutOfReach(OutOfReach),
    /// The joint that misses its limits by most, at the turn that misses by least.
    #[error("joint {} at {} rad is beyond {} rad", .0.joint + 1, .0.position_rad, .0.limit_rad)]
    Limit(LimitViolation),
}

/// Branch within the limits, with every whole turn of its joints that the limits allow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// Name of the branch.
    pub label: Label,
    /// Degeneracies of the branch.
    pub degenerate: Degeneracies,
    /// Lowest value of every joint within the limits \[rad\].
    pub lowest: JointVector,
    /// Number of values, a whole turn apart, that each joint has within its limits. A continuous joint counts as one: the value nearest to
    /// `previous`.
    pub turns: [u32; AXES],
    upper: JointVector,
}

/// Configurations of a [`Solution`]: every combination of turns, joint 6 changing fastest.
#[derive(Debug, Clone)]
pub struct Configurations {
    solution: Solution,
    first: [u32; AXES],
    last: [u32; AXES],
    next: Option<[u32; AXES]>,
}

/// The branches of one target under limits, each a solution or the reason that there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Solutions {
    slots: Branches<Result<Solution, Rejection>>,
}

impl Solution {
    /// Returns the configuration of this branch within the limits that is nearest to `start` \[rad\].
    #[must_use]
    pub fn nearest(&self, start: &JointVector) -> JointVector {
        JointVector::from_fn(|i, _| {
            let most = f64::from(self.turns[i] - 1);
            self.value(i, ((start[i] - self.lowest[i]) / TAU).round().clamp(0.0, most))
        })
    }

    /// Returns a joint's value some whole turns above the lowest \[rad\].
    fn value(&self, joint: usize, turns: f64) -> f64 {
        (self.lowest[joint] + TAU * turns).min(self.upper[joint])
    }

    /// Returns every configuration of this branch within the limits \[rad\]. They are very many where the limits allow many turns.
    #[must_use]
    pub fn configurations(&self) -> Configurations {
        self.between([0; AXES], self.turns.map(|turns| turns - 1))
    }

    /// Returns the configurations of this branch within the limits, none of whose joints has a turn that is nearer to `start` by more than
    /// rounding \[rad\]: one, and more only where a joint is half a turn from `start`.
    #[must_use]
    pub fn nearest_configurations(&self, start: &JointVector) -> Configurations {
        let most = |joint: usize| f64::from(self.turns[joint] - 1);
        let away = |joint: usize| (start[joint] - self.lowest[joint]) / TAU;
        let within_half = 0.5 + LIMIT_ROUNDING_RAD;
        let first = |joint| (away(joint) - within_half).ceil().clamp(0.0, most(joint)) as u32;
        let last = |joint| (away(joint) + within_half).floor().clamp(0.0, most(joint)) as u32;
        self.between(std::array::from_fn(first), std::array::from_fn(last))
    }

    fn between(&self, first: [u32; AXES], last: [u32; AXES]) -> Configurations {
        Configurations {
            solution: *self,
            first,
            last,
            next: Some(first),
        }
    }
}

impl Iterator for Configurations {
    type Item = JointVector;

    fn next(&mut self) -> Option<JointVector> {
        let now = self.next?;
        let mut after = now;
        // Count up, joint 6 first; past the last combination nothing is left.
        self.next = (0..AXES).rev().find(|&i| now[i] < self.last[i]).map(|i| {
            after[i] += 1;
            after[i + 1..].copy_from_slice(&self.first[i + 1..]);
            after
        });
        Some(JointVector::from_fn(|i, _| self.solution.value(i, f64::from(now[i]))))
    }
}

impl Solutions {
    /// Returns the branches with a configuration within the limits, in the order of [`Label::index`].
    pub fn iter(&self) -> impl Iterator<Item = &Solution> {
        self.slots.iter().filter_map(|slot| slot.as_ref().ok())
    }

    /// Returns every configuration within the limits \[rad\], very many where these allow many turns. Branches that meet in a singularity
    /// repeat it.
    pub fn configurations(&self) -> impl Iterator<Item = (Label, JointVector)> {
        self.iter()
            .flat_map(|solution| solution.configurations().map(|q| (solution.label, q)))
    }

    /// Returns the branches without one, each with the filter that rejected it.
    pub fn rejections(&self) -> impl Iterator<Item = (Label, Rejection)> {
        let rejection = |(label, slot): (Label, &Result<Solution, Rejection>)| Some((label, slot.err()?));
        self.slots.labelled().filter_map(rejection)
    }

    /// Returns the branches on one side of the shoulder and of the elbow, each a solution or the filter that rejected it.
    pub fn on_sides(&self, shoulder: Shoulder, elbow: Elbow) -> impl Iterator<Item = Result<Solution, Rejection>> {
        let is_there = move |label: Label| (label.shoulder, label.elbow) == (shoulder, elbow);
        let there = self.slots.labelled().filter(move |(label, _)| is_there(*label));
        there.map(|(_, slot)| *slot)
    }

    /// Returns one branch by its label.
    ///
    /// # Errors
    /// [`Rejection`]: the filter that rejected it. A branch that the arm does not have is infinitely far out of reach.
    pub fn get(&self, label: Label) -> Result<Solution, Rejection> {
        let missing = Err(Rejection::OutOfReach(OutOfReach::NOWHERE));
        self.slots.get(label).copied().unwrap_or(missing)
    }
}

impl AnalyticArm {
    /// Returns all configurations within `limits` that bring body 6 to `target` (`T_base_body6`, as for [`AnalyticArm::branches`]):
    /// branches and whole turns of their joints. Free joints keep their value in `previous` \[rad\] (set to the nearer limit if it is
    /// outside) as far as the limits allow.
    ///
    /// # Errors
    /// [`AnalyticError::Target`] and [`AnalyticError::Start`] for input that is not finite. It is no error if no branch is within the
    /// limits: [`Solutions::rejections`] gives the reasons.
    pub fn solve_all(
        &self,
        target: &RigidTransform,
        previous: &JointVector,
        limits: &JointLimits,
    ) -> Result<Solutions, AnalyticError> {
        check_finite(target, previous)?;
        let window = Window::new(limits, previous);
        let kept = self.all_within(target, &window);
        if kept.iter().next().is_some() {
            return Ok(kept);
        }
        let moved = (self.form.elsewhere(target, &window).into_iter())
            .map(|anchor| self.all_within(target, &window.anchored(anchor)))
            .find(|solutions| solutions.iter().next().is_some());
        Ok(moved.unwrap_or(kept))
    }

    pub(crate) fn all_within(&self, target: &RigidTransform, window: &Window<'_>) -> Solutions {
        let slots = self.form.all_within(target, window).map(|slot| match slot {
            Ok((branch, near)) => self.solution(target, branch, *near, window),
            Err(miss) => Err(Rejection::OutOfReach(*miss)),
        });
        Solutions { slots }
    }

    /// Returns the branch with its turns, or its worst joint.
    fn solution(
        &self,
        target: &RigidTransform,
        branch: &Branch,
        near: Option<JointVector>,
        window: &Window<'_>,
    ) -> Result<Solution, Rejection> {
        let rejected = || {
            let misses = (0..AXES).map(|joint| window.miss(joint, branch.q[joint]));
            let worst = misses.fold(window.miss(0, branch.q[0]), |a, b| if b.0 > a.0 { b } else { a });
            Rejection::Limit(worst.1)
        };
        let q = near.and_then(|q| self.form.moved_within_limits(target, q, window.limits));
        let q = q.ok_or_else(rejected)?;
        let mut lowest = q;
        let mut turns = [1; AXES];
        for joint in 0..AXES {
            (lowest[joint], turns[joint]) = turns_within(q[joint], window.limits, joint);
        }
        Ok(Solution {
            label: branch.label,
            degenerate: branch.degenerate,
            lowest,
            turns,
            upper: window.limits.upper,
        })
    }
}

/// Returns the lowest of the values a whole turn apart within the limits, and their number. `q` is one of them.
fn turns_within(q: f64, limits: &JointLimits, joint: usize) -> (f64, u32) {
    let (lower, upper) = (limits.lower[joint], limits.upper[joint]);
    if !(lower.is_finite() && upper.is_finite()) {
        return (q, 1);
    }
    let fit = |room: f64| ((room + LIMIT_ROUNDING_RAD) / TAU).floor().max(0.0);
    let (below, above) = (fit(q - lower), fit(upper - q));
    ((q - TAU * below).max(lower), nearest_integer(below + above) as u32 + 1)
}
