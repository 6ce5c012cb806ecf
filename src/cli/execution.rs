//! What an arm makes of a plan under a control law, for `run` and `simulate`.

use platewash::simulator::simulate_with;
use platewash::workcell::simulation::SimulationSettings;
use platewash::{CancelToken, Execution, Plan, RobotModel, SimulationError, SimulationReport};

/// Simulates and judges a plan.
pub fn carry_out(
    plan: &Plan,
    arm: &RobotModel,
    settings: &SimulationSettings,
    cancel: &CancelToken,
) -> Result<(Execution, SimulationReport), SimulationError> {
    let execution = simulate_with(plan, arm, settings, cancel)?;
    let report = SimulationReport::new(plan, arm, settings, &execution)?;
    Ok((execution, report))
}

/// How long an execution of a plan lasts at most \[s\]: its last sample may come a period after the plan's end.
pub fn lasts_at_most_s(plan: &Plan, settings: &SimulationSettings) -> f64 {
    plan.duration_s() + settings.period_s()
}
