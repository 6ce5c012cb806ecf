//! Load on what holds a plate, as the certificate states it.

use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Upper bounds of the load on what holds a plate, from approach to retreat: for every plate height within the stated error and every sponge
/// stiffness in the stated range.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[ts(optional_fields)]
pub struct HolderLoad {
    /// Friction coefficients of the sponge on the plate, least and greatest: assumptions. The loads below are for each of both.
    pub sponge_friction: [f64; 2],
    /// Force of the sponge across the plate's axis \[N\].
    pub lateral_n: [f64; 2],
    /// Torque of the sponge about the plate's axis \[N·m\].
    pub torque_nm: [f64; 2],
    /// Weight of the plate, along its axis and across it \[N\]; `None` where the job states no mass. It is no part of the force above.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight_n: Option<[f64; 2]>,
    /// Bounds of a plate that stands on a ring, for the greatest friction of the sponge.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ring: Option<RingShares>,
}

/// Upper bounds of what a ring bears, as shares of what it can. Each is `None` where nothing is proved.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, TS)]
#[ts(optional_fields)]
pub struct RingShares {
    /// Distance from the axis of the centre of what presses the plate down, over the ring's radius. At 1 the plate may tip.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tipping: Option<f64>,
    /// Force across the axis over the greatest friction: above 1 the plate may slide.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sliding: Option<f64>,
    /// Needed friction over the greatest one, of that force and the torque together: above 1 the plate may turn or slide.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
}

impl RingShares {
    /// Returns what the plate may do; `None` if it stays.
    pub fn fault(&self) -> Option<&'static str> {
        let is_below = |share: Option<f64>| share.is_some_and(|share| share <= 1.0);
        match self {
            _ if !self.tipping.is_some_and(|share| share < 1.0) => Some("it may tip"),
            _ if !is_below(self.sliding) => Some("it may slide"),
            _ if !is_below(self.friction) => Some("it may turn"),
            _ => None,
        }
    }
}
