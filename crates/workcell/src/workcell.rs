//! Workcell: the surroundings of an arm.
//!
//! An arm in its workcell is mounted at any pose, among obstacles. The workcell can be converted to the frame of the arm's base.
//!
//! All computations with an arm are in the frame of its base. A caller with data in the world frame converts it first:
//! [`Workcell::seen_from_base`], [`crate::job::JobTerms::seen_from_base`], and the same of a plan.

use crate::obstacle::Obstacle;

use crate::pose;
use crate::tool::Tool;
use crate::words::quoted;
use platewash_kinematics::urdf::FixedJoints;
use platewash_kinematics::{Pose, RobotModel};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Greatest number of bodies of a workcell, tool and obstacles together.
pub const MOST_BODIES: usize = 1000;

/// An arm with its mount, its tool and its obstacles, without the plates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Workcell {
    /// Mount of the arm, `T_world_base`.
    #[serde(with = "pose")]
    pub mount: Pose,
    /// Identity of the arm.
    pub arm: ArmId,
    /// Tool of the arm.
    pub tool: Tool,
    /// Obstacles, including the floor.
    pub obstacles: Vec<Obstacle>,
    /// Pairs of bodies that need not keep clear of each other.
    pub exclusions: Vec<Exclusion>,
    /// Pairs of bodies of arm and tool that keep less than the required clearance.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reduced_clearances: Vec<ReducedClearance>,
}

impl Workcell {
    /// Number of bodies of tool and obstacles together.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.tool.bodies.len() + self.obstacles.len()
    }
}

/// Identity of an arm by its description.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArmId {
    /// Name in the URDF.
    pub name: String,
    /// SHA-256 of the URDF, lower-case hexadecimal.
    pub urdf_sha256: String,
    /// SHA-256 of the SRDF, if one was given.
    pub srdf_sha256: Option<String>,
    /// Joints of the description that are held still, with their positions \[rad, or m for a prismatic joint\].
    #[serde(default, skip_serializing_if = "FixedJoints::is_empty")]
    pub fixed: FixedJoints,
}

/// Pair of bodies that need not keep clear of each other.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exclusion {
    /// Names of the bodies.
    pub pair: [String; 2],
    /// Reason of the exclusion.
    pub reason: ExclusionReason,
}

/// Pair of bodies of arm and tool that keeps less than the required clearance, as those that are near each other in every configuration.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReducedClearance {
    /// Names of the bodies.
    pub pair: [String; 2],
    /// Part of the required clearance that the pair need not keep \[m\]; less than all of it.
    pub by_m: f64,
    /// True where the pair is this near where the arm was stopped, at the start of a recovery. Any bodies may be.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub at_stop: bool,
}

/// True if a pair of names is that of the two bodies, in either order.
#[must_use]
pub fn is_pair(pair: &[String; 2], (a, b): (&str, &str)) -> bool {
    let [x, y] = pair.each_ref().map(String::as_str);
    (x, y) == (a, b) || (x, y) == (b, a)
}

/// Reason that two bodies need not keep clear of each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExclusionReason {
    /// The arm's SRDF disables the pair.
    Srdf,
    /// The bodies are neighbours, of an arm without an SRDF.
    Neighbours,
    /// The bodies touch in every sampled configuration, of an arm without an SRDF.
    AlwaysTouching,
    /// The wrist carries the tool.
    CarriesTool,
    /// Neither body moves.
    NeitherMoves,
    /// The body turns about the vertical, over the floor.
    KeepsItsHeight,
}

impl ArmId {
    /// The joints that are held still in words, such as `"rail" at 0.3`; empty without any.
    #[must_use]
    pub fn fixed_words(&self) -> String {
        let words = self
            .fixed
            .iter()
            .map(|(joint, at)| format!("{} at {at}", quoted(joint)));
        words.collect::<Vec<_>>().join(", ")
    }

    /// Returns the identity of an arm.
    #[must_use]
    pub fn new(robot: &RobotModel) -> Self {
        Self {
            name: robot.name().to_owned(),
            urdf_sha256: robot.sha256().to_owned(),
            srdf_sha256: robot.srdf_sha256().map(str::to_owned),
            fixed: robot.fixed_joints().clone(),
        }
    }
}

impl Workcell {
    /// Returns the workcell in the frame of the arm's base, with the arm mounted at the origin.
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

    /// True if world and base are one frame, to the bit.
    #[must_use]
    pub fn is_in_base_frame(&self) -> bool {
        self.mount == Pose::identity()
    }

    /// Returns the obstacles in the frame of the arm's base.
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
