//! Our own: damped least squares, QP and listed starts, with the settings that users get.

use super::Solver;
use crate::{ORIENTATION_TOLERANCE_RAD, POSITION_TOLERANCE_M};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, Pose, RobotModel, ToolFrame};
use std::error::Error;

/// `platewash_kinematics::ik`.
pub struct Platewash<'a> {
    solver: IkSolver<'a>,
    targets: Vec<Pose>,
}

impl<'a> Platewash<'a> {
    /// Prepares the solver for `tool0`.
    ///
    /// # Errors
    /// An arm without `tool0`.
    pub fn new(robot: &'a RobotModel, targets: &[Pose]) -> Result<Self, Box<dyn Error>> {
        let settings = IkSettings {
            position_tolerance_m: POSITION_TOLERANCE_M,
            orientation_tolerance_rad: ORIENTATION_TOLERANCE_RAD,
            ..IkSettings::default()
        };
        Ok(Self {
            solver: IkSolver::new(robot, robot.tool_frame(ToolFrame::Tool0)?, settings)?,
            targets: targets.to_vec(),
        })
    }
}

impl Solver for Platewash<'_> {
    fn name(&self) -> &'static str {
        "platewash"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        self.solver
            .solve(&self.targets[target], seed)
            .ok()
            .map(|answer| answer.q)
    }
}
