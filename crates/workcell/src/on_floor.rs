//! An arm that stands on the floor of a room: the workcell that today's scenarios state.

use crate::clearance::{self, ClearanceError};
use crate::tool::Tool;
use crate::workcell::{ArmId, Obstacle, Workcell};
use platewash_kinematics::{Pose, RobotModel};

impl Workcell {
    /// An arm that stands on the floor at the world's origin, with its tool.
    ///
    /// # Errors
    /// [`ClearanceError`] for an arm with a shape that is none.
    pub fn on_floor(robot: &RobotModel, tool: Tool) -> Result<Self, ClearanceError> {
        let obstacles = vec![Obstacle::floor()];
        let exclusions = clearance::exclusions(robot, &tool, &obstacles)?;
        Ok(Self {
            mount: Pose::identity(),
            arm: ArmId::of(robot),
            tool,
            obstacles,
            exclusions,
        })
    }
}
