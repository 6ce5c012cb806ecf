//! What a solver's answers are worth, by our own forward kinematics.

use crate::Tolerance;
use crate::problems::{Problems, Seeds};
use crate::solver::Solver;
use platewash_kinematics::rotation::{RigidTransform, rotation_vector};
use platewash_kinematics::{JointVector, Pose, RobotModel, ToolFrame, ToolFrameError};

/// Peers measure the error with other formulas; this much more than the tolerance is rounding.
const ROUNDING: f64 = 1.0 + 1e-3;

/// Outcome of one pass over a workload.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Score {
    /// Targets.
    pub count: usize,
    /// Answers within both tolerances and the joint limits.
    pub solved: usize,
    /// Answers that are not, although the solver called them solved.
    pub wrong: usize,
    /// Along a path, the largest step of a joint between consecutive answers \[rad\].
    pub largest_step_rad: Option<f64>,
}

impl Score {
    /// Runs the workload once and checks every answer.
    ///
    /// # Errors
    /// An arm without `tool0`.
    pub fn of(solver: &mut dyn Solver, problems: &Problems, robot: &RobotModel) -> Result<Self, ToolFrameError> {
        let mut answers = Vec::with_capacity(problems.targets.len());
        problems.run(solver, |_, answer| answers.push(answer));
        Self::of_answers(answers, problems, robot)
    }

    /// Checks the answers to the workload's targets, in their order.
    ///
    /// # Errors
    /// An arm without `tool0`.
    pub fn of_answers(
        answers: impl IntoIterator<Item = Option<JointVector>>,
        problems: &Problems,
        robot: &RobotModel,
    ) -> Result<Self, ToolFrameError> {
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let mut score = Self {
            count: problems.targets.len(),
            solved: 0,
            wrong: 0,
            largest_step_rad: None,
        };
        let path = matches!(problems.seeds, Seeds::LastAnswer(_));
        let mut last: Option<JointVector> = None;
        for (target, answer) in problems.targets.iter().zip(answers) {
            let Some(q) = answer else { continue };
            let found = robot.fk(&q).rigid(&tool0);
            if robot.limits().contain(&q) && reached(target, &found, problems.tolerance) {
                score.solved += 1;
            } else {
                score.wrong += 1;
            }
            if let Some(last) = last.replace(q).filter(|_| path) {
                let step = (q - last).amax();
                score.largest_step_rad = Some(score.largest_step_rad.map_or(step, |s| s.max(step)));
            }
        }
        Ok(score)
    }

    /// Share of the targets that were solved \[%\].
    #[must_use]
    pub fn percent(&self) -> f64 {
        100.0 * self.solved as f64 / self.count as f64
    }
}

fn reached(target: &Pose, pose: &RigidTransform, tolerance: Tolerance) -> bool {
    let [position_m, angle_rad] = errors(&RigidTransform::from(target), pose);
    position_m <= tolerance.position_m * ROUNDING && angle_rad <= tolerance.orientation_rad * ROUNDING
}

/// Distance \[m\] and angle \[rad\] between two poses.
#[must_use]
pub fn errors(target: &RigidTransform, pose: &RigidTransform) -> [f64; 2] {
    let turn = target.rotation * pose.rotation.transpose();
    [
        (target.translation - pose.translation).norm(),
        rotation_vector(&turn).norm(),
    ]
}
