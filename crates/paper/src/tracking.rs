//! Inverse kinematics along the tool path and the motion of the arm, one step per waypoint.
//!
//! The two belong together in the paper's program: each waypoint is solved from the configuration that the arm
//! **really** has, which lags behind, and an unsolved waypoint's best configuration is commanded all the same.

use crate::settings::IkSeed;
use crate::tool_path::ToolPath;
use nalgebra::Vector3;
use platewash_kinematics::ik::{IkCause, IkError, IkSolver, Method};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_simulator::PlantState;
use platewash_simulator::control::{Command, ControlLaw, Reference};
use platewash_workcell::cancel::{CancelToken, Cancelled};
use platewash_workcell::tool::tool_down;
use serde::Serialize;

/// The inverse kinematics' answer at one waypoint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum IkOutcome {
    /// Solved within tolerance and limits.
    Solved {
        /// The method that answered.
        method: Method,
    },
    /// Not solved: the best configuration found is commanded.
    Failed {
        /// Cause reported by the inverse kinematics.
        cause: IkCause,
    },
}

/// One waypoint: target, command and executed motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Index of the segment.
    pub segment: usize,
    /// Commanded position of the tip \[m\].
    pub target: Vector3<f64>,
    /// Configuration commanded \[rad\].
    pub commanded: JointVector,
    /// Configuration after the step \[rad\].
    pub executed: JointVector,
    /// Executed position of the tip after the step \[m\].
    pub executed_tip: Vector3<f64>,
    /// Outcome of the inverse kinematics.
    pub outcome: IkOutcome,
    /// Distance of the commanded tip from the target \[m\].
    pub ik_position_error_m: f64,
    /// Angle of the commanded tip from the target \[rad\].
    pub ik_orientation_error_rad: f64,
    /// Iterations spent.
    pub ik_iterations: usize,
}

impl Step {
    /// Returns true where the inverse kinematics solved this waypoint.
    #[must_use]
    pub fn is_reached(&self) -> bool {
        matches!(self.outcome, IkOutcome::Solved { .. })
    }

    /// Distance of the executed tip from the target \[m\].
    #[must_use]
    pub fn tracking_error_m(&self) -> f64 {
        (self.executed_tip - self.target).norm()
    }
}

/// Root mean square and maximum of the tracking error \[m\]; zeros without steps.
pub(crate) fn tracking_errors<'a>(steps: impl Iterator<Item = &'a Step>) -> (f64, f64) {
    let (count, sum, most) = steps
        .map(Step::tracking_error_m)
        .fold((0.0, 0.0, 0.0_f64), |(n, sum, most), error| {
            (n + 1.0, sum + error * error, most.max(error))
        });
    (f64::sqrt(sum / f64::max(count, 1.0)), most)
}

/// Joint positions beyond this are divergence, not motion \[rad\].
const LARGEST_POSITION_RAD: f64 = 1e6;

/// Reason that a path could not be followed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackingError {
    /// A waypoint or the start is not finite.
    #[error("waypoint {waypoint}: {error}")]
    Ik {
        /// Index of the waypoint, over all segments.
        waypoint: usize,
        /// Error of the inverse kinematics.
        error: IkError,
    },
    /// The control law drives a joint out of all bounds.
    #[error(
        "the control law diverges: joint {} is at {position_rad:.3e} rad after waypoint {waypoint}; smaller gains or a shorter time \
         step are needed", .joint + 1
    )]
    Divergence {
        /// Index of the waypoint, over all segments.
        waypoint: usize,
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Position of the joint \[rad\].
        position_rad: f64,
    },
    /// The control law drives torques, for which there is no plant here.
    #[error(
        "waypoint {waypoint}: the control law answers with torques; following waypoints needs a law that moves positions"
    )]
    Torque {
        /// Index of the waypoint, over all segments.
        waypoint: usize,
    },
    /// The work was cancelled on request.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Solves and follows every waypoint of `path` from the configuration `start` \[rad\].
///
/// # Errors
/// [`TrackingError`] for numbers that are not finite, for a control law that diverges or drives torques, and when `cancel` says so; an
/// unreachable waypoint is no error but a [`Step`] with [`IkOutcome::Failed`].
pub fn follow(
    robot: &RobotModel,
    solver: &IkSolver<'_>,
    path: &ToolPath,
    seed: IkSeed,
    law: &mut dyn ControlLaw,
    start: &JointVector,
    cancel: &CancelToken,
) -> Result<Vec<Step>, TrackingError> {
    let mut steps = Vec::with_capacity(path.len());
    let (mut executed, mut answer) = (*start, *start);
    for (segment, part) in path.segments.iter().enumerate() {
        law.begin_segment();
        for target in &part.waypoints {
            cancel.check()?;
            let from = match seed {
                IkSeed::Executed => executed,
                IkSeed::Previous => answer,
            };
            let waypoint = steps.len();
            let solved = solve(solver, segment, *target, &from);
            let mut step = solved.map_err(|error| TrackingError::Ik { waypoint, error })?;
            answer = step.commanded;
            executed = moved(law, &step.commanded, executed).ok_or(TrackingError::Torque { waypoint })?;
            check_bounded(waypoint, &executed)?;
            step.executed = executed;
            step.executed_tip = robot.fk(&executed).rigid(solver.frame()).translation;
            steps.push(step);
        }
    }
    Ok(steps)
}

/// Joint positions \[rad\] one step of a law after `position`, with `desired` commanded; `None` where it drives torques.
pub(crate) fn moved(law: &mut dyn ControlLaw, desired: &JointVector, position: JointVector) -> Option<JointVector> {
    match law.command(&Reference::towards(*desired), &PlantState::at_rest(position)) {
        Command::Position(q) => Some(q),
        Command::Torque(_) => None,
    }
}

fn check_bounded(waypoint: usize, q: &JointVector) -> Result<(), TrackingError> {
    // A range holds no NaN.
    let bounds = -LARGEST_POSITION_RAD..=LARGEST_POSITION_RAD;
    let stray = q.iter().position(|position| !bounds.contains(position));
    match stray {
        Some(joint) => Err(TrackingError::Divergence {
            waypoint,
            joint,
            position_rad: q[joint],
        }),
        None => Ok(()),
    }
}

/// Solves one waypoint; the executed part is filled in by the caller.
fn solve(solver: &IkSolver<'_>, segment: usize, target: Vector3<f64>, from: &JointVector) -> Result<Step, IkError> {
    let (commanded, outcome, position, orientation, iterations) = match solver.solve(&tool_down(target), from) {
        Ok(s) => {
            let outcome = IkOutcome::Solved { method: s.method };
            (s.q, outcome, s.position_error_m, s.orientation_error_rad, s.iterations)
        }
        Err(IkError::NotSolved(f)) => {
            let outcome = IkOutcome::Failed { cause: f.cause };
            (f.q, outcome, f.position_error_m, f.orientation_error_rad, f.iterations)
        }
        Err(other) => return Err(other),
    };
    Ok(Step {
        segment,
        target,
        commanded,
        executed: commanded,
        executed_tip: target,
        outcome,
        ik_position_error_m: position,
        ik_orientation_error_rad: orientation,
        ik_iterations: iterations,
    })
}
