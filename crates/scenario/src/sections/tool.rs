//! The `[tool]` section.
//!
//! The `[[tool_body]]` sections: bodies of the tool besides its handle and its sponge.

use crate::error::{Problem, conflict};
use crate::keys::key::Domain::{Number, Text, Triple, Word};
use crate::keys::key::{Key, key};
use crate::sections::body_shape::{StatedShape, pose, with_shape_keys};
use platewash_bodies::tool_chain::{ChainBody, ToolError};
use platewash_keys::Section;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::tool::StraightTool;
use serde::{Deserialize, Serialize};

/// Stiffness of a sponge where contact is promised and none is stated \[kPa\]: an assumption, after the firmness of upholstery foams
/// (20 to 80 lbf on 50 in² at a quarter of the height).
pub const ASSUMED_STIFFNESS_KPA: [f64; 2] = [11.0, 44.0];

/// `[tool]`: a straight handle with a sponge at its end, mounted anywhere on the flange. Further bodies are
/// [`ToolBodySection`](crate::ToolBodySection)s.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("tool")]
#[serde(default, deny_unknown_fields)]
pub struct ToolSection {
    /// From the flange, along its normal, to the sponge's far face as it is pressed while it washes: the free sponge is longer by
    /// sponge_compression_m. 0 means no tool body; above 0 in a certified job. From mount_m on where the tool is mounted elsewhere.
    #[key(unit = "m", domain = Number(0.0, 2.0), default = StraightTool::default().length_m)]
    pub length_m: f64,
    /// Radius of the handle.
    #[key(unit = "m", domain = NumberAbove(0.0, 1.0), default = StraightTool::default().radius_m)]
    pub radius_m: f64,
    /// Body between flange and sponge: a round handle, or nothing but the bodies of `[[tool_body]]`.
    #[key(domain = Word(&["round", "none"]), default = HandleName::Round)]
    pub handle: HandleName,
    /// Link behind joint 6 that carries the tool, which leaves it along the link's z axis, or along another as in "flange:x", turned by
    /// mount_rpy_deg. Without it, `tool0`, or what the description tells by names, axis 6 and shapes: `platewash robot` shows it.
    #[key(domain = Text)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mounted_on: Option<String>,
    /// Origin of the tool in the mounting frame of the flange: handle, sponge, tip, centre of mass and inertia follow it.
    #[key(unit = "m", domain = Triple(-1.0, 1.0))]
    pub mount_m: [f64; 3],
    /// Orientation of the tool: roll, pitch and yaw about the fixed axes x, y, z of the mounting frame. Unturned, it leaves the flange
    /// along its normal.
    #[key(unit = "deg", domain = Triple(-360.0, 360.0))]
    pub mount_rpy_deg: [f64; 3],
    /// Radius of the sponge; decides coverage, also where there is no tool body.
    #[key(unit = "m", domain = NumberAbove(0.0, 1.0), default = StraightTool::default().sponge_radius_m)]
    pub sponge_radius_m: f64,
    /// Height of the sponge while it washes: the handle ends so far above the contact. With a tool body, below its length.
    #[key(unit = "m", domain = NumberAbove(0.0, 1.0), default = StraightTool::default().sponge_height_m)]
    pub sponge_height_m: f64,
    /// Compression of the sponge while it washes, by which it is higher while nothing presses it: the tip may lift as far and still
    /// touch. An assumption.
    #[key(unit = "m", domain = Number(0.0, 1.0), default = StraightTool::default().sponge_compression_m)]
    pub sponge_compression_m: f64,
    /// Least and greatest stiffness of the sponge, pressure over strain: an assumption. Without it, [11, 44] where wash.contact is true,
    /// otherwise unknown.
    #[key(unit = "kPa", domain = Range(1e-3, 1e6))]
    pub sponge_stiffness_kpa: Option<[f64; 2]>,
    /// Mass of the tool, all its bodies together (none where length_m is 0): an assumption.
    #[key(unit = "kg", domain = Number(0.0, 1e4), default = StraightTool::default().mass_kg)]
    pub mass_kg: f64,
    /// Distance of the tool's centre of mass from where it begins, along its axis; without it, half its length, or what its bodies come to.
    #[key(unit = "m", domain = Number(-10.0, 10.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub com_m: Option<f64>,
    /// Inertia of the tool about its centre of mass: ixx, ixy, ixz, iyy, iyz, izz, z along the tool; without it, that of a uniform cylinder,
    /// or of its bodies.
    #[key(unit = "kg·m²", domain = Joints(-1e4, 1e4))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 6]>,
}

/// Kind of the tool's handle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HandleName {
    /// A round handle.
    Round,
    /// Nothing but further bodies.
    None,
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
    /// Frame in which the body is placed.
    pub frame: BodyFrame,
    /// Position of the body's centre in that frame \[m\].
    pub at_m: [f64; 3],
    /// Orientation in that frame: roll, pitch and yaw about the fixed axes x, y, z of the frame \[deg\].
    pub rpy_deg: [f64; 3],
    /// Its part of the tool's mass \[kg\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mass_kg: Option<f64>,
}

/// The frame in which a body is placed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BodyFrame {
    /// The tool's frame: its origin is where the tool begins, its z axis runs along the handle.
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

/// Keys of scenarios that cause an error of the tool's bodies.
pub(crate) fn tool_keys(error: &ToolError) -> &'static str {
    match error {
        ToolError::Bare => "tool.handle, [[tool_body]]",
        ToolError::SameName { .. } | ToolError::OfLink { .. } => "tool_body.name",
        ToolError::Heavier { .. } | ToolError::Lighter { .. } => "tool.mass_kg, tool_body.mass_kg",
        ToolError::InSponge { .. } => "tool_body.at_m, tool.length_m, tool.sponge_height_m",
        _ => "tool_body",
    }
}
