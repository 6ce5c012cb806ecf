//! The executed motion as CSV.

use super::Execution;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_planner::csv::{self, CsvError};
use platewash_planner::plan::Plan;
use platewash_planner::robot;
use std::fmt::Write;

/// What stands in the header behind the plan's columns ([`csv::HEADER`]).
pub const HEADER: &str = ",tau1_n_m,tau2_n_m,tau3_n_m,tau4_n_m,tau5_n_m,tau6_n_m";

/// The executed motion at the samples nearest to multiples of `dt_s`, and the last one: the plan's columns, then the torque
/// held from then on. Numbers are the shortest that read back exactly.
///
/// # Errors
/// [`CsvError::Step`] for a time step that is not positive or gives more than [`csv::MAX_ROWS`] rows.
pub fn table(execution: &Execution, plan: &Plan, robot: &RobotModel, dt_s: f64) -> Result<String, CsvError> {
    let samples = &execution.samples;
    let duration_s = samples.last().map_or(0.0, |sample| sample.t_s);
    csv::check_step(duration_s, dt_s)?;
    let tip = robot::tip_frame(robot, &plan.tool);
    let stride = (dt_s / execution.period_s).max(1.0);
    let mut text = format!("{}{HEADER}\n", csv::HEADER);
    let last = samples.len().saturating_sub(1);
    let mut next = 0.0;
    for (k, sample) in samples.iter().enumerate() {
        if k != last && (k as f64) + 0.5 < next {
            continue;
        }
        next += stride;
        let segment = plan.segments.get(sample.segment);
        let (kind, plate) = segment.map_or(("", String::new()), |s| (s.kind.name(), s.plate.to_string()));
        // Writing to a String cannot fail.
        let _ = write!(text, "{},{kind},{plate}", sample.t_s);
        for row in [&sample.state.q, &sample.state.qd, &sample.qdd] {
            push(&mut text, row);
        }
        let at = robot.fk(&sample.state.q).rigid(&tip).translation;
        let _ = write!(text, ",{},{},{}", at.x, at.y, at.z);
        push(&mut text, &sample.torque);
        text.push('\n');
    }
    Ok(text)
}

fn push(text: &mut String, row: &JointVector) {
    for value in row.iter() {
        let _ = write!(text, ",{value}");
    }
}
