//! The `[robot]` section: the arm, its home and its mount.

use crate::lossy_path::{lossy_all, serialize_lossy};
use crate::sections::body_shape::pose;
use platewash_keys::Section;
use platewash_kinematics::urdf::FixedJoints;
use platewash_kinematics::{Pose, RobotModel, ToolFrame};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `[robot]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("robot")]
#[serde(default, deny_unknown_fields)]
pub struct RobotSection {
    /// Built-in arm.
    #[key(domain = Word(&["irb120"]), default = BuiltInArm::Irb120)]
    pub model: BuiltInArm,
    /// Expanded URDF of another six-axis arm, in place of the built-in one; relative to the scenario's folder.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub urdf: Option<PathBuf>,
    /// SRDF whose `disable_collisions` elements name the link pairs that need no check. Without it: adjacent pairs and pairs that always
    /// touch.
    #[key(domain = Path)]
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "serialize_lossy")]
    pub srdf: Option<PathBuf>,
    /// Folders in which `package://` mesh names are looked up.
    #[key(domain = Paths)]
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "lossy_all")]
    pub package_path: Vec<PathBuf>,
    /// Take the visuals of links without collision shapes as such, meshes as convex hulls; without it, no clearance of such links is checked.
    #[key(domain = Bool)]
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub visual_shapes: bool,
    /// Links of which each mesh counts as convex parts that enclose it, at most 12, not as its convex hull: for links whose hulls touch
    /// although they do not.
    #[key(domain = Names)]
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub split_links: Vec<String>,
    /// Joints of the description that are not of the arm, such as those of a gripper or a rail, and the positions at which they are held
    /// still; what follows them (`mimic`) stands where they bring it.
    #[key(unit = "rad or m", domain = Positions(-1000.0, 1000.0))]
    #[serde(skip_serializing_if = "FixedJoints::is_empty")]
    pub fixed: FixedJoints,
    /// Frame in which tool poses are stated and returned; nothing else changes.
    #[key(domain = Word(&["flange", "tool0", "matlab_tool0"]), default = ToolFrame::Tool0)]
    pub tool_frame: ToolFrame,
    /// Joint positions at the start, within the arm's limits; without it, a clear home that is looked for (certified), or 0 (paper).
    #[key(unit = "deg", domain = Joints(-36000.0, 36000.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg: Option<[f64; 6]>,
    /// Joint positions at the end, within the arm's limits; without it, those at the start (certified).
    #[key(unit = "deg", domain = Joints(-36000.0, 36000.0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub home_deg: Option<[f64; 6]>,
    /// Position of the arm's base in the world, whose z = 0 is the floor and whose z points up: 0.4 above it on a pedestal of that height.
    /// mount_link says which link that is.
    #[key(unit = "m", domain = Triple(-10.0, 10.0))]
    pub mount_m: [f64; 3],
    /// Orientation of the base: roll, pitch and yaw about the fixed axes x, y, z of the world; [180, 0, 0] hangs from a ceiling.
    #[key(unit = "deg", domain = Triple(-360.0, 360.0))]
    pub mount_rpy_deg: [f64; 3],
    /// Link that stands at mount_m: the root link of the arm's description, or its link `base`, from which the controller counts
    /// (REP-199). To be stated with a mount where these two frames differ; without a mount the root link stands at the world's origin.
    #[key(domain = Word(&["root", "base"]))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mount_link: Option<OriginLink>,
    /// Rated payload, against which the tool's mass is checked; without it, 3 kg for the built-in arm, unknown for others.
    #[key(unit = "kg", domain = NumberAbove(0.0, 1e6))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub payload_kg: Option<f64>,
}

/// `[[reduced_clearance]]`: two bodies of arm and tool that keep less clearance than all others, as those that are near each other in every
/// configuration. The clearance is proved and reported on its own (certified).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("reduced_clearance")]
#[serde(default, deny_unknown_fields)]
pub struct ReducedClearanceSection {
    /// Name of the first body: a link, "handle", "sponge" or a body of the tool.
    #[key(domain = Text)]
    pub a: String,
    /// Name of the second body.
    #[key(domain = Text)]
    pub b: String,
    /// Clearance of the two: above 0 and below wash.clearance_m.
    #[key(unit = "m", domain = NumberAbove(0.0, 1.0))]
    pub clearance_m: f64,
}

/// Arms that are built in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BuiltInArm {
    /// ABB IRB 120.
    Irb120,
}

/// Links from which places are counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum OriginLink {
    /// The root link of the arm's description.
    Root,
    /// The link from which the controller counts: `base`, or `base_link` where there is none.
    Base,
}

impl OriginLink {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Root, Self::Base];

    /// Its name in a file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Root => "root",
            Self::Base => "base",
        }
    }
}

impl RobotSection {
    /// Pose in the world of the link that `mount_link` names, of the root link where it names none.
    #[must_use]
    pub fn stated_mount(&self) -> Pose {
        pose(self.mount_m, self.mount_rpy_deg)
    }

    /// `T_world_root` of an arm.
    #[must_use]
    pub fn mount(&self, arm: &RobotModel) -> Pose {
        match arm.controller_base() {
            Some(base) if self.mount_link == Some(OriginLink::Base) => self.stated_mount() * base.pose.inverse(),
            _ => self.stated_mount(),
        }
    }
}
