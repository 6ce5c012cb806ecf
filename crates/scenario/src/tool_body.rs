//! The `[[tool_body]]` sections: what the tool has besides its handle and its sponge.

use crate::body_shape::{BodyShape, convex};
use crate::error::{Problem, conflict};
use crate::key::Domain::{Number, NumberAbove, Text, Triple, TripleAbove, Word};
use crate::key::{Key, key};
use crate::poses::pose;
use platewash_kinematics::Pose;
use platewash_workcell::tool_chain::{ChainBody, ToolError};
use serde::{Deserialize, Serialize};

/// The keys of `[[tool_body]]`.
pub(crate) const TOOL_BODY_KEYS: &[Key] = &[
    key(
        "tool_body.name",
        "",
        Text,
        "Its name, in messages: no other body has it.",
    ),
    key(
        "tool_body.shape",
        "",
        Word(&["box", "cylinder", "capsule", "sphere"]),
        "Its shape: a box with its size_m, a sphere with its radius_m, a cylinder or a capsule along its own z with radius_m and length_m.",
    ),
    key("tool_body.size_m", "m", TripleAbove(0.0, 2.0), "Edges of a box."),
    key(
        "tool_body.radius_m",
        "m",
        NumberAbove(0.0, 1.0),
        "Radius of a cylinder, a capsule or a sphere.",
    ),
    key(
        "tool_body.length_m",
        "m",
        NumberAbove(0.0, 2.0),
        "Length of a cylinder; of a capsule, that between the centres of its round ends.",
    ),
    key(
        "tool_body.frame",
        "",
        Word(&["tool", "flange"]),
        "In which frame it is placed: that of the tool, from tool.mount_m on with z along the handle, or the mounting frame of the flange.",
    ),
    key(
        "tool_body.at_m",
        "m",
        Triple(-2.0, 2.0),
        "Where its centre is, in its frame.",
    ),
    key(
        "tool_body.rpy_deg",
        "deg",
        Triple(-360.0, 360.0),
        "How it is turned there: roll, pitch and yaw about the fixed axes x, y, z of its frame.",
    ),
    key(
        "tool_body.mass_kg",
        "kg",
        Number(0.0, 1e4),
        "Its part of tool.mass_kg; without it, its share by volume of what the others leave.",
    ),
];

/// `[[tool_body]]`: a convex body of the tool.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ToolBodySection {
    /// Its name.
    pub name: String,
    /// Its shape.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<BodyShape>,
    /// Edges of a box \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 3]>,
    /// Radius of a cylinder, a capsule or a sphere \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Length of a cylinder, and of the straight part of a capsule \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// In which frame it is placed.
    pub frame: BodyFrame,
    /// Where its centre is, in that frame \[m\].
    pub at_m: [f64; 3],
    /// How it is turned there: roll, pitch and yaw about the frame's axes x, y, z \[deg\].
    pub rpy_deg: [f64; 3],
    /// Its part of the tool's mass \[kg\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
}

/// The frame in which a body is placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BodyFrame {
    /// That of the tool: where it begins, z along the handle.
    #[default]
    Tool,
    /// The mounting frame of the flange.
    Flange,
}

impl ToolBodySection {
    /// The body at `T_tool_body`, of a tool at `T_flange_tool`.
    pub(crate) fn body(&self, index: usize, mount: &Pose) -> Result<ChainBody, Problem> {
        let at = format!("tool_body[{index}]");
        if self.name.is_empty() {
            conflict(format!("{at}.name"), "is missing; every body has a name of its own")?;
        }
        if self.name == "floor" || self.name.starts_with("plate ") {
            let detail = format!("{:?} is the name of something else in the cell", self.name);
            conflict(format!("{at}.name"), detail)?;
        }
        Ok(ChainBody {
            name: self.name.clone(),
            shape: convex(&at, self.shape, self.size_m, self.radius_m, self.length_m)?,
            pose: match self.frame {
                BodyFrame::Tool => pose(self.at_m, self.rpy_deg),
                BodyFrame::Flange => mount.inverse() * pose(self.at_m, self.rpy_deg),
            },
            mass_kg: self.mass_kg,
        })
    }
}

/// The keys that decide why bodies make no tool.
pub(crate) fn tool_keys(error: &ToolError) -> &'static str {
    match error {
        ToolError::Bare => "tool.handle, [[tool_body]]",
        ToolError::SameName { .. } | ToolError::OfLink { .. } => "tool_body.name",
        ToolError::Heavier { .. } | ToolError::Lighter { .. } => "tool.mass_kg, tool_body.mass_kg",
        ToolError::InSponge { .. } => "tool_body.at_m, tool.length_m, tool.sponge_height_m",
        _ => "tool_body",
    }
}
