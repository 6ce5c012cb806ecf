//! Several answers to one pose, on arms without a closed form: the branches that descents from many starts find.
//!
//! An arm whose base joint turns about a fixed axis looks the same from every direction: a configuration that reaches a pose
//! reaches, with joint 1 turned by δ, that pose turned by δ about axis 1. So every start is first turned towards the target: joint
//! 1 is set such that the frame's origin has the target's azimuth about axis 1. Of the listed starts ([`super::starts`]) those
//! nearest in pose after that turn are descended from (damped least squares). Each answer then serves as a start again with joint 1
//! half a turn on, with its elbow mirrored and with its wrist flipped, until nothing new comes.
//!
//! Every answer is a configuration within the limits that meets both tolerances. It is *not* known that there are no further ones.

use crate::ik::answer::IkError;
use crate::ik::cascade::IkSolver;
use crate::ik::dls::{self, ALL_FREE, Task};
use crate::joints::{AXES, JointVector};
use crate::rotation::Pose;
use crate::rotation::RigidTransform;
use crate::trig::{atan2, sin_cos};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Greatest difference of answers, up to whole turns, that count as one answer \[rad\].
const SAME_RAD: f64 = 1e-3;

/// Greatest number of answers: a six-axis arm of revolute joints has at most sixteen branches (Primrose 1986).
const MOST_ANSWERS: usize = 16;

/// Joints mirrored or turned to guess one branch from another: half a turn of joint 1, the elbow mirrored, the wrist flipped.
const MIRRORS: [Mirror; 3] = [
    Mirror([Some(PI), None, None, None, None, None], [false; AXES]),
    Mirror([None; AXES], [false, false, true, false, false, false]),
    Mirror(
        [None, None, None, Some(PI), None, Some(PI)],
        [false, false, false, false, true, false],
    ),
];

/// Amounts added to the joints \[rad\], and the joints that change their sign.
struct Mirror([Option<f64>; AXES], [bool; AXES]);

impl Mirror {
    fn image(&self, q: &JointVector) -> JointVector {
        JointVector::from_fn(|joint, _| {
            let at = if self.1[joint] { -q[joint] } else { q[joint] };
            at + self.0[joint].unwrap_or(0.0)
        })
    }
}

impl IkSolver<'_> {
    /// Returns configurations within the limits that bring the frame to `target` (`T_base_frame`), each on another branch of the arm, as
    /// far as that can be seen: no two agree up to whole turns. Among whole turns the nearest to `near` \[rad\] is taken; the configuration
    /// nearest to `near` comes first. `starts` of the listed starts are tried, at most [`crate::ik::starts::LISTED`]; see the
    /// [module](self) text. An empty answer proves nothing.
    ///
    /// # Errors
    /// [`IkError::Target`] and [`IkError::Seed`] for input that is not finite.
    pub fn spread(&self, target: &Pose, near: &JointVector, starts: usize) -> Result<Vec<JointVector>, IkError> {
        let task = self.task(target)?;
        crate::ik::cascade::check_seed(near)?;
        let mut found = FoundAnswers {
            solver: self,
            task: &task,
            near,
            answers: Vec::new(),
        };
        if self.beyond_reach(&task.target) {
            return Ok(found.answers);
        }
        found.descend(&found.turned(near));
        found.descend(near);
        for start in self.facing(&task.target, starts) {
            found.descend(&start);
        }
        let mut k = 0;
        while k < found.answers.len() {
            let q = found.answers[k];
            for mirror in &MIRRORS {
                found.descend(&mirror.image(&q));
            }
            k += 1;
        }
        let mut answers = found.answers;
        answers.sort_by(|a, b| (a - near).norm().total_cmp(&(b - near).norm()));
        Ok(answers)
    }

    /// Returns the listed starts with joint 1 turned towards the target, the `count` nearest in pose, nearest first.
    fn facing(&self, target: &RigidTransform, count: usize) -> Vec<JointVector> {
        let axis = Axis::new(self);
        let entries = self.starts.entries().iter();
        let turned = entries.map(|(q, pose)| {
            let by = axis.azimuth(&pose.translation, &target.translation);
            let mut q = *q;
            q[0] += by;
            (crate::ik::starts::distance(&axis.turned(pose, by), target), q)
        });
        let mut ranked: Vec<_> = turned.collect();
        ranked.sort_by(|a, b| a.0.total_cmp(&b.0));
        ranked.into_iter().take(count).map(|(_, q)| q).collect()
    }
}

