//! The `[robot]` section: which arm, and where it starts and ends.

use crate::paths;
use crate::poses::pose;
use platewash_kinematics::{Pose, ToolFrame};
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// `[robot]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RobotSection {
    /// An arm that is built in.
    pub model: BuiltInArm,
    /// A description that replaces it.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "paths::lossy")]
    pub urdf: Option<PathBuf>,
    /// Its list of link pairs that need no check.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "paths::lossy")]
    pub srdf: Option<PathBuf>,
    /// Folders in which `package://` names are looked up.
    #[serde(skip_serializing_if = "Vec::is_empty", serialize_with = "paths::lossy_all")]
    pub package_path: Vec<PathBuf>,
    /// The frame in which tool poses are stated and returned.
    pub tool_frame: ToolFrame,
    /// Joint positions at the start \[deg\]; without them, a home that is found for a certified job, and 0 for the paper's program.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_deg: Option<[f64; 6]>,
    /// Joint positions at the end \[deg\]; by default those at the start. [`Program::Certified`](crate::Program::Certified) only.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub home_deg: Option<[f64; 6]>,
    /// Where the arm is mounted, world frame \[m\].
    pub mount_m: [f64; 3],
    /// How it is turned there: roll, pitch and yaw about the world's axes x, y, z \[deg\].
    pub mount_rpy_deg: [f64; 3],
    /// Rated payload \[kg\]; without it, that of the built-in arm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub payload_kg: Option<f64>,
}

/// Arms that are built in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum BuiltInArm {
    /// ABB IRB 120.
    Irb120,
}

impl Default for RobotSection {
    fn default() -> Self {
        Self {
            model: BuiltInArm::Irb120,
            urdf: None,
            srdf: None,
            package_path: Vec::new(),
            tool_frame: ToolFrame::Tool0,
            start_deg: None,
            home_deg: None,
            mount_m: [0.0; 3],
            mount_rpy_deg: [0.0; 3],
            payload_kg: None,
        }
    }
}

impl RobotSection {
    /// `T_world_base`.
    #[must_use]
    pub fn mount(&self) -> Pose {
        pose(self.mount_m, self.mount_rpy_deg)
    }
}
