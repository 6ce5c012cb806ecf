//! The `[transition]` section: transits of the paper's program, and the arc of all.

use platewash_paper::cubic::Interpolation;
use serde::{Deserialize, Serialize};

/// `[transition]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TransitionSection {
    /// Curve through the waypoints.
    pub interpolation: Interpolation,
    /// Samples along the curve.
    pub samples: usize,
    /// Waypoints of the arc round the base, both ends included.
    pub mid_points: usize,
    /// Radius of the arc \[m\]; by default max(`layout.base_radius_m` + 0.1, 0.3).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mid_radius_m: Option<f64>,
    /// z of the arc \[m\].
    pub mid_height_m: f64,
}

impl Default for TransitionSection {
    fn default() -> Self {
        Self {
            interpolation: Interpolation::C2Spline,
            samples: 50,
            mid_points: 5,
            mid_radius_m: None,
            mid_height_m: 0.25,
        }
    }
}
