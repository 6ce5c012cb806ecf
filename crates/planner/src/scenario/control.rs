//! The `[control]` section.

use serde::{Deserialize, Serialize};

/// The least and the greatest time step \[s\], of waypoints and of tables.
pub const TIME_STEPS_S: [f64; 2] = [1e-6, 10.0];

/// `[control]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ControlSection {
    /// The law; see [`Scenario::law`](super::Scenario::law) where none is stated.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<ControlLawName>,
    /// Proportional gain of the paper's law \[1/s\].
    pub kp: f64,
    /// Derivative gain of the paper's law.
    pub kd: f64,
    /// Time between waypoints \[s\].
    pub dt_s: f64,
    /// Samples of a torque law \[Hz\].
    pub rate_hz: f64,
    /// Natural frequency from which the gains of a torque law follow \[rad/s\].
    pub frequency_rad_s: f64,
    /// Damping ratio from which they follow.
    pub damping_ratio: f64,
    /// Proportional gains of a torque law in place of those \[N·m/rad; 1/s² for computed torque\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_kp: Option<[f64; 6]>,
    /// Derivative gains of a torque law in place of those \[N·m·s/rad; 1/s for computed torque\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_kd: Option<[f64; 6]>,
    /// What a torque law takes from the commanded motion besides its positions.
    pub feed_forward: FeedForward,
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
    /// The same and the torque that holds the arm against gravity.
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

    /// The law of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.name() == name)
    }

    /// The word used in files.
    #[must_use]
    pub fn name(self) -> &'static str {
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

impl Default for ControlSection {
    fn default() -> Self {
        Self {
            law: None,
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
