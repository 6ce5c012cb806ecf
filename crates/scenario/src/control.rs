//! The `[control]` section.

use platewash_workcell::simulation::{ControlLawName, ControlSettings, FeedForward};
use serde::{Deserialize, Serialize};

/// The least and the greatest time step \[s\], of waypoints and of tables.
pub const TIME_STEPS_S: [f64; 2] = [1e-6, 10.0];

/// `[control]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ControlSection {
    /// The law; see [`Scenario::law`](crate::Scenario::law) where none is stated.
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

impl ControlSection {
    /// The gains and the sampling.
    #[must_use]
    pub fn settings(&self) -> ControlSettings {
        ControlSettings {
            kp: self.kp,
            kd: self.kd,
            dt_s: self.dt_s,
            rate_hz: self.rate_hz,
            frequency_rad_s: self.frequency_rad_s,
            damping_ratio: self.damping_ratio,
            joint_kp: self.joint_kp,
            joint_kd: self.joint_kd,
            feed_forward: self.feed_forward,
        }
    }
}

impl Default for ControlSection {
    fn default() -> Self {
        let ControlSettings {
            kp,
            kd,
            dt_s,
            rate_hz,
            frequency_rad_s,
            damping_ratio,
            joint_kp,
            joint_kd,
            feed_forward,
        } = ControlSettings::default();
        Self {
            law: None,
            kp,
            kd,
            dt_s,
            rate_hz,
            frequency_rad_s,
            damping_ratio,
            joint_kp,
            joint_kd,
            feed_forward,
        }
    }
}
