//! Messages that planners, action clients and recorders put around a trajectory.
//!
//! | message | keys |
//! | --- | --- |
//! | `moveit_msgs/DisplayTrajectory` | `trajectory` (a list), `trajectory_start`, `model_id` |
//! | `moveit_msgs/RobotTrajectory` | `joint_trajectory`, `multi_dof_joint_trajectory` |
//! | goal of `moveit_msgs/ExecuteTrajectory`, `moveit_msgs/MotionPlanResponse` | `trajectory` with a `joint_trajectory`, and others |
//! | response of `moveit_msgs/GetMotionPlan`, of `GetCartesianPath`, result of `MoveGroup` | `motion_plan_response`, `solution`, `planned_trajectory` |
//! | goal of `control_msgs/FollowJointTrajectory` | `trajectory`, tolerances |
//! | an action's goal of ROS 1, or of ROS 2's service | `goal`, `goal_id`, `header` |
//! | rosbridge | `op`, and `msg` or `args` |
//!
//! What they state beside the trajectory is used, becomes a note, or is on the list of docs/prove-motion.md of what cannot matter.

use crate::message::{Fault, Fields, Kind, Node, ParsedNumber, entries, list, parse_number, text};
use platewash_workcell::words::{count_with_noun, quoted};

/// Code of success in `moveit_msgs/MoveItErrorCodes`.
const SUCCESS: f64 = 1.0;

/// Most keys that a message names.
const MOST_KEYS: usize = 6;

/// A trajectory in a message.
#[derive(Debug)]
pub(super) struct FoundTrajectory<'n, 'a> {
    /// The `JointTrajectory`.
    pub(super) node: &'n Node<'a>,
    /// The `RobotState` from which it was planned.
    pub(super) start: Option<&'n Node<'a>>,
    /// Statements around it that a reader of the verdict should know; one clause each.
    pub(super) notes: Vec<String>,
}

/// Finds the trajectories of a message, in their order.
pub(super) fn find<'n, 'a>(root: &'n Node<'a>) -> Result<Vec<FoundTrajectory<'n, 'a>>, Fault> {
    entries(root, "a message")?;
    let has = |key: &str| root.get(key).is_some();
    let one = |found: FoundTrajectory<'n, 'a>| Ok(vec![found]);
    if let Some(operation) = root.get("op") {
        return bridge(root, &text(operation)?);
    }
    if has("goal") {
        let fields = Fields::new(root, "an action's goal", &["header", "goal_id", "goal"])?;
        check_header(&fields)?;
        if let Some(id) = fields.get("goal_id") {
            Fields::new(id, "a goal_id", &["stamp", "id", "uuid"])?;
        }
        return find(fields.needed("goal")?);
    }
    if has("motion_plan_response") {
        let fields = Fields::new(root, "a response of GetMotionPlan", &["motion_plan_response"])?;
        return find(fields.needed("motion_plan_response")?);
    }
    if has("joint_trajectory") {
        return one(robot_trajectory(root)?);
    }
    if has("solution") {
        let known = ["start_state", "solution", "fraction", "error_code"];
        let fields = Fields::new(root, "a response of GetCartesianPath", &known)?;
        return one(planned(&fields, "solution", "start_state")?);
    }
    if has("planned_trajectory") {
        let known = [
            "error_code",
            "trajectory_start",
            "planned_trajectory",
            "executed_trajectory",
            "planning_time",
        ];
        let fields = Fields::new(root, "a result of MoveGroup", &known)?;
        let mut found = planned(&fields, "planned_trajectory", "trajectory_start")?;
        let executed = fields.get("executed_trajectory");
        let executed = executed.filter(|node| node.get("joint_trajectory").is_some());
        let points = executed
            .map(robot_trajectory)
            .transpose()?
            .and_then(|found| found.node.get("points"));
        if points.is_some_and(|points| matches!(&points.kind, Kind::List(points) if !points.is_empty())) {
            found.notes.push("its executed_trajectory is not judged".to_owned());
        }
        return one(found);
    }
    match root.get("trajectory") {
        Some(Node {
            kind: Kind::List(_), ..
        }) => display(root),
        Some(inner) if inner.get("joint_trajectory").is_some() => {
            // The goal of ExecuteTrajectory, or MotionPlanResponse.
            let known = [
                "trajectory",
                "controller_names",
                "trajectory_start",
                "group_name",
                "planning_time",
                "error_code",
            ];
            let fields = Fields::new(root, "a goal of ExecuteTrajectory, or a MotionPlanResponse,", &known)?;
            one(planned(&fields, "trajectory", "trajectory_start")?)
        }
        Some(_) => one(follow_goal(root)?),
        None if has("joint_names") || has("points") => one(plain(root)),
        None => root.refused(unknown(root)),
    }
}

