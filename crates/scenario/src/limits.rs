//! The `[limits]` section: what joints and tip must not exceed.

use platewash_keys::Section;
use serde::{Deserialize, Serialize};

/// `[limits]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("limits")]
#[serde(default, deny_unknown_fields)]
pub struct LimitsSection {
    /// Joint acceleration limits, at least 0.001 in a certified job: an assumption, as the manufacturer publishes none.
    #[key(unit = "rad/s²", domain = JointsAbove(0.0, 1e6), default = [4.0, 4.0, 4.0, 5.0, 5.0, 6.0])]
    pub joint_acceleration_rad_s2: [f64; 6],
    /// Largest speed of the tip anywhere (certified), at least 0.000001: an assumption.
    #[key(unit = "m/s", domain = NumberAbove(0.0, 100.0), default = 1.0)]
    pub tip_speed_m_s: f64,
    /// Largest acceleration of the tip anywhere (certified), at least 0.000001: an assumption.
    #[key(unit = "m/s²", domain = NumberAbove(0.0, 1e4), default = 8.0)]
    pub tip_acceleration_m_s2: f64,
}
