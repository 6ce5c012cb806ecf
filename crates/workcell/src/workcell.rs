//! The world that an arm works in.
//!
//! An arm in its workcell: mounted anywhere, among obstacles; and that workcell as the arm sees it.
//!
//! What is computed with an arm is computed in the frame of its base. Whoever starts from a world takes it there first, once:
//! [`Workcell::seen_from_base`], [`crate::job::JobTerms::seen_from_base`], [`crate::plan::Plan::seen_from_base`].

pub use crate::obstacle::{Obstacle, ObstacleShape};

use crate::clearance::{self, ClearanceError};
use crate::pose;
use crate::tool::Tool;
use platewash_kinematics::{Pose, RobotModel};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

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

impl Workcell {
    /// An arm mounted at `T_world_base`, with its tool, among obstacles given in the world.
    ///
    /// # Errors
    /// [`ClearanceError`] for an arm with a shape that is none.
    pub fn new(robot: &RobotModel, tool: Tool, mount: Pose, obstacles: Vec<Obstacle>) -> Result<Self, ClearanceError> {
        let mut workcell = Self {
            mount,
            arm: ArmId::of(robot),
            tool,
            obstacles,
            exclusions: Vec::new(),
        };
        workcell.exclusions = workcell.own_exclusions(robot)?;
        Ok(workcell)
    }

    /// An arm that stands on the floor at the world's origin, with its tool.
    ///
    /// # Errors
    /// As [`Workcell::new`].
    pub fn on_floor(robot: &RobotModel, tool: Tool) -> Result<Self, ClearanceError> {
        Self::new(robot, tool, Pose::identity(), vec![Obstacle::floor()])
    }

    /// The pairs that need not keep clear because of what arm, tool and obstacles are ([`clearance::exclusions`]), whatever the
    /// workcell states.
    ///
    /// # Errors
    /// [`ClearanceError`] for a shape that is none.
    pub fn own_exclusions(&self, robot: &RobotModel) -> Result<Vec<Exclusion>, ClearanceError> {
        clearance::exclusions(robot, &self.tool, &self.obstacles_from_base())
    }

    /// The same workcell in the frame of the arm's base, in which the arm is mounted at the origin.
    #[must_use]
    pub fn seen_from_base(&self) -> Cow<'_, Self> {
        if self.is_in_base_frame() {
            return Cow::Borrowed(self);
        }
        Cow::Owned(Self {
            mount: Pose::identity(),
            obstacles: self.obstacles_from_base().into_owned(),
            ..self.clone()
        })
    }

    /// Whether world and base are one frame, to the bit.
    #[must_use]
    pub fn is_in_base_frame(&self) -> bool {
        self.mount == Pose::identity()
    }

    /// Its obstacles in the frame of the arm's base.
    #[must_use]
    pub fn obstacles_from_base(&self) -> Cow<'_, [Obstacle]> {
        if self.is_in_base_frame() {
            return Cow::Borrowed(&self.obstacles);
        }
        let to_base = self.mount.inverse();
        let seen = |obstacle: &Obstacle| Obstacle {
            pose: to_base * obstacle.pose,
            ..obstacle.clone()
        };
        Cow::Owned(self.obstacles.iter().map(seen).collect())
    }
}
