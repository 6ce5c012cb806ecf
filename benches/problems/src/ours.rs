//! Our own, with the settings that users get.

use crate::problems::Problems;
use crate::solver::{Solver, Solvers};
use platewash_kinematics::ik::analytic::AnalyticArm;
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{JointVector, Pose, RobotModel, ToolFrame};
use std::error::Error;

fn solver<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<IkSolver<'a>, Box<dyn Error>> {
    let settings = IkSettings {
        position_tolerance_m: problems.tolerance.position_m,
        orientation_tolerance_rad: problems.tolerance.orientation_rad,
        ..IkSettings::default()
    };
    Ok(IkSolver::new(robot, robot.tool_frame(ToolFrame::Tool0)?, settings)?)
}

/// For a spiral: the whole path, then each point from the last answer.
///
/// # Errors
/// An arm without `tool0`.
pub fn warm<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    Ok(vec![
        Box::new(Path::new(robot, problems)?),
        Box::new(NumericIk::new(robot, problems)?),
    ])
}

/// For poses that have nothing to do with each other.
///
/// # Errors
/// An arm without `tool0`.
pub fn cold<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    Ok(vec![Box::new(NumericIk::new(robot, problems)?)])
}

/// The closed form alone, asked for the branch nearest to the start.
///
/// # Errors
/// An arm without a closed form.
pub fn nearest<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    Ok(vec![Box::new(AnalyticIk::new(robot, problems)?)])
}

/// `platewash_kinematics::ik::IkSolver::solve`: damped least squares, QP and analytic starts.
pub struct NumericIk<'a> {
    solver: IkSolver<'a>,
    targets: Vec<Pose>,
}

impl<'a> NumericIk<'a> {
    /// Prepares the solver for `tool0`.
    ///
    /// # Errors
    /// An arm without `tool0`.
    pub fn new(robot: &'a RobotModel, problems: &Problems) -> Result<Self, Box<dyn Error>> {
        Ok(Self {
            solver: solver(robot, problems)?,
            targets: problems.targets.clone(),
        })
    }
}

impl Solver for NumericIk<'_> {
    fn name(&self) -> &'static str {
        "platewash `solve`"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        self.solver
            .solve(&self.targets[target], seed)
            .ok()
            .map(|answer| answer.q)
    }
}

/// `platewash_kinematics::ik::IkSolver::solve_path`: damped least squares from a prediction, without jumps.
pub struct Path<'a>(NumericIk<'a>);

impl<'a> Path<'a> {
    /// Prepares the solver for `tool0`.
    ///
    /// # Errors
    /// An arm without `tool0`.
    pub fn new(robot: &'a RobotModel, problems: &Problems) -> Result<Self, Box<dyn Error>> {
        Ok(Self(NumericIk::new(robot, problems)?))
    }
}

impl Solver for Path<'_> {
    fn name(&self) -> &'static str {
        "platewash `solve_path`"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        self.0.solve(target, seed)
    }

    fn path(&mut self, start: &JointVector) -> Option<Vec<Option<JointVector>>> {
        let NumericIk { solver, targets } = &self.0;
        Some(match solver.solve_path(targets, start) {
            Ok(path) => path.q.into_iter().map(Some).collect(),
            Err(_) => vec![None; targets.len()],
        })
    }
}

/// `platewash_kinematics::ik::analytic::AnalyticArm::nearest`: the closed form alone.
pub struct AnalyticIk<'a> {
    robot: &'a RobotModel,
    arm: AnalyticArm,
    targets: Vec<RigidTransform>,
}

impl<'a> AnalyticIk<'a> {
    /// Prepares the solver for `tool0`.
    ///
    /// # Errors
    /// An arm without a closed form or without `tool0` behind joint 6.
    pub fn new(robot: &'a RobotModel, problems: &Problems) -> Result<Self, Box<dyn Error>> {
        let tool0 = robot.tool_frame(ToolFrame::Tool0)?;
        let body = |pose: &Pose| AnalyticArm::body_target(&tool0, &RigidTransform::from(pose));
        let targets: Option<Vec<RigidTransform>> = problems.targets.iter().map(body).collect();
        Ok(Self {
            robot,
            arm: AnalyticArm::recognise(robot)?,
            targets: targets.ok_or("tool0 is not behind joint 6")?,
        })
    }
}

impl Solver for AnalyticIk<'_> {
    fn name(&self) -> &'static str {
        "platewash `nearest`"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        let answer = self.arm.nearest(&self.targets[target], seed, self.robot.limits());
        answer.ok().map(|nearest| nearest.q)
    }
}
