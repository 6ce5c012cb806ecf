//! The planned motion as a table, for `plan` and `run`.

use super::failure::Failure;
use super::options::Options;
use super::results;
use super::time_step::TimeStep;
use clap::Args;
use platewash::workcell::csv::{self, MotionTable};
use platewash::workcell::segment::PlanSegment;
use platewash::{RobotModel, Scenario, Trajectory};
use std::path::PathBuf;

/// Where the planned motion goes, and in which steps.
#[derive(Debug, Args, Default)]
pub struct MotionArguments {
    /// File for the planned motion's CSV [default: trajectory.csv in the output folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    #[command(flatten)]
    pub time_step: TimeStep,
}

impl MotionArguments {
    /// Where the planned motion's CSV goes.
    pub fn csv_file(&self, options: &Options) -> PathBuf {
        let default = || results::folder(options).join("trajectory.csv");
        self.csv.clone().unwrap_or_else(default)
    }

    /// A motion of the scenario's tool as CSV.
    pub fn table<'a>(
        &self,
        scenario: &Scenario,
        arm: &'a RobotModel,
        motion: &'a Trajectory,
        segments: &'a [PlanSegment],
    ) -> Result<MotionTable<'a>, Failure> {
        let tip = scenario.tool_on(arm)?.tip_frame(arm);
        let dt_s = self.time_step.or(scenario.control.dt_s, motion.duration_s())?;
        Ok(csv::table(motion, segments, arm, &tip, dt_s)?)
    }
}
