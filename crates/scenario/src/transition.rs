//! The `[transition]` section: transits of the paper's program, and the arc of all.

use platewash_keys::Section;
use platewash_paper::cubic::Interpolation;
use serde::{Deserialize, Serialize};

/// `[transition]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("transition")]
#[serde(default, deny_unknown_fields)]
pub struct TransitionSection {
    /// Curve between plates: cubics at rest at every waypoint (the paper), or one spline with continuous acceleration.
    #[key(domain = Word(&["zero_velocity", "c2_spline"]), default = Interpolation::C2Spline)]
    pub interpolation: Interpolation,
    /// Samples along the curve, both ends included.
    #[key(domain = Integer(2, 100_000), default = 50)]
    pub samples: usize,
    /// Waypoints of the arc round the base, both ends included.
    #[key(domain = Integer(2, 1000), default = 5)]
    pub mid_points: usize,
    /// Radius of the arc; without it, max(layout.base_radius_m + 0.1, 0.3).
    #[key(unit = "m", domain = NumberAbove(0.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mid_radius_m: Option<f64>,
    /// z of the arc.
    #[key(unit = "m", domain = Number(-10.0, 10.0), default = 0.25)]
    pub mid_height_m: f64,
}