/// Checks the keys of a header, whose values change nothing of the motion.
fn check_header(fields: &Fields<'_, '_>) -> Result<(), Fault> {
    let header = fields.get("header");
    let read = header.map(|header| Fields::new(header, "a Header", &["stamp", "frame_id", "seq"]));
    read.transpose().map(|_| ())
}

fn plain<'n, 'a>(node: &'n Node<'a>) -> FoundTrajectory<'n, 'a> {
    FoundTrajectory {
        node,
        start: None,
        notes: Vec::new(),
    }
}

/// Reason for refusing a table that is none of the messages.
fn unknown(root: &Node<'_>) -> String {
    let keys: Vec<_> = entries(root, "a message")
        .unwrap_or_default()
        .iter()
        .map(|entry| entry.key.as_ref())
        .collect();
    let found = match (&keys[..], root.get("position").is_some()) {
        ([], _) => "nothing".to_owned(),
        (_, true) => "positions of a JointState, which are no trajectory".to_owned(),
        (keys, false) => {
            let shown: Vec<_> = keys.iter().take(MOST_KEYS).map(|key| quoted(key)).collect();
            let more = if keys.len() > MOST_KEYS { ", …" } else { "" };
            format!("the keys {}{more}", shown.join(", "))
        }
    };
    format!(
        "expected a JointTrajectory with joint_names, a RobotTrajectory, a DisplayTrajectory, a goal of FollowJointTrajectory or \
         ExecuteTrajectory, a MotionPlanResponse, or a rosbridge message of one; found {found}"
    )
}

fn bridge<'n, 'a>(root: &'n Node<'a>, operation: &str) -> Result<Vec<FoundTrajectory<'n, 'a>>, Fault> {
    const PUBLISH: [&str; 8] = [
        "op",
        "id",
        "topic",
        "type",
        "latch",
        "queue_size",
        "queue_length",
        "msg",
    ];
    const GOAL: [&str; 8] = [
        "op",
        "id",
        "action",
        "action_type",
        "feedback",
        "fragment_size",
        "compression",
        "args",
    ];
    match operation {
        "publish" => find(Fields::new(root, "a rosbridge message", &PUBLISH)?.needed("msg")?),
        "send_action_goal" => find(Fields::new(root, "a rosbridge message", &GOAL)?.needed("args")?),
        other => root.refused(format!(
            "expected a rosbridge message whose op is publish or send_action_goal; found {}",
            quoted(other)
        )),
    }
}

/// The trajectories of a `DisplayTrajectory`. The state from which they were planned is that of the first.
fn display<'n, 'a>(root: &'n Node<'a>) -> Result<Vec<FoundTrajectory<'n, 'a>>, Fault> {
    let fields = Fields::new(
        root,
        "a DisplayTrajectory",
        &["model_id", "trajectory", "trajectory_start"],
    )?;
    let parts = fields.needed("trajectory")?;
    let mut all: Vec<_> = list(parts)?.iter().map(robot_trajectory).collect::<Result<_, _>>()?;
    match all.first_mut() {
        Some(first) => first.start = fields.get("trajectory_start"),
        None => return parts.refused("expected a trajectory in the DisplayTrajectory; found none"),
    }
    Ok(all)
}

/// The trajectory of a planner's answer.
fn planned<'n, 'a>(fields: &Fields<'n, 'a>, key: &str, start: &str) -> Result<FoundTrajectory<'n, 'a>, Fault> {
    let mut found = robot_trajectory(fields.needed(key)?)?;
    found.start = fields.get(start);
    if let Some(code) = fields.get("error_code") {
        let code = Fields::new(code, "a MoveItErrorCodes", &["val", "message", "source"])?;
        let value = code.get("val").map(number).transpose()?.unwrap_or(0.0);
        if value != SUCCESS {
            found
                .notes
                .push(format!("its error_code is {value}, and {SUCCESS} means success"));
        }
    }
    if let Some(fraction) = fields.get("fraction") {
        let value = number(fraction)?;
        if value != 1.0 {
            found.notes.push(format!(
                "its fraction is {value}: it is a part of the path that was asked for"
            ));
        }
    }
    Ok(found)
}

fn robot_trajectory<'n, 'a>(node: &'n Node<'a>) -> Result<FoundTrajectory<'n, 'a>, Fault> {
    let known = ["joint_trajectory", "multi_dof_joint_trajectory"];
    let fields = Fields::new(node, "a RobotTrajectory", &known)?;
    if let Some(other) = fields.get("multi_dof_joint_trajectory") {
        check_no_points(other)?;
    }
    Ok(plain(fields.needed("joint_trajectory")?))
}