/// Axis 1: a point on it \[m\] and its direction, base frame.
struct Axis {
    point: Vector3<f64>,
    along: Vector3<f64>,
}

impl Axis {
    fn new(solver: &IkSolver<'_>) -> Self {
        let first = &solver.robot().folded()[0];
        Self {
            point: first.translation,
            along: first.rotation.column(2).into(),
        }
    }

    /// Returns the turn about the axis that brings the direction of `from` \[m\] onto that of `to` \[m\], in (−π, π\] \[rad\].
    fn azimuth(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
        let across = |p: &Vector3<f64>| {
            let away = p - self.point;
            away - self.along * self.along.dot(&away)
        };
        let (a, b) = (across(from), across(to));
        atan2(self.along.dot(&a.cross(&b)), a.dot(&b))
    }

    /// Returns a pose turned about the axis.
    fn turned(&self, pose: &RigidTransform, by_rad: f64) -> RigidTransform {
        let (s, c) = sin_cos(by_rad);
        let cross = self.along.cross_matrix();
        let turn = Matrix3::identity() + cross * s + cross * cross * (1.0 - c);
        RigidTransform {
            rotation: turn * pose.rotation,
            translation: self.point + turn * (pose.translation - self.point),
        }
    }
}

/// Answers found so far.
struct FoundAnswers<'a> {
    solver: &'a IkSolver<'a>,
    task: &'a Task<'a>,
    near: &'a JointVector,
    answers: Vec<JointVector>,
}

impl FoundAnswers<'_> {
    /// Returns the start with joint 1 turned towards the target.
    fn turned(&self, start: &JointVector) -> JointVector {
        let axis = Axis::new(self.solver);
        let tip = self.solver.robot().fk(start).rigid(self.solver.frame()).translation;
        let mut q = *start;
        q[0] += axis.azimuth(&tip, &self.task.target.translation);
        q
    }

    /// Descends from a start, and keeps an answer that is new.
    fn descend(&mut self, start: &JointVector) {
        if self.answers.len() >= MOST_ANSWERS {
            return;
        }
        let start = self.nearest_turns(start);
        let descent = dls::descend(self.task, start, &ALL_FREE, &self.solver.settings);
        let limits = self.solver.robot().limits();
        if !self.task.solved(&descent.best) || !limits.contain(&descent.best.q) {
            return;
        }
        let q = self.nearest_turns(&descent.best.q);
        let same = |other: &JointVector| (other - q).map(|d| (d - TAU * (d / TAU).round()).abs()).amax() < SAME_RAD;
        if !self.answers.iter().any(same) {
            self.answers.push(q);
        }
    }

    /// Returns each joint moved by whole turns as near to `near` as the limits allow; clamped to them if no turn is within.
    fn nearest_turns(&self, q: &JointVector) -> JointVector {
        let limits = self.solver.robot().limits();
        let nearest = JointVector::from_fn(|joint, _| {
            let whole = ((self.near[joint] - q[joint]) / TAU).round();
            let inside = |turns: f64| {
                let at = q[joint] + TAU * turns;
                (limits.lower[joint] <= at && at <= limits.upper[joint]).then_some(at)
            };
            let turns = [0.0, 1.0, -1.0, 2.0, -2.0].into_iter();
            turns.map(|k| whole + k).find_map(inside).unwrap_or(q[joint])
        });
        limits.clamp(&nearest)
    }
}
