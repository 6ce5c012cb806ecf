//! Where the plates of a plan were drawn, which only a scenario knows.

use platewash::scenario::SHIPPED;
use platewash::workcell::layout::TaskRegion;
use platewash::{Plan, RobotModel, Scenario};

/// The region of a plan of a shipped scenario, if its plates lie where that scenario lays them; of any other plan nothing is known.
pub fn of_plan(plan: &Plan, arm: &RobotModel) -> TaskRegion {
    let name = plan.provenance.scenario.as_str();
    if !SHIPPED.iter().any(|shipped| shipped.name == name) {
        return TaskRegion::default();
    }
    let Ok(mut scenario) = Scenario::load(name) else {
        return TaskRegion::default();
    };
    scenario.seed = plan.job.seed;
    match scenario.layout(arm) {
        Ok(layout) if layout.plates == plan.job.plates => scenario.task_region(),
        _ => TaskRegion::default(),
    }
}
