//! How the arm follows a plan in simulation, as numbers: law, gains, sampling, plant. A plan carries and hashes them; no proof rests
//! on them.

use crate::tool::Sponge;
use serde::{Deserialize, Serialize};

/// Law, gains and plant of a simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SimulationSettings {
    /// The law.
    pub law: ControlLawName,
    /// Its gains and sampling.
    pub control: ControlSettings,
    /// The arm as a physical system; not used by kinematic laws.
    pub plant: PlantSettings,
    /// Rated payload \[kg\]; without it, that of the built-in arm.
    pub payload_kg: Option<f64>,
}

impl SimulationSettings {
    /// Time between samples \[s\]: the time step of a kinematic law, 1 / rate of a torque law.
    #[must_use]
    pub fn period_s(&self) -> f64 {
        if self.law.is_kinematic() {
            self.control.dt_s
        } else {
            1.0 / self.control.rate_hz
        }
    }
}

/// Control laws by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ControlLawName {
    /// The paper's law, to the letter: it moves positions, there is no plant.
    Paper,
    /// The commanded configuration is taken at once.
    Exact,
    /// Torque in proportion to the errors of position and speed.
    Pd,
    /// Pd and the torque that holds the arm against gravity.
    PdGravity,
    /// The torque that the arm's own model asks for, the errors corrected as accelerations.
    ComputedTorque,
}

impl ControlLawName {
    /// All of them.
    pub const ALL: [Self; 5] = [
        Self::Paper,
        Self::Exact,
        Self::Pd,
        Self::PdGravity,
        Self::ComputedTorque,
    ];

    /// Their words, in the same order.
    pub const NAMES: [&str; 5] = {
        let [a, b, c, d, e] = Self::ALL;
        [a.name(), b.name(), c.name(), d.name(), e.name()]
    };

    /// The law of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// The word used in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Exact => "exact",
            Self::Pd => "pd",
            Self::PdGravity => "pd_gravity",
            Self::ComputedTorque => "computed_torque",
        }
    }

    /// Whether the law gives positions, without a plant, as the paper's program needs.
    #[must_use]
    pub fn is_kinematic(self) -> bool {
        matches!(self, Self::Paper | Self::Exact)
    }
}

/// What a torque law takes from the commanded motion besides its positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FeedForward {
    /// Nothing: the arm's own speed is damped.
    None,
    /// Speeds: the error of speed is damped. Computed torque also takes accelerations.
    Velocity,
}

/// Gains and sampling.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ControlSettings {
    /// Proportional gain of the paper's law \[1/s\].
    pub kp: f64,
    /// Derivative gain of the paper's law.
    pub kd: f64,
    /// Time between waypoints of a kinematic law \[s\].
    pub dt_s: f64,
    /// Samples of a torque law \[Hz\].
    pub rate_hz: f64,
    /// Natural frequency from which the gains of a torque law follow \[rad/s\].
    pub frequency_rad_s: f64,
    /// Damping ratio from which they follow.
    pub damping_ratio: f64,
    /// Proportional gains of a torque law in place of those \[N·m/rad; 1/s² for computed torque\].
    pub joint_kp: Option<[f64; 6]>,
    /// Derivative gains of a torque law in place of those \[N·m·s/rad; 1/s for computed torque\].
    pub joint_kd: Option<[f64; 6]>,
    /// What a torque law takes from the commanded motion besides its positions.
    pub feed_forward: FeedForward,
}

impl Default for ControlSettings {
    fn default() -> Self {
        Self {
            kp: 20.0,
            kd: 0.1,
            dt_s: 0.01,
            rate_hz: 1000.0,
            frequency_rad_s: 30.0,
            damping_ratio: 1.0,
            joint_kp: None,
            joint_kd: None,
            feed_forward: FeedForward::Velocity,
        }
    }
}

/// The arm as a physical system, where a law gives torques. Friction, torque limits and contact are off unless given: there
/// are no published figures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlantSettings {
    /// How the motion is integrated.
    pub integrator: Integrator,
    /// Steps of integration to a sample of the law.
    pub substeps: usize,
    /// Friction torque per joint speed \[N·m·s/rad\].
    pub viscous_friction_n_m_s: [f64; 6],
    /// Friction torque against any motion \[N·m\].
    pub coulomb_friction_n_m: [f64; 6],
    /// Largest joint torques \[N·m\]; without them, those of the arm's description where it knows any.
    pub torque_limit_n_m: Option<[f64; 6]>,
    /// A constant force of a plate on the sponge while it washes, along the plate's normal \[N\]; 0 beside [`Self::contact`].
    pub contact_force_n: f64,
    /// How plates push back where the sponge's foam meets them; without it, with the constant force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<FoamContact>,
}

/// A sponge that plates push back as the elastic foundation of [`crate::contact`]: assumptions, both.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoamContact {
    /// E: the stiffness simulated, pressure over strain, within the range that the sponge states \[Pa\].
    pub stiffness_pa: f64,
    /// η: pressure over the speed of strain \[Pa·s\]; 0 for none.
    pub damping_pa_s: f64,
}

impl FoamContact {
    /// Without damping, in the middle of what a sponge states: the geometric mean of least and greatest, as they are bounds of a factor.
    /// `None` of a sponge of unknown stiffness.
    #[must_use]
    pub fn of(sponge: &Sponge) -> Option<Self> {
        let [least, most] = sponge.stiffness_pa?;
        Some(Self {
            stiffness_pa: least.sqrt() * most.sqrt(),
            damping_pa_s: 0.0,
        })
    }
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

impl Default for PlantSettings {
    fn default() -> Self {
        Self {
            integrator: Integrator::SemiImplicitEuler,
            substeps: 1,
            viscous_friction_n_m_s: [0.0; 6],
            coulomb_friction_n_m: [0.0; 6],
            torque_limit_n_m: None,
            contact_force_n: 0.0,
            contact: None,
        }
    }
}
