//! Inverse kinematics along a path, without jumps.
//!
//! # What is guaranteed
//!
//! Between neighbouring waypoints no joint moves by more than [`LARGEST_STEP_RAD`]; or, where the path itself asks for more,
//! the way between them (straight for the position, geodesic for the orientation) was followed in steps that small, each
//! solved from the last. A configuration on another branch is never taken. Where no such motion exists, the error names
//! the waypoint and why.
//!
//! # How
//!
//! Each waypoint is first tried from a prediction: the quadratic through the last three answers, which leaves an error of third
//! order in the spacing, so that one damped step mostly suffices. If that fails or steps too far, the waypoint is solved from
//! the last answer; if that steps too far, the way is halved, up to [`MOST_HALVINGS`] times.

use crate::ik::answer::{IkCause, IkError};
use crate::ik::cascade::IkSolver;
use crate::ik::dls::{self, ALL_FREE, Iterate, Stop, Task};
use crate::joints::JointVector;
use crate::rotation::Pose;
use nalgebra::UnitQuaternion;

/// Largest joint motion between waypoints that counts as continuous without further checks \[rad\].
pub const LARGEST_STEP_RAD: f64 = 0.1;

/// Greatest number of halvings of the way between two waypoints before a step that stays large is called a jump.
pub const MOST_HALVINGS: u32 = 12;

/// Solution along a path.
#[derive(Debug, Clone, PartialEq)]
pub struct IkPath {
    /// One configuration per waypoint \[rad\].
    pub q: Vec<JointVector>,
    /// Number of linear systems solved, over all waypoints.
    pub iterations: usize,
}

/// Reason that a path breaks off.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PathBreak {
    /// A joint is at its limit and would have to go on.
    #[error("joint {} is at its limit", .joint + 1)]
    Limit {
        /// Joint index, 0 for joint 1.
        joint: usize,
    },
    /// The way leads through a singularity at which joints would have to turn without bound.
    #[error("a joint would have to jump by {jump_rad:.3} rad at a singularity")]
    Singularity {
        /// Largest joint motion that remains on the shortest step tried \[rad\].
        jump_rad: f64,
    },
    /// The branch ends: the next pose is out of reach, or can be reached on another branch only.
    #[error("this branch ends ({cause}), {position_error_m:.3e} m and {orientation_error_rad:.3e} rad short")]
    BranchEnd {
        /// Reason that no configuration near the last one reaches the next pose.
        cause: IkCause,
        /// Remaining distance \[m\].
        position_error_m: f64,
        /// Remaining angle \[rad\].
        orientation_error_rad: f64,
    },
}

/// Reason that no continuous motion along a path was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IkPathError {
    /// A waypoint or the seed is not finite, or the first waypoint has no solution.
    #[error("waypoint {waypoint}: {error}")]
    Waypoint {
        /// Index of the waypoint.
        waypoint: usize,
        /// Reason.
        error: IkError,
    },
    /// The motion breaks off on the way to a waypoint.
    #[error("on the way to waypoint {waypoint}: {reason}")]
    Broken {
        /// Index of the waypoint that is not reached.
        waypoint: usize,
        /// Reason.
        reason: PathBreak,
        /// Configurations up to there \[rad\].
        solved: Vec<JointVector>,
    },
}

