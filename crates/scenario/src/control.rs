//! The `[control]` section.

use platewash_keys::Section;
use platewash_workcell::simulation::{ControlLawName, ControlSettings, FeedForward};
use serde::{Deserialize, Serialize};

/// The least and the greatest time step \[s\], of waypoints and of tables.
pub const TIME_STEPS_S: [f64; 2] = [1e-6, 10.0];

/// `[control]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("control")]
#[serde(default, deny_unknown_fields)]
pub struct ControlSection {
    /// How the arm follows: the paper's law or exactly, without a plant; or a law that gives torques (certified). Without it, "paper" for the
    /// paper's program, "computed_torque" for a certified job.
    #[key(domain = Word(&ControlLawName::NAMES))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub law: Option<ControlLawName>,
    /// Proportional gain of the paper's law.
    #[key(unit = "1/s", domain = Number(0.0, 1e6), default = ControlSettings::default().kp)]
    pub kp: f64,
    /// Derivative gain of the paper's law.
    #[key(domain = Number(0.0, 1e6), default = ControlSettings::default().kd)]
    pub kd: f64,
    /// Time between waypoints.
    #[key(unit = "s", domain = Number(TIME_STEPS_S[0], TIME_STEPS_S[1]), default = ControlSettings::default().dt_s)]
    pub dt_s: f64,
    /// Samples of a torque law; its torque is held between them.
    #[key(unit = "Hz", domain = Number(1.0, 1e5), default = ControlSettings::default().rate_hz)]
    pub rate_hz: f64,
    /// Natural frequency ω of a torque law: kp = M ω², M each joint's largest inertia, or 1 for computed torque.
    #[key(unit = "rad/s", domain = NumberAbove(0.0, 1e5), default = ControlSettings::default().frequency_rad_s)]
    pub frequency_rad_s: f64,
    /// Damping ratio ζ of a torque law: kd = 2 ζ ω M.
    #[key(domain = Number(0.0, 100.0), default = ControlSettings::default().damping_ratio)]
    pub damping_ratio: f64,
    /// Proportional gains of a torque law in place of those; in 1/s² for computed torque.
    #[key(unit = "N·m/rad", domain = Joints(0.0, 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_kp: Option<[f64; 6]>,
    /// Derivative gains of a torque law in place of those; in 1/s for computed torque.
    #[key(unit = "N·m·s/rad", domain = Joints(0.0, 1e9))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint_kd: Option<[f64; 6]>,
    /// What a torque law takes from the commanded motion besides positions; computed torque takes accelerations with speeds.
    #[key(domain = Word(&["none", "velocity"]), default = ControlSettings::default().feed_forward)]
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
