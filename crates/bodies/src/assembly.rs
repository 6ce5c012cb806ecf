//! Assembly of a workcell from an arm, a tool and obstacles, with the pairs of bodies that need not keep clear of each other.

use crate::clearance::{self, ClearanceError};
use platewash_kinematics::{Pose, RobotModel};
use platewash_workcell::tool::Tool;
use platewash_workcell::{ArmId, Exclusion, Obstacle, Workcell};

/// Returns the workcell of an arm mounted at `T_world_base`, with its tool, among obstacles in the world frame.
///
/// # Errors
/// [`ClearanceError`] for an arm with an invalid shape.
pub fn workcell(
    robot: &RobotModel,
    tool: Tool,
    mount: Pose,
    obstacles: Vec<Obstacle>,
) -> Result<Workcell, ClearanceError> {
    let mut workcell = Workcell {
        mount,
        arm: ArmId::new(robot),
        tool,
        obstacles,
        exclusions: Vec::new(),
        reduced_clearances: Vec::new(),
    };
    workcell.exclusions = own_exclusions(&workcell, robot)?;
    Ok(workcell)
}

/// Returns the workcell of a bare arm mounted at `T_world_base`, among obstacles in the world frame. The links behind joint 6 are all that it
/// carries.
///
/// # Errors
/// As [`workcell()`].
pub fn workcell_without_tool(
    robot: &RobotModel,
    mount: Pose,
    obstacles: Vec<Obstacle>,
) -> Result<Workcell, ClearanceError> {
    workcell(robot, Tool::none(robot), mount, obstacles)
}

/// Returns the workcell of an arm that stands on the floor at the world's origin, with its tool.
///
/// # Errors
/// As [`workcell()`].
pub fn workcell_on_floor(robot: &RobotModel, tool: Tool) -> Result<Workcell, ClearanceError> {
    workcell(robot, tool, Pose::identity(), vec![Obstacle::floor()])
}

/// Returns the pairs of a workcell that need not keep clear because of the arm, the tool and the obstacles ([`clearance::exclusions`]),
/// independently of the stated exclusions.
///
/// # Errors
/// [`ClearanceError`] for an invalid shape.
pub fn own_exclusions(workcell: &Workcell, robot: &RobotModel) -> Result<Vec<Exclusion>, ClearanceError> {
    clearance::exclusions(robot, &workcell.tool, &workcell.obstacles_from_base())
}
