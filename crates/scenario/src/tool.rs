//! The `[tool]` section.

use platewash_workcell::tool::StraightTool;
use platewash_workcell::tool_chain::Handle;
use serde::{Deserialize, Serialize};

/// Stiffness of a sponge where contact is promised and none is stated \[kPa\]: an assumption, after the firmness of upholstery foams
/// (20 to 80 lbf on 50 in² at a quarter of the height).
pub const ASSUMED_STIFFNESS_KPA: [f64; 2] = [11.0, 44.0];

/// `[tool]`: a straight handle with a sponge at its end, mounted anywhere on the flange. Further bodies are
/// [`ToolBodySection`](crate::ToolBodySection)s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ToolSection {
    /// From the flange to the sponge's far face as it is pressed while it washes \[m\]; 0 for no tool body.
    pub length_m: f64,
    /// Radius of the handle \[m\].
    pub radius_m: f64,
    /// What is between flange and sponge.
    pub handle: HandleName,
    /// The link behind joint 6 that carries it, which it leaves along the link's z axis; without it, `tool0`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mounted_on: Option<String>,
    /// Where it begins, mounting frame \[m\].
    pub mount_m: [f64; 3],
    /// How it is turned there: roll, pitch and yaw about the mounting frame's axes x, y, z \[deg\].
    pub mount_rpy_deg: [f64; 3],
    /// Radius of the sponge \[m\]; also decides coverage.
    pub sponge_radius_m: f64,
    /// Height of the sponge while it washes \[m\]: the handle ends that far above the contact.
    pub sponge_height_m: f64,
    /// How far the sponge is pressed in while it washes \[m\], so much higher it is while nothing presses it: the tip may lift as far and
    /// still touch. An assumption.
    pub sponge_compression_m: f64,
    /// Least and greatest stiffness of the sponge, pressure over strain \[kPa\]: an assumption; without it, [`ASSUMED_STIFFNESS_KPA`]
    /// where contact is promised, otherwise unknown.
    pub sponge_stiffness_kpa: Option<[f64; 2]>,
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

/// What a tool is held by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandleName {
    /// A round handle.
    Round,
    /// Nothing but further bodies.
    None,
}

impl From<HandleName> for Handle {
    fn from(name: HandleName) -> Self {
        match name {
            HandleName::Round => Self::Round,
            HandleName::None => Self::None,
        }
    }
}

impl ToolSection {
    /// The tool in its own frame, further bodies apart.
    #[must_use]
    pub fn straight(&self) -> StraightTool {
        StraightTool {
            length_m: self.length_m,
            radius_m: self.radius_m,
            sponge_radius_m: self.sponge_radius_m,
            sponge_height_m: self.sponge_height_m,
            sponge_compression_m: self.sponge_compression_m,
            sponge_stiffness_pa: self.sponge_stiffness_kpa.map(|range| range.map(|kpa| 1e3 * kpa)),
            mass_kg: self.mass_kg,
            com_m: self.com_m,
            inertia_kg_m2: self.inertia_kg_m2,
        }
    }
}

impl Default for ToolSection {
    fn default() -> Self {
        let StraightTool {
            length_m,
            radius_m,
            sponge_radius_m,
            sponge_height_m,
            sponge_compression_m,
            sponge_stiffness_pa: _,
            mass_kg,
            com_m,
            inertia_kg_m2,
        } = StraightTool::default();
        Self {
            length_m,
            radius_m,
            handle: HandleName::Round,
            mounted_on: None,
            mount_m: [0.0; 3],
            mount_rpy_deg: [0.0; 3],
            sponge_radius_m,
            sponge_height_m,
            sponge_compression_m,
            sponge_stiffness_kpa: None,
            mass_kg,
            com_m,
            inertia_kg_m2,
        }
    }
}
