//! The `[limits]` section: what joints and tip must not exceed.

use serde::{Deserialize, Serialize};

/// `[limits]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LimitsSection {
    /// Joint acceleration limits \[rad/s²\]: an assumption, as the manufacturer publishes none.
    pub joint_acceleration_rad_s2: [f64; 6],
    /// Largest speed of the tip anywhere \[m/s\]: an assumption. [`Program::Certified`](crate::Program::Certified) only.
    pub tip_speed_m_s: f64,
    /// Largest acceleration of the tip anywhere \[m/s²\]: an assumption. [`Program::Certified`](crate::Program::Certified) only.
    pub tip_acceleration_m_s2: f64,
}

impl Default for LimitsSection {
    fn default() -> Self {
        Self {
            joint_acceleration_rad_s2: [4.0, 4.0, 4.0, 5.0, 5.0, 6.0],
            tip_speed_m_s: 1.0,
            tip_acceleration_m_s2: 8.0,
        }
    }
}
