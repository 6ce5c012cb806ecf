//! The planned motion as a table, for `plan` and `run`.

use super::failure::Failure;
use super::options::Options;
use super::results;
use super::time_step::TimeStep;
use clap::Args;
use platewash::workcell::csv::{self, MotionTable};
use platewash::workcell::trajectory::PlanSegment;
use platewash::{RobotModel, Scenario, Trajectory};
use std::path::PathBuf;
use std::time::Duration;

/// Where the planned motion goes, and in which steps.
#[derive(Debug, Args)]
pub struct MotionArguments {
    /// CSV file for the planned motion [default: trajectory.csv in the output folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    #[command(flatten)]
    pub time_step: TimeStep,
    /// If the job is not planned or not proved: seconds to search for keys whose change helps, and as long again for other causes
    #[arg(long, value_name = "S", default_value_t = SEARCH_S, value_parser = search_time, allow_negative_numbers = true)]
    pub search_time: f64,
}

/// How long is searched where nothing else is stated \[s\].
const SEARCH_S: f64 = 3.0;

/// A time from 0 to a day \[s\].
fn search_time(text: &str) -> Result<f64, String> {
    let time = text.parse::<f64>().ok().filter(|time| (0.0..=86400.0).contains(time));
    time.ok_or_else(|| "expected a time from 0 to 86400 s".to_owned())
}

impl Default for MotionArguments {
    fn default() -> Self {
        Self {
            csv: None,
            time_step: TimeStep::default(),
            search_time: SEARCH_S,
        }
    }
}

impl MotionArguments {
    /// How long is looked for what would mend a job.
    pub fn search_time(&self) -> Duration {
        Duration::from_secs_f64(self.search_time)
    }

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
