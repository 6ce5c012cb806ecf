//! The world that an arm works in.

pub use crate::obstacle::{Obstacle, ObstacleShape};
use crate::pose;
use crate::tool::Tool;
use platewash_kinematics::{Pose, RobotModel};
use serde::{Deserialize, Serialize};

/// Bodies of the tool and obstacles, together, that a workcell has at most.
pub const MOST_BODIES: usize = 1000;

/// An arm, what it holds, where it stands and what stands around it, the plates apart.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Workcell {
    /// `T_world_base`: where the arm is mounted.
    #[serde(with = "pose")]
    pub mount: Pose,
    /// Which arm.
    pub arm: ArmId,
    /// What it holds.
    pub tool: Tool,
    /// What stands around it; the floor is one of them.
    pub obstacles: Vec<Obstacle>,
    /// Pairs of bodies that need not keep clear of each other.
    pub exclusions: Vec<Exclusion>,
}

impl Workcell {
    /// Bodies of the tool and obstacles, together.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.tool.bodies.len() + self.obstacles.len()
    }
}

/// An arm by its description.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArmId {
    /// Name in the URDF.
    pub name: String,
    /// SHA-256 of the URDF, lower-case hexadecimal.
    pub urdf_sha256: String,
    /// SHA-256 of the SRDF, where one was given.
    pub srdf_sha256: Option<String>,
}

/// Two bodies that need not keep clear of each other.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exclusion {
    /// Their names.
    pub pair: [String; 2],
    /// Why.
    pub reason: ExclusionReason,
}

/// Why two bodies need not keep clear of each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExclusionReason {
    /// The arm's SRDF disables the pair.
    Srdf,
    /// They are neighbours, of an arm without an SRDF.
    Neighbours,
    /// They touch in every configuration sampled, of an arm without an SRDF.
    AlwaysTouching,
    /// The wrist carries the tool.
    CarriesTool,
    /// Neither of them moves.
    NeitherMoves,
    /// It turns about the vertical, over the floor.
    KeepsItsHeight,
}

impl ArmId {
    /// That of an arm.
    #[must_use]
    pub fn of(robot: &RobotModel) -> Self {
        Self {
            name: robot.name().to_owned(),
            urdf_sha256: robot.sha256().to_owned(),
            srdf_sha256: robot.srdf_sha256().map(str::to_owned),
        }
    }
}
