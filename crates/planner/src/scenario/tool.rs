//! The `[tool]` section.

use serde::{Deserialize, Serialize};

/// `[tool]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ToolSection {
    /// From the flange to the sponge's far face \[m\]; 0 for no tool body.
    pub length_m: f64,
    /// Radius of the handle \[m\].
    pub radius_m: f64,
    /// Radius of the sponge \[m\]; also decides coverage.
    pub sponge_radius_m: f64,
    /// Height of the sponge \[m\].
    pub sponge_height_m: f64,
    /// How far the sponge is pressed in while it washes \[m\]: the tip may lift as far and still touch. An assumption.
    pub sponge_compression_m: f64,
    /// Mass of the tool body \[kg\]: an assumption.
    pub mass_kg: f64,
    /// Distance of its centre of mass from the flange along its axis \[m\]; without it, half its length.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub com_m: Option<f64>,
    /// Its inertia about the centre of mass, ixx, ixy, ixz, iyy, iyz, izz with z along it \[kg·m²\]; without it, that of a
    /// uniform cylinder.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 6]>,
}

impl Default for ToolSection {
    fn default() -> Self {
        Self {
            length_m: 0.0,
            radius_m: 0.02,
            sponge_radius_m: 0.025,
            sponge_height_m: 0.025,
            sponge_compression_m: 0.005,
            mass_kg: 0.3,
            com_m: None,
            inertia_kg_m2: None,
        }
    }
}
