//! The `[[tool_body]]` sections: what the tool has besides its handle and its sponge.

use crate::body_shape::{StatedShape, with_shape_keys};
use crate::error::{Problem, conflict};
use crate::key::Domain::{Number, Text, Triple, Word};
use crate::key::{Key, key};
use crate::poses::pose;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::tool_chain::{ChainBody, ToolError};
use serde::{Deserialize, Serialize};

/// The keys of `[[tool_body]]`.
pub(crate) const TOOL_BODY_KEYS: &[Key] = with_shape_keys!(
    "tool_body",
    [key(
        "tool_body.name",
        "",
        Text,
        "Its name, in messages: no other body has it.",
    ),],
    &["box", "cylinder", "capsule", "sphere", "mesh"],
    "Its shape: a box with its size_m, a sphere with its radius_m, a cylinder or a capsule along its own z with radius_m and length_m, or the \
     convex hull of a mesh out of a file.",
    [2.0, 1.0],
    [],
    [
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
            "Where its centre is, in its frame; of a mesh, the origin of its file.",
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
            "Its part of tool.mass_kg, spread evenly over its volume; without it, its share by volume of what the others leave.",
        ),
    ]
);

/// `[[tool_body]]`: a convex body of the tool.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ToolBodySection {
    /// Its name.
    pub name: String,
    /// Its shape.
    #[serde(flatten)]
    pub body: StatedShape,
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
    /// Refuses names that something else in the cell has.
    pub(crate) fn check_name(&self, at: &str) -> Result<(), Problem> {
        if self.name.is_empty() {
            conflict(format!("{at}.name"), "is missing; every body has a name of its own")?;
        }
        if self.name == "floor" || self.name.starts_with("plate ") {
            let detail = format!("{:?} is the name of something else in the cell", self.name);
            conflict(format!("{at}.name"), detail)?;
        }
        Ok(())
    }

    /// The body of a shape at `T_tool_body`, of a tool at `T_flange_tool`.
    pub(crate) fn body(&self, shape: Shape, mount: &Pose) -> ChainBody {
        ChainBody {
            name: self.name.clone(),
            shape,
            pose: match self.frame {
                BodyFrame::Tool => pose(self.at_m, self.rpy_deg),
                BodyFrame::Flange => mount.inverse() * pose(self.at_m, self.rpy_deg),
            },
            mass_kg: self.mass_kg,
        }
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
