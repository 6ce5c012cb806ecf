//! A plan under a control law: setup, execution, report, and many settings.

mod execution;
mod setup;
mod tuning;

pub use execution::{ExecutionObject, simulate};
pub use setup::SetupObject;
pub use tuning::tune;

use crate::errors;
use crate::plan::PlanObject;
use crate::robot::Robot;
use platewash::planner::certificate;
use platewash::{Plan, RobotModel, Setup, SimulationError, VerifyError};
use pyo3::prelude::*;
use std::sync::Arc;

/// What is simulated: a plan, its arm (`None` for the built-in one, where the plan names no other) and the setup.
struct Question {
    plan: Plan,
    robot: Option<Arc<RobotModel>>,
    setup: Setup,
}

/// Why there is no answer.
enum Refused {
    /// The plan's arm is not at hand.
    Arm(VerifyError),
    /// The rest.
    Simulation(SimulationError),
}

impl Refused {
    fn raised(&self, py: Python<'_>) -> PyErr {
        match self {
            Self::Arm(error) => errors::verify(py, error),
            Self::Simulation(error) => errors::simulation(py, error),
        }
    }
}

impl Question {
    fn new(plan: &PlanObject, setup: Option<&Bound<'_, SetupObject>>, robot: Option<&Bound<'_, Robot>>) -> Self {
        let (robot, plan) = (plan.arm(robot), plan.inner().clone());
        Self {
            setup: setup.map_or_else(
                || setup::without_law(Setup::of(&plan)),
                |setup| setup.get().inner().clone(),
            ),
            robot,
            plan,
        }
    }

    fn arm(&self) -> Result<Arc<RobotModel>, Refused> {
        match &self.robot {
            Some(robot) => Ok(robot.clone()),
            None => certificate::arm(&self.plan, None).map(Arc::new).map_err(Refused::Arm),
        }
    }
}
