//! Under which law, with which gains and on which plant a plan is simulated.

use super::SimulationError;
use platewash_planner::plan::Plan;
use platewash_planner::scenario::{ControlLawName, ControlSection, PlantSection};

/// Law, gains and plant. Those of the plan's scenario by [`Setup::of`]; change what shall differ.
#[derive(Debug, Clone, PartialEq)]
pub struct Setup {
    /// The law.
    pub law: ControlLawName,
    /// Its gains and sampling.
    pub control: ControlSection,
    /// The plant; not used by kinematic laws.
    pub plant: PlantSection,
}

impl Setup {
    /// What the scenario of a plan states.
    #[must_use]
    pub fn of(plan: &Plan) -> Self {
        let scenario = &plan.scenario;
        Self {
            law: scenario.law(),
            control: scenario.control.clone(),
            plant: scenario.plant.clone(),
        }
    }

    /// Time between samples \[s\]: `control.dt_s` for kinematic laws, 1 / `control.rate_hz` for torque laws.
    #[must_use]
    pub fn period_s(&self) -> f64 {
        if self.law.is_kinematic() {
            self.control.dt_s
        } else {
            1.0 / self.control.rate_hz
        }
    }

    /// Checks what the law does not check by itself; a plan file may state anything.
    pub(super) fn check(&self) -> Result<(), SimulationError> {
        let refuse = |key, expected, found| Err(SimulationError::Setting { key, expected, found });
        let plant = &self.plant;
        let period = self.period_s();
        if !(period.is_finite() && period > 0.0) {
            let key = if self.law.is_kinematic() {
                "control.dt_s"
            } else {
                "control.rate_hz"
            };
            return refuse(key, "finite and above 0", period);
        }
        if !(1..=1000).contains(&plant.substeps) {
            return refuse("plant.substeps", "from 1 to 1000", plant.substeps as f64);
        }
        let friction = [
            ("plant.viscous_friction_n_m_s", plant.viscous_friction_n_m_s),
            ("plant.coulomb_friction_n_m", plant.coulomb_friction_n_m),
            ("plant.contact_force_n", [plant.contact_force_n; 6]),
        ];
        for (key, values) in friction {
            if let Some(found) = values.into_iter().find(|v| !(v.is_finite() && *v >= 0.0)) {
                return refuse(key, "finite and not negative", found);
            }
        }
        let limits = plant.torque_limit_n_m.into_iter().flatten();
        if let Some(found) = limits.into_iter().find(|v| !(v.is_finite() && *v > 0.0)) {
            return refuse("plant.torque_limit_n_m", "finite and above 0", found);
        }
        Ok(())
    }
}
