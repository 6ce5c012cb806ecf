//! Swept share of a plate and reach beyond its rim, as the certificate states them.

use serde::{Deserialize, Serialize};

/// The swept share of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlateCoverage {
    /// Index of the plate.
    pub plate: usize,
    /// Proved lower bound of the swept share. It is that of the pressed share where that reaches the required one.
    pub at_least: f64,
    /// Proved upper bound of the swept share; `None` where it was not needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
    /// Proved lower bound of cos τ while washing.
    pub cos_tilt: f64,
    /// Upper bound on the reach of the sponge beyond the rim, at the height of the plate's face, while it comes down, washes and leaves
    /// \[m\]; negative where it stays within the rim, `None` where nothing is proved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_rim_m: Option<f64>,
    /// Reach beyond the rim of a sponge with the same tilt at the tip positions that were computed \[m\].
    pub beyond_rim_seen_m: f64,
    /// Reach beyond the rim that the wash path allows \[m\].
    pub beyond_rim_allowed_m: f64,
    /// Neighbouring plates that the sponge may touch there.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub touches: Vec<ReachedNeighbour>,
}

/// Neighbouring plate that the sponge reaches while it works on another plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReachedNeighbour {
    /// Index of the neighbouring plate.
    pub plate: usize,
    /// Upper bound on the reach over its rim \[m\].
    pub depth_m: f64,
}
