//! What an arm makes of a plan under a control law, for `run`, `simulate` and `view`.

use super::failure::Failure;
use platewash::simulator::simulate::{Sample, simulate_watched};
use platewash::workcell::simulation::SimulationSettings;
use platewash::{CancelToken, Execution, Plan, RobotModel, SimulationError, SimulationReport};

/// Simulates and judges a plan.
pub fn carry_out(
    plan: &Plan,
    arm: &RobotModel,
    settings: &SimulationSettings,
    cancel: &CancelToken,
) -> Result<(Execution, SimulationReport), SimulationError> {
    carry_out_watched(plan, arm, settings, cancel, &mut |_| {})
}

/// As [`carry_out_watched`], where going on without an execution is no failure: why there is none, in words. To give up is one.
pub fn tried(
    plan: &Plan,
    arm: &RobotModel,
    cancel: &CancelToken,
    watch: &mut dyn FnMut(&Sample),
) -> Result<Result<(Execution, SimulationReport), String>, Failure> {
    match carry_out_watched(plan, arm, &plan.job.simulation, cancel, watch) {
        Ok(done) => Ok(Ok(done)),
        Err(SimulationError::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(error) => Ok(Err(platewash::Failure::from(error).to_string())),
    }
}

/// As [`carry_out`], and tells `watch` of each sample when it is known.
pub fn carry_out_watched(
    plan: &Plan,
    arm: &RobotModel,
    settings: &SimulationSettings,
    cancel: &CancelToken,
    watch: &mut dyn FnMut(&Sample),
) -> Result<(Execution, SimulationReport), SimulationError> {
    let execution = simulate_watched(plan, arm, settings, cancel, watch)?;
    let report = SimulationReport::new(plan, arm, settings, &execution)?;
    Ok((execution, report))
}

/// How long an execution of a plan lasts at most \[s\]: its last sample may come a period after the plan's end.
pub fn lasts_at_most_s(plan: &Plan, settings: &SimulationSettings) -> f64 {
    plan.duration_s() + settings.period_s()
}
