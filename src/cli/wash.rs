//! The planning of a washing, with a sign of life.

use super::failure::Failure;
use super::motion::MotionArguments;
use super::options::Options;
use super::output::{self, File};
use super::progress::Progress;
use super::results;
use platewash::planner::{self, Planned, Watch, plan_with};
use platewash::workcell::layout::Finding;
use platewash::{Layout, RobotModel, Scenario, Trajectory};
use std::sync::Arc;

/// A washing, planned.
pub struct Washing {
    /// The arm.
    pub arm: Arc<RobotModel>,
    /// What is to be said about the plates.
    pub findings: Vec<Finding>,
    /// The plan.
    pub planned: Planned,
    /// Its motion.
    motion: Trajectory,
}

/// Plans the washing that the scenario asks for.
pub fn plan(options: &Options, scenario: &Scenario) -> Result<Washing, platewash::Failure> {
    let arm = options.arm(scenario)?;
    options.warn(&scenario.notes_on_meshes());
    let progress = Progress::new(options.quiet, "planning");
    let watch = Watch {
        tell: &|activity| progress.say("planning", activity),
        cancel: &options.cancel,
    };
    // What fails wherever the plates lie, before they are placed.
    planner::check(&arm, &scenario.terms(&arm, &Layout::of(Vec::new()))?)?;
    let layout = scenario.place(&arm, &watch)?;
    let planned = plan_with(&scenario.job_on(&arm, &layout)?, &watch)?;
    let motion = planned.plan.knots.motion().map_err(planner::PlanError::from)?;
    tracing::info!("planned {} knots", motion.times().len());
    Ok(Washing {
        arm,
        findings: layout.findings,
        planned,
        motion,
    })
}

impl Washing {
    /// The plan file and its motion's CSV, not written yet.
    pub fn files<'a>(
        &'a self,
        options: &Options,
        scenario: &Scenario,
        arguments: &MotionArguments,
    ) -> Result<Vec<File<'a>>, Failure> {
        let plan = &self.planned.plan;
        let csv = arguments.table(scenario, &self.arm, &self.motion, &plan.segments)?;
        let json = plan.to_json().map_err(platewash::Failure::from)?;
        Ok(vec![
            output::file(results::folder(options).join("plan.json"), json),
            output::file(arguments.csv_file(options), csv),
        ])
    }
}
