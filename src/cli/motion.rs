//! Motions as CSV, for `run`, `plan` and `simulate`: where they go, and in which time steps.

use super::files::{Files, RESULTS};
use super::numbers::within;
use super::options::Options;
use anyhow::{Result, anyhow};
use clap::Args;
use platewash::motion::csv::{self, MAX_ROWS, MotionTable, check_step};
use platewash::scenario::TIME_STEPS_S;
use platewash::{Plan, RobotModel, Scenario, Trajectory};
use std::path::PathBuf;
use std::time::Duration;

/// `--dt`.
#[derive(Debug, Args, Default)]
pub struct TimeStep {
    /// Time step of the CSV files in seconds, 0.000001 to 10 [default: the scenario's control.dt_s]
    #[arg(long, value_name = "S", value_parser = time_step, allow_negative_numbers = true)]
    pub dt: Option<f64>,
}

impl TimeStep {
    /// The time step \[s\], by default the one that is stated, if it gives not too many rows for `duration_s` of motion; the step that
    /// is suggested otherwise is accepted when it is typed in.
    pub fn or(&self, stated_s: f64, duration_s: f64) -> Result<f64> {
        let dt_s = self.dt.unwrap_or(stated_s);
        let (key, instead) = match self.dt {
            Some(_) => ("--dt", ""),
            None => ("control.dt_s", ", there or as --dt"),
        };
        let [_, most] = TIME_STEPS_S;
        check_step(duration_s, most).map_err(|_| {
            anyhow!(
                "no time step up to {most} s gives at most {MAX_ROWS} rows of CSV for {duration_s:.0} s of motion: wash.speed_m_s, \
                 wash.acceleration_m_s2 and the keys of [limits] decide how long it takes"
            )
        })?;
        check_step(duration_s, dt_s).map_err(|error| anyhow!("{key}: {error}{instead}"))?;
        Ok(dt_s)
    }
}

fn time_step(text: &str) -> Result<f64> {
    let [least, most] = TIME_STEPS_S;
    let expected = format!("must be a positive number of seconds, from {least} to {most}");
    within(text, least..=most, &expected)
}

/// Arguments for the CSV file of the planned motion, its time step and the search for remedies.
#[derive(Debug, Args, Default)]
pub struct MotionArguments {
    /// CSV file for the planned motion [default: trajectory.csv in the output folder]
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    #[command(flatten)]
    pub time_step: TimeStep,
    /// If the job is not planned or not proved: seconds to search for keys whose change helps, and as long again for other causes
    /// [default: 3]
    #[arg(long, value_name = "S", value_parser = search_time, allow_negative_numbers = true)]
    search_time: Option<f64>,
}

/// Default search time \[s\].
const SEARCH_S: f64 = 3.0;

/// A time from 0 to a day \[s\].
fn search_time(text: &str) -> Result<f64> {
    within(text, 0.0..=86400.0, "expected a time from 0 to 86400 s")
}

impl MotionArguments {
    /// Longest search for keys whose change helps: that of `--search-time`, or the default.
    pub fn search_time(&self) -> Duration {
        Duration::from_secs_f64(self.search_time.unwrap_or(SEARCH_S))
    }

    /// Path of the CSV file of the planned motion.
    pub fn csv_file(&self, options: &Options) -> PathBuf {
        let default = || options.folder().join("trajectory.csv");
        self.csv.clone().unwrap_or_else(default)
    }

    /// A motion along a plan of the scenario, as CSV.
    pub fn table<'a>(
        &self,
        scenario: &Scenario,
        arm: &'a RobotModel,
        motion: &'a Trajectory,
        plan: &'a Plan,
    ) -> Result<MotionTable<'a>> {
        let tip = scenario.tool_on(arm)?.tip_frame(arm);
        let dt_s = self.time_step.or(scenario.control.dt_s, motion.duration_s())?;
        Ok(csv::table(motion, &plan.segments, arm, &tip, dt_s)?)
    }

    /// The plan file and the planned motion's CSV, not written yet.
    pub fn files<'a>(
        &self,
        options: &Options,
        scenario: &Scenario,
        arm: &'a RobotModel,
        motion: &'a Trajectory,
        plan: &'a Plan,
    ) -> Result<Files<'a>> {
        let mut files = Files::new(options.folder(), &RESULTS);
        files.add("plan.json", plan.to_json().map_err(platewash::Failure::from)?);
        files.add_at(self.csv_file(options), self.table(scenario, arm, motion, plan)?);
        Ok(files)
    }
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Whatever is refused: the step suggested, typed in, is accepted, by the parser and by the table.
        #[test]
        fn a_suggested_step_is_accepted_as_an_option(mantissa in 1.0..10.0_f64, exponent in 0..7_i32, asked in -6.0..1.0_f64) {
            let duration_s = mantissa * 10_f64.powi(exponent);
            let dt = time_step(&10_f64.powf(asked).to_string()).ok();
            let Err(error) = (TimeStep { dt }).or(1.0, duration_s) else { return Ok(()) };
            let message = error.to_string();
            if message.starts_with("no time step") {
                prop_assert!(duration_s > 0.99e7);
                return Ok(());
            }
            let suggested = message.split("at least ").nth(1).and_then(|s| s.split(' ').next()).unwrap();
            let dt_s = time_step(suggested).unwrap();
            prop_assert!(TimeStep { dt: Some(dt_s) }.or(1.0, duration_s).is_ok(), "{message}");
        }
    }

    #[test]
    fn steps_out_of_the_range_of_the_key_are_refused() {
        for text in ["0", "-1", "1e-9", "1e9", "nan", "inf", "x"] {
            let message = time_step(text).unwrap_err().to_string();
            assert!(message.contains("from 0.000001 to 10"), "{text}: {message}");
        }
        assert_eq!((time_step("1e-6").unwrap(), time_step("10").unwrap()), (1e-6, 10.0));
    }
}
