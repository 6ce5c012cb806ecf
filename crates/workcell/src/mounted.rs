//! An arm in its workcell: mounted anywhere, among obstacles; and that workcell as the arm sees it.
//!
//! What is computed with an arm is computed in the frame of its base. Whoever starts from a world takes it there first, once:
//! [`Workcell::seen_from_base`], [`crate::job::JobTerms::seen_from_base`], [`crate::plan::Plan::seen_from_base`].

use crate::clearance::{self, ClearanceError};
use crate::tool::Tool;
use crate::workcell::{ArmId, Exclusion, Obstacle, Workcell};
use platewash_kinematics::{Pose, RobotModel};
use std::borrow::Cow;

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
