//! The `[wash]` section: the wash path and what it must keep.

use serde::{Deserialize, Serialize};

/// `[wash]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WashSection {
    /// Waypoints of the spiral.
    pub points: usize,
    /// Turns of the spiral.
    pub turns: f64,
    /// Outer radius of the spiral \[m\].
    pub path_radius_m: f64,
    /// Height of the tip above the washing surface \[m\].
    pub height_m: f64,
    /// Whether a full circle at the outer radius follows the spiral.
    pub closing_ring: bool,
    /// Least clearance that counts as free \[m\].
    pub clearance_m: f64,
    /// Largest angle of the tool from the plate's normal \[deg\]. This key and those below: [`Program::Certified`](crate::Program::Certified) only.
    pub tilt_max_deg: f64,
    /// Largest speed of the tip along the path \[m/s\].
    pub speed_m_s: f64,
    /// Largest acceleration of the tip on the path \[m/s²\].
    pub acceleration_m_s2: f64,
    /// How far the tip approaches and retreats along the plate's normal \[m\].
    pub lift_m: f64,
}

impl Default for WashSection {
    fn default() -> Self {
        Self {
            points: 55,
            turns: 3.0,
            path_radius_m: 0.145,
            height_m: 0.05,
            closing_ring: false,
            clearance_m: 0.0,
            tilt_max_deg: 15.0,
            speed_m_s: 0.25,
            acceleration_m_s2: 4.0,
            lift_m: 0.03,
        }
    }
}
