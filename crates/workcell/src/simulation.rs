//! Settings of a simulation of a plan: control law, gains, sampling, plant. A plan carries and hashes them; no proof depends on them.

use crate::tool::Sponge;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Control law, gains and plant of a simulation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SimulationSettings {
    /// Control law.
    pub law: ControlLawName,
    /// Gains and sampling of the law.
    pub control: ControlSettings,
    /// The arm as a physical system; not used by kinematic laws.
    pub plant: PlantSettings,
    /// Rated payload \[kg\]; `None` for that of the built-in arm.
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

/// Control laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum ControlLawName {
    /// The paper's law, unchanged: it moves positions, without a plant.
    Paper,
    /// The commanded configuration is reached at once.
    Exact,
    /// Torque in proportion to the errors of position and speed (PD).
    Pd,
    /// PD plus the torque that holds the arm against gravity.
    PdGravity,
    /// Computed torque: the torque that the arm's model gives for the commanded acceleration, corrected by the errors.
    ComputedTorque,
}

impl ControlLawName {
    /// All laws.
    pub const ALL: [Self; 5] = [
        Self::Paper,
        Self::Exact,
        Self::Pd,
        Self::PdGravity,
        Self::ComputedTorque,
    ];

    /// Names of the laws, in the same order.
    pub const NAMES: [&str; 5] = {
        let [a, b, c, d, e] = Self::ALL;
        [a.name(), b.name(), c.name(), d.name(), e.name()]
    };

    /// Returns the law of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// Returns the name used in files.
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

    /// True if the law gives positions, without a plant, as the paper's program needs.
    #[must_use]
    pub fn is_kinematic(self) -> bool {
        matches!(self, Self::Paper | Self::Exact)
    }
}

/// Parts of the commanded motion that a torque law uses besides the positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FeedForward {
    /// None: the arm's own speed is damped.
    None,
    /// Speeds: the error of speed is damped. Computed torque also uses accelerations.
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
    /// Sampling rate of a torque law \[Hz\].
    pub rate_hz: f64,
    /// Natural frequency from which the gains of a torque law follow \[rad/s\].
    pub frequency_rad_s: f64,
    /// Damping ratio from which the gains of a torque law follow.
    pub damping_ratio: f64,
    /// Proportional gains of a torque law, instead of those that follow from frequency and damping \[N·m/rad; 1/s² for computed torque\].
    pub joint_kp: Option<[f64; 6]>,
    /// Derivative gains of a torque law, instead of those that follow from frequency and damping \[N·m·s/rad; 1/s for computed torque\].
    pub joint_kd: Option<[f64; 6]>,
    /// Parts of the commanded motion that a torque law uses besides the positions.
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

/// Dynamics of the arm, for laws that give torques. Friction, torque limits and contact are off by default: there are no published figures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlantSettings {
    /// Integration scheme of the motion.
    pub integrator: Integrator,
    /// Integration steps per sample of the law.
    pub substeps: usize,
    /// Viscous friction per joint \[N·m·s/rad\].
    pub viscous_friction_n_m_s: [f64; 6],
    /// Coulomb friction per joint \[N·m\].
    pub coulomb_friction_n_m: [f64; 6],
    /// Greatest joint torques \[N·m\]; `None` for those of the arm's description, if it has any.
    pub torque_limit_n_m: Option<[f64; 6]>,
    /// Constant force of a plate on the sponge while it washes, along the plate's normal \[N\]; 0 if [`Self::contact`] is set.
    pub contact_force_n: f64,
    /// Contact model of the sponge's foam; `None` for the constant force.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contact: Option<FoamContact>,
}

/// Contact of a sponge with plates as the elastic foundation that `platewash-bodies` computes with. Both values are assumptions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FoamContact {
    /// Simulated stiffness E, pressure over strain, within the range that the sponge states \[Pa\].
    pub stiffness_pa: f64,
    /// Damping η, pressure over the speed of strain \[Pa·s\]; 0 for none.
    pub damping_pa_s: f64,
}

impl FoamContact {
    /// Returns the contact of a sponge without damping, with the geometric mean of its least and greatest stiffness; `None` for a sponge of
    /// unknown stiffness.
    #[must_use]
    pub fn from_sponge(sponge: &Sponge) -> Option<Self> {
        let [least, most] = sponge.stiffness_pa?;
        Some(Self {
            stiffness_pa: least.sqrt() * most.sqrt(),
            damping_pa_s: 0.0,
        })
    }
}

/// Integration scheme.
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
