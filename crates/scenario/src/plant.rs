//! The `[plant]` section.

use platewash_workcell::simulation::{Integrator, PlantSettings};
use serde::{Deserialize, Serialize};

/// `[plant]`: the arm as a physical system, where a law gives torques. Friction, torque limits and contact force are off
/// unless given: there are no published figures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlantSection {
    /// How the motion is integrated.
    pub integrator: Integrator,
    /// Steps of integration to a sample of the law.
    pub substeps: usize,
    /// Friction torque per joint speed \[N·m·s/rad\].
    pub viscous_friction_n_m_s: [f64; 6],
    /// Friction torque against any motion \[N·m\].
    pub coulomb_friction_n_m: [f64; 6],
    /// Largest joint torques \[N·m\]; without them, those of the arm's description where it knows any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub torque_limit_n_m: Option<[f64; 6]>,
    /// Force of a plate on the sponge while it washes, along the plate's normal \[N\].
    pub contact_force_n: f64,
}

impl PlantSection {
    /// The plant.
    #[must_use]
    pub fn settings(&self) -> PlantSettings {
        PlantSettings {
            integrator: self.integrator,
            substeps: self.substeps,
            viscous_friction_n_m_s: self.viscous_friction_n_m_s,
            coulomb_friction_n_m: self.coulomb_friction_n_m,
            torque_limit_n_m: self.torque_limit_n_m,
            contact_force_n: self.contact_force_n,
        }
    }
}

impl Default for PlantSection {
    fn default() -> Self {
        let PlantSettings {
            integrator,
            substeps,
            viscous_friction_n_m_s,
            coulomb_friction_n_m,
            torque_limit_n_m,
            contact_force_n,
        } = PlantSettings::default();
        Self {
            integrator,
            substeps,
            viscous_friction_n_m_s,
            coulomb_friction_n_m,
            torque_limit_n_m,
            contact_force_n,
        }
    }
}
