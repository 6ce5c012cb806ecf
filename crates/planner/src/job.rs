//! The whole job, stage after stage: scenario → arm → layout → tool path → joint path and execution → report.

pub use crate::error::{Infeasibility, PlanError};
pub use crate::place::place_plates;

use crate::control;
use crate::place::{region, spacing, start};
use crate::report::JobReport;
use crate::robot;
use crate::scenario::{IkMethod, Scenario};
use crate::tool_path::ToolPath;
use crate::tracking::{self, Step};
use platewash_kinematics::ik::{AnalyticStarts, IkSettings, IkSolver};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::layout::{self, Layout, Plate, Region};
use platewash_workcell::trajectory::Trajectory;

/// A job planned and followed, before it is judged.
#[derive(Debug, Clone)]
pub struct Job {
    /// What was asked.
    pub scenario: Scenario,
    /// The arm.
    pub robot: RobotModel,
    /// The plates.
    pub layout: Layout,
    /// What the tip shall do.
    pub tool_path: ToolPath,
    /// One step per waypoint of the tool path.
    pub steps: Vec<Step>,
    /// The commanded motion, from the start configuration on.
    pub planned: Trajectory,
    /// The motion that the control law makes of it.
    pub executed: Trajectory,
}

/// Checks a scenario without running it: the arm loads, the start lies within its limits, and the plates have room in
/// principle (given ones are placed; for sampled ones the region is not empty).
///
/// Returns the arm, and what is to be said about given plates.
///
/// # Errors
/// As [`Job::run`] for the same fault.
pub fn check(scenario: &Scenario) -> Result<(RobotModel, Vec<layout::Finding>), PlanError> {
    scenario.validate()?;
    let robot = robot::load(&scenario.robot)?;
    start(scenario, &robot)?;
    if scenario.layout.positions_m.is_some() {
        let findings = place_plates(scenario, &robot)?.findings;
        return Ok((robot, findings));
    }
    let region = region(&scenario.layout).unwrap_or(Region::PAPER_APPENDIX);
    layout::Sampler::new(&region, &spacing(&scenario.layout))?;
    Ok((robot, Vec::new()))
}

impl Job {
    /// Plans and follows a scenario.
    ///
    /// # Errors
    /// [`PlanError`], one variant a stage. A job that does not wash is no error: see [`Job::report`].
    pub fn run(scenario: &Scenario) -> Result<Self, PlanError> {
        scenario.validate()?;
        let robot = robot::load(&scenario.robot)?;
        let layout = place_plates(scenario, &robot)?;
        Self::on(scenario, robot, layout)
    }

    /// Plans and follows a scenario on plates that were placed before.
    ///
    /// # Errors
    /// As [`Job::run`].
    pub fn on(scenario: &Scenario, robot: RobotModel, layout: Layout) -> Result<Self, PlanError> {
        scenario.check_work()?;
        let start = start(scenario, &robot)?;
        let tool_path = ToolPath::new(scenario, &layout);
        let solver = IkSolver::new(
            &robot,
            platewash_workcell::tool::tip_frame(&robot, &scenario.tool),
            ik_settings(scenario),
        )?;
        let mut law = control::law(&scenario.control)?;
        let steps = tracking::follow(&robot, &solver, &tool_path, scenario.ik.seed, law.as_mut(), &start)?;
        let motion = |of: fn(&Step) -> JointVector| {
            let positions = std::iter::once(start).chain(steps.iter().map(of)).collect();
            Trajectory::through(positions, scenario.control.dt_s)
        };
        let (planned, executed) = (motion(|s| s.commanded), motion(|s| s.executed));
        Ok(Self {
            scenario: scenario.clone(),
            robot,
            layout,
            tool_path,
            steps,
            planned,
            executed,
        })
    }

    /// Judges the job: what was reached, how near it came, what it covered.
    ///
    /// # Errors
    /// [`PlanError::Clearance`] or [`PlanError::Coverage`].
    pub fn report(&self) -> Result<JobReport, PlanError> {
        let clearance = ClearanceModel::new(&self.robot, &self.scenario.tool, &self.layout.plates)?;
        JobReport::new(self, &clearance)
    }

    /// The plates.
    #[must_use]
    pub fn plates(&self) -> &[Plate] {
        &self.layout.plates
    }

    /// Time of a step \[s\]: the first waypoint is one time step after the start.
    #[must_use]
    pub fn time_of(&self, step: usize) -> f64 {
        self.planned.times().get(step + 1).copied().unwrap_or(0.0)
    }
}

/// Inverse-kinematics settings of a scenario: its tolerances, and analytic branches as starts unless the method is "numeric".
#[must_use]
pub fn ik_settings(scenario: &Scenario) -> IkSettings {
    let analytic_starts = match scenario.ik.method {
        IkMethod::Numeric => AnalyticStarts::Unused,
        IkMethod::Analytic => AnalyticStarts::Used,
    };
    IkSettings {
        analytic_starts,
        position_tolerance_m: scenario.ik.position_tolerance_m,
        orientation_tolerance_rad: scenario.ik.orientation_tolerance_rad,
        ..IkSettings::default()
    }
}
