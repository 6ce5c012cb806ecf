//! The `[plant]` section.

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

/// How the motion is integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Integrator {
    /// Speeds first, then positions with the new speeds: first order, one evaluation a step.
    SemiImplicitEuler,
    /// The classical Runge–Kutta scheme: fourth order, four evaluations a step.
    Rk4,
}

impl Default for PlantSection {
    fn default() -> Self {
        Self {
            integrator: Integrator::SemiImplicitEuler,
            substeps: 1,
            viscous_friction_n_m_s: [0.0; 6],
            coulomb_friction_n_m: [0.0; 6],
            torque_limit_n_m: None,
            contact_force_n: 0.0,
        }
    }
}
