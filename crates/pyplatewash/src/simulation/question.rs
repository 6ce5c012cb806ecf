//! The question of a simulation: a plan, its arm and the settings.

use crate::plan::PlanObject;
use crate::robot::Robot;
use crate::simulation::settings::SettingsObject;
use platewash::workcell::simulation::SimulationSettings;
use platewash::{Plan, RobotModel};
use pyo3::prelude::*;
use std::sync::Arc;

/// A plan, its arm and the settings.
pub struct Question {
    /// The plan.
    pub plan: Plan,
    /// The arm.
    pub arm: Arc<RobotModel>,
    /// The settings.
    pub settings: SimulationSettings,
}

impl Question {
    /// A plan for an arm, by default its own, and settings, by default those that it states.
    ///
    /// # Errors
    /// `InputTypeError`; `ProveError` for a plan whose arm must be given.
    pub fn new(
        plan: &Bound<'_, PlanObject>,
        robot: Option<&Bound<'_, PyAny>>,
        settings: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (robot, settings) = (Robot::given(robot)?, SettingsObject::given(settings)?);
        let arm = plan.get().arm(plan.py(), robot)?;
        let plan = plan.get().inner().clone();
        Ok(Self {
            settings: settings.map_or_else(
                || plan.job.simulation.clone(),
                |settings| settings.get().inner().clone(),
            ),
            arm,
            plan,
        })
    }
}