impl IkSolver<'_> {
    /// Returns configurations that bring the frame through `targets` (`T_base_frame`) without a jump. The first waypoint is solved from
    /// `seed` \[rad\] as by [`IkSolver::solve`].
    ///
    /// # Errors
    /// [`IkPathError`] with the waypoint and the reason; an empty path is no error.
    pub fn solve_path(&self, targets: &[Pose], seed: &JointVector) -> Result<IkPath, IkPathError> {
        let Some(first) = targets.first() else {
            return Ok(IkPath {
                q: Vec::new(),
                iterations: 0,
            });
        };
        let at = |waypoint| move |error| IkPathError::Waypoint { waypoint, error };
        let start = self.solve(first, seed).map_err(at(0))?;
        let mut iterations = start.iterations;
        let mut q = Vec::with_capacity(targets.len());
        q.push(start.q);
        for (waypoint, pair) in targets.windows(2).enumerate().map(|(k, pair)| (k + 1, pair)) {
            let task = self.task(&pair[1]).map_err(at(waypoint))?;
            let last = q[waypoint - 1];
            let next = match self.answer_near(&task, predict(&q), &last, &mut iterations) {
                Some(next) => next,
                None => match self.creep(&pair[0], &pair[1], &last, MOST_HALVINGS, &mut iterations) {
                    Ok(next) => next,
                    Err(reason) => {
                        let solved = q;
                        return Err(IkPathError::Broken {
                            waypoint,
                            reason,
                            solved,
                        });
                    }
                },
            };
            q.push(next);
        }
        Ok(IkPath { q, iterations })
    }

    /// Returns the answer from a prediction, if it is a small step away from the last one.
    fn answer_near(
        &self,
        task: &Task<'_>,
        guess: JointVector,
        last: &JointVector,
        iterations: &mut usize,
    ) -> Option<JointVector> {
        let start = self.robot.limits().clamp(&guess);
        let descent = dls::descend(task, start, &ALL_FREE, &self.settings);
        *iterations += descent.iterations;
        let solved = descent.stop == Stop::Solved && self.robot.limits().contain(&descent.best.q);
        (solved && step(&descent.best.q, last) <= LARGEST_STEP_RAD).then_some(descent.best.q)
    }

    /// Follows the way from `from` to `to` in halves until every step is small.
    fn creep(
        &self,
        from: &Pose,
        to: &Pose,
        last: &JointVector,
        halvings: u32,
        iterations: &mut usize,
    ) -> Result<JointVector, PathBreak> {
        let task = self.task_unchecked(to);
        let descent = dls::descend(&task, *last, &ALL_FREE, &self.settings);
        *iterations += descent.iterations;
        let moved = step(&descent.best.q, last);
        let solved = task.solved(&descent.best) && self.robot.limits().contain(&descent.best.q);
        if solved && moved <= LARGEST_STEP_RAD {
            return Ok(descent.best.q);
        }
        if halvings == 0 {
            return Err(self.break_reason(&task, &descent.best, solved, moved));
        }
        let middle = halfway(from, to);
        let there = self.creep(from, &middle, last, halvings - 1, iterations)?;
        self.creep(&middle, to, &there, halvings - 1, iterations)
    }

    fn break_reason(&self, task: &Task<'_>, best: &Iterate, solved: bool, jump_rad: f64) -> PathBreak {
        if solved {
            return PathBreak::Singularity { jump_rad };
        }
        match self.cause(task, best) {
            IkCause::Limit { joint } => PathBreak::Limit { joint },
            cause => PathBreak::BranchEnd {
                cause,
                position_error_m: best.position_error(),
                orientation_error_rad: best.orientation_error(),
            },
        }
    }
}

/// Largest motion of a joint between two configurations \[rad\].
fn step(a: &JointVector, b: &JointVector) -> f64 {
    (a - b).amax()
}

/// Predicts the next configuration by the polynomial through the last one, two or three.
fn predict(q: &[JointVector]) -> JointVector {
    match q {
        [.., a, b, c] => (c - b) * 3.0 + a,
        [a, b] => b * 2.0 - a,
        [a] => *a,
        [] => JointVector::zeros(),
    }
}

/// Returns the pose half-way: straight for the position, geodesic for the orientation.
fn halfway(from: &Pose, to: &Pose) -> Pose {
    let middle = (from.translation.vector + to.translation.vector) * 0.5;
    let turn = (to.rotation * from.rotation.inverse()).scaled_axis() * 0.5;
    Pose::from_parts(middle.into(), UnitQuaternion::from_scaled_axis(turn) * from.rotation)
}