fn follow_goal<'n, 'a>(root: &'n Node<'a>) -> Result<FoundTrajectory<'n, 'a>, Fault> {
    let known = [
        "trajectory",
        "multi_dof_trajectory",
        "path_tolerance",
        "component_path_tolerance",
        "goal_tolerance",
        "component_goal_tolerance",
        "goal_time_tolerance",
    ];
    let fields = Fields::new(root, "a FollowJointTrajectory goal", &known)?;
    if let Some(other) = fields.get("multi_dof_trajectory") {
        check_no_points(other)?;
    }
    Ok(plain(fields.needed("trajectory")?))
}

/// Refuses a motion of joints with more than one degree of freedom.
fn check_no_points(node: &Node<'_>) -> Result<(), Fault> {
    let fields = Fields::new(node, "a MultiDOFJointTrajectory", &["header", "joint_names", "points"])?;
    check_header(&fields)?;
    match fields.get("points").map(list).transpose()? {
        Some([point, ..]) => {
            point.refused("expected no motion of joints with more than one degree of freedom; found points of one")
        }
        _ => Ok(()),
    }
}

/// A number that may be whole.
pub(super) fn number(node: &Node<'_>) -> Result<f64, Fault> {
    match parse_number(node) {
        ParsedNumber::Float(value) | ParsedNumber::TextInYaml11(value) => Ok(value),
        ParsedNumber::Whole(value) => Ok(value as f64),
        ParsedNumber::Nothing => node.unexpected("a finite number in decimals"),
    }
}

/// State of a robot from which a trajectory was planned.
#[derive(Debug, Default)]
pub(super) struct RobotState {
    /// Names of joints and their positions \[rad, m\].
    pub(super) positions: Vec<(String, f64)>,
    /// Statements beside them that a reader of the verdict should know; one clause each.
    pub(super) notes: Vec<String>,
}

impl RobotState {
    /// Reads a `moveit_msgs/RobotState`.
    pub(super) fn read(node: &Node<'_>) -> Result<Self, Fault> {
        let known = [
            "joint_state",
            "multi_dof_joint_state",
            "attached_collision_objects",
            "is_diff",
        ];
        let fields = Fields::new(node, "a RobotState", &known)?;
        let mut state = Self::default();
        if let Some(joints) = fields.get("joint_state") {
            let known = ["header", "name", "position", "velocity", "effort"];
            let joints = Fields::new(joints, "a JointState", &known)?;
            check_header(&joints)?;
            let names = joints.get("name").map(list).transpose()?.unwrap_or_default();
            let positions = joints.get("position").map(list).transpose()?.unwrap_or_default();
            if names.len() != positions.len() {
                let reason = format!(
                    "expected as many positions as names in the joint_state, {}; found {}",
                    names.len(),
                    positions.len()
                );
                return joints.node.refused(reason);
            }
            for (name, position) in names.iter().zip(positions) {
                state.positions.push((text(name)?, number(position)?));
            }
        }
        if let Some(carried) = fields.get("attached_collision_objects")
            && let count @ 1.. = list(carried)?.len()
        {
            state.notes.push(format!(
                "its trajectory_start attaches {} to the arm, which {} not judged: state them with --tool",
                count_with_noun(count, "object"),
                if count == 1 { "is" } else { "are" }
            ));
        }
        if let Some(base) = fields.get("multi_dof_joint_state")
            && places_the_robot(base)?
        {
            state.notes.push(
                "its trajectory_start places the robot with a joint of more than one degree of freedom, which is not used: state the place \
                 with --mount"
                    .to_owned(),
            );
        }
        Ok(state)
    }
}

/// Returns true where a `MultiDOFJointState` has a transform that is not the identity.
fn places_the_robot(node: &Node<'_>) -> Result<bool, Fault> {
    let known = ["header", "joint_names", "transforms", "twist", "wrench"];
    let fields = Fields::new(node, "a MultiDOFJointState", &known)?;
    check_header(&fields)?;
    for transform in fields.get("transforms").map(list).transpose()?.unwrap_or_default() {
        let parts = Fields::new(transform, "a Transform", &["translation", "rotation"])?;
        for key in ["translation", "rotation"] {
            let Some(part) = parts.get(key) else { continue };
            Fields::new(part, "a Vector3 or a Quaternion", &["x", "y", "z", "w"])?;
            for axis in entries(part, "a vector")? {
                // The last part of a quaternion of no turn is 1 or -1.
                let (found, at_rest) = (number(&axis.value)?, if axis.key == "w" { 1.0 } else { 0.0 });
                if found.abs() != at_rest {
                    return Ok(true);
                }
            }
        }
    }
    Ok(false)
}
