//! The executed motion as CSV.

use crate::simulate::execution::Execution;
use platewash_kinematics::RobotModel;
use platewash_motion::csv::{self, CsvError};
use platewash_motion::plan::Plan;
use std::fmt;

/// Columns in the header behind the plan's ([`csv::HEADER`]); [`csv::FORCE`] follows where force on the sponge was simulated.
pub const HEADER: &str = csv::TORQUES;

/// The executed motion at the samples nearest to multiples of `dt_s`, and the last one: the plan's columns, then the torque
/// held from then on, and the force on the sponge where it was simulated. Numbers are the shortest that read back exactly.
///
/// # Errors
/// [`CsvError::Step`] for a time step that is not positive or gives more than [`csv::MAX_ROWS`] rows.
pub fn table<'a>(
    execution: &'a Execution,
    plan: &'a Plan,
    robot: &'a RobotModel,
    dt_s: f64,
) -> Result<ExecutedTable<'a>, CsvError> {
    csv::check_step(execution.samples.last().map_or(0.0, |sample| sample.t_s), dt_s)?;
    Ok(ExecutedTable {
        execution,
        plan,
        robot,
        dt_s,
    })
}

/// An executed motion as CSV, made row by row while it is written: [`table`].
#[derive(Debug, Clone)]
pub struct ExecutedTable<'a> {
    execution: &'a Execution,
    plan: &'a Plan,
    robot: &'a RobotModel,
    dt_s: f64,
}

impl fmt::Display for ExecutedTable<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let samples = &self.execution.samples;
        let tip = self.plan.job.workcell.tool.tip_frame(self.robot);
        let stride = (self.dt_s / self.execution.period_s).max(1.0);
        let last = samples.len().saturating_sub(1);
        let force = if samples.first().is_some_and(|sample| sample.load.is_some()) {
            csv::FORCE
        } else {
            ""
        };
        writeln!(f, "{}{HEADER}{force}", csv::HEADER)?;
        let (mut next, mut row) = (0.0, String::new());
        for (k, sample) in samples.iter().enumerate() {
            if k != last && (k as f64) + 0.5 < next {
                continue;
            }
            next += stride;
            let at = self.robot.fk(&sample.state.q).rigid(&tip).translation;
            let motion = [&sample.state.q, &sample.state.qd, &sample.qdd];
            row.clear();
            csv::add_row(
                &mut row,
                sample.t_s,
                self.plan.segments.get(sample.segment),
                motion,
                &at,
            );
            csv::add_numbers(&mut row, &sample.torque);
            csv::add_numbers(&mut row, sample.load.iter().map(|felt| &felt.force_n));
            writeln!(f, "{row}")?;
        }
        Ok(())
    }
}
