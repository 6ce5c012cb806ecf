//! The answer nearest to a start.

use super::all::{Rejection, Solutions};
use super::arm::AnalyticArm;
use super::error::{AnalyticError, check_finite};
use super::label::{Degenerate, Elbow, Label, OutOfReach, Shoulder, Wrist};
use super::position::{Bend, Goal, Swing};
use super::window::Window;
use crate::rotation::Rigid;
use crate::{JointLimits, JointVector, LimitViolation};
use serde::Serialize;

/// A configuration within the limits, and how far it is from the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Nearest {
    /// Joint positions within the limits \[rad\].
    pub q: JointVector,
    /// Its branch.
    pub label: Label,
    /// Where it is degenerate.
    pub degenerate: Degenerate,
    /// `‖q − start‖` \[rad\].
    pub distance_rad: f64,
}

impl AnalyticArm {
    /// The configuration within `limits` that brings body 6 to `target` (`T_base_body6`, as for
    /// [`AnalyticArm::branches`]) and is nearest to `start` \[rad\]: `min ‖q − start‖`, Euclidean over the six joints, over
    /// all branches and whole turns. Equals go to the first in [`Label::ALL`], and to the turn further from zero.
    ///
    /// Free joints keep their value in `start` (set to the nearer limit if it is outside), as far as the
    /// limits of the others allow. A continuous joint follows the start for up to [`super::MOST_TURNS`] turns.
    ///
    /// # Errors
    /// [`AnalyticError`]: the input is not finite, or the branch that misses the reach or the limits by least.
    pub fn nearest(&self, target: &Rigid, start: &JointVector, limits: &JointLimits) -> Result<Nearest, AnalyticError> {
        check_finite(target, start)?;
        let window = Window::new(limits, start);
        let goal = self.goal(target);
        match self.search(target, &goal, &window) {
            Some(found) => Ok(found),
            None => self.search_elsewhere(target, &goal, &window),
        }
    }

    fn search(&self, target: &Rigid, goal: &Goal, window: &Window<'_>) -> Option<Nearest> {
        let mut search = Search {
            arm: self,
            target,
            window,
            best: None,
            least: f64::INFINITY,
        };
        search.shoulder(goal, Shoulder::Front);
        search.shoulder(goal, Shoulder::Back);
        search.best
    }

    /// With joint 1 free, the next values of it that may do; otherwise the reason.
    #[cold]
    fn search_elsewhere(&self, target: &Rigid, goal: &Goal, window: &Window<'_>) -> Result<Nearest, AnalyticError> {
        self.critical_turns(goal, window)
            .find_map(|q1| self.search(target, goal, &window.anchored(q1)))
            .ok_or_else(|| least_miss(&self.all_within(target, window)))
    }
}

/// The search for the nearest answer, branch by branch. A branch is left as soon as a joint is outside its limits
/// or the joints so far are already further away than the best.
struct Search<'a> {
    arm: &'a AnalyticArm,
    target: &'a Rigid,
    window: &'a Window<'a>,
    best: Option<Nearest>,
    /// Squared distance of the best \[rad²\].
    least: f64,
}

impl Search<'_> {
    #[inline]
    fn shoulder(&mut self, goal: &Goal, shoulder: Shoulder) -> Option<()> {
        let swing = self.arm.swing(goal, shoulder, self.window.anchor[0]).ok()?;
        let q1 = self.window.value(0, swing.q1)?;
        let triangle = self.arm.triangle(&swing).ok()?;
        for elbow in [Elbow::Up, Elbow::Down] {
            let bend = self.arm.bend(&triangle, shoulder, elbow, self.window.anchor[1]);
            self.elbow(&swing, &bend, q1, (shoulder, elbow));
        }
        Some(())
    }

    #[inline]
    fn elbow(&mut self, swing: &Swing, bend: &Bend, q1: f64, (shoulder, elbow): (Shoulder, Elbow)) -> Option<()> {
        let q3 = self.window.value(2, bend.q3)?;
        let q2 = self.window.value(1, bend.q2)?;
        if self.window.squared_distance(&[q1, q2, q3]) >= self.least {
            return None;
        }
        let turn = self.arm.wrist(swing, bend, self.window.anchor[3]);
        let degenerate = Degenerate {
            shoulder: swing.meets,
            elbow: bend.meets,
            wrist: turn.free,
        };
        for wrist in [Wrist::Plain, Wrist::Flipped] {
            if let Some([q4, q5, q6]) = self.arm.wrist_within(&turn, wrist, self.window) {
                let q = JointVector::new(q1, q2, q3, q4, q5, q6);
                self.offer(q, Label::new(shoulder, elbow, wrist), degenerate);
            }
        }
        Some(())
    }

    /// Takes the configuration if it is nearer than the best and, where it stands beyond a limit, can be moved onto it.
    #[inline]
    fn offer(&mut self, q: JointVector, label: Label, degenerate: Degenerate) -> Option<()> {
        if self.window.squared_distance(q.as_slice()) >= self.least {
            return None;
        }
        let q = self.arm.settled(self.target, q, self.window.limits)?;
        self.least = self.window.squared_distance(q.as_slice());
        self.best = Some(Nearest {
            q,
            label,
            degenerate,
            distance_rad: self.least.sqrt(),
        });
        Some(())
    }
}

/// The rejection by a limit that misses by least; without any, the least distance from reach.
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
