//! Trajectories as ROS messages in YAML or JSON, of ROS 1 and ROS 2: `trajectory_msgs/JointTrajectory`, `moveit_msgs/RobotTrajectory`, and
//! goals of `control_msgs/action/FollowJointTrajectory`.
//!
//! Joints are matched by name. A stamp that is not zero becomes a note. Frame and number of a header, tolerances and efforts change nothing of
//! the positions that are asked of the joints, and are not read.

use crate::dialect::{ProgramFile, ReadError};
use crate::ros2::node::{Fault, Node};
use crate::ros2::number::ParsedNumber;
use crate::ros2::read::{Fields, document, entries, list, parse_number, refused, text};
use crate::ros2::write::NS_PER_S;
use crate::trajectory::{ExactTime, JointPoints, check_fixed, check_fixed_names};
use platewash_kinematics::urdf::FixedJoints;
use platewash_kinematics::{Joint, JointVector, RobotModel};
use platewash_workcell::words::quoted;

/// Reads a message: the points, and the line of each.
pub(super) fn read(
    file: &ProgramFile,
    arm: &RobotModel,
    fixed: &FixedJoints,
) -> Result<(JointPoints, Vec<usize>), ReadError> {
    // `ros2 topic echo` ends each message so.
    let ended = file.text.trim_end().strip_suffix("\n---").unwrap_or(&file.text);
    let root = document(
        &file.name,
        ended,
        "expected a trajectory .csv, .yaml, .yml or .json; found another name",
    );
    let read = root.and_then(|root| message(&root, &Joints { arm, fixed }));
    read.map_err(|fault| refused(file, fault))
}

/// Finds the `JointTrajectory` of a message.
fn message(root: &Node<'_>, joints: &Joints<'_>) -> Result<(JointPoints, Vec<usize>), Fault> {
    let has = |key: &str| Ok(entries(root, "a message")?.iter().any(|entry| entry.key == key));
    if has("joint_trajectory")? {
        let robot = ["joint_trajectory", "multi_dof_joint_trajectory"];
        let fields = Fields::of(root, "a RobotTrajectory", &robot)?;
        if let Some(other) = fields.get("multi_dof_joint_trajectory") {
            check_no_points(other)?;
        }
        return trajectory(fields.needed("joint_trajectory")?, joints);
    }
    if has("trajectory")? {
        let goal = [
            "trajectory",
            "multi_dof_trajectory",
            "path_tolerance",
            "component_path_tolerance",
            "goal_tolerance",
            "component_goal_tolerance",
            "goal_time_tolerance",
        ];
        let fields = Fields::of(root, "a FollowJointTrajectory goal", &goal)?;
        if let Some(other) = fields.get("multi_dof_trajectory") {
            check_no_points(other)?;
        }
        return trajectory(fields.needed("trajectory")?, joints);
    }
    trajectory(root, joints)
}

/// Joints that a message may have.
struct Joints<'a> {
    arm: &'a RobotModel,
    fixed: &'a FixedJoints,
}

/// Joints of a message, in its order.
struct Columns<'a> {
    names: Vec<String>,
    joints: &'a Joints<'a>,
    /// Place of each axis of the arm; `None` where it is fixed and left out.
    places: Vec<Option<usize>>,
}

/// Refuses a motion of joints with more than one degree of freedom.
fn check_no_points(node: &Node<'_>) -> Result<(), Fault> {
    let fields = Fields::of(node, "a MultiDOFJointTrajectory", &["header", "joint_names", "points"])?;
    match fields.get("points").map(list).transpose()? {
        Some([point, ..]) => Err(Fault::new(
            point.line,
            "expected no motion of joints with more than one degree of freedom; found points of one",
        )),
        _ => Ok(()),
    }
}

fn trajectory(root: &Node<'_>, joints: &Joints<'_>) -> Result<(JointPoints, Vec<usize>), Fault> {
    let fields = Fields::of(root, "a JointTrajectory", &["header", "joint_names", "points"])?;
    let columns = joints.columns(fields.needed("joint_names")?)?;
    let stamp = fields.get("header").map(stamp).transpose()?.unwrap_or_default();
    let nodes = list(fields.needed("points")?)?;
    let (mut points, mut lines) = (JointPoints::default(), Vec::new());
    let (mut times, mut speeds, mut accelerations) = (Vec::new(), Vec::new(), Vec::new());
    for node in nodes {
        let known = ["positions", "velocities", "accelerations", "effort", "time_from_start"];
        let point = Fields::of(node, "a JointTrajectoryPoint", &known)?;
        let row = |name| columns.row(&point, name);
        let Some(positions) = row("positions")? else {
            let count = columns.names.len();
            return Err(Fault::new(node.line, format!("expected {count} positions; found none")));
        };
        points.q_rad.push(positions);
        speeds.extend(row("velocities")?);
        accelerations.extend(row("accelerations")?);
        if let Some(time) = point.get("time_from_start") {
            times.push(duration(time)?);
        }
        for (what, found) in [
            ("velocities", speeds.len()),
            ("accelerations", accelerations.len()),
            ("time_from_start", times.len()),
        ] {
            if found != 0 && found != points.q_rad.len() {
                let reason =
                    format!("expected {what} at every point or at none; some points have them and others do not");
                return Err(Fault::new(node.line, reason));
            }
        }
        if let [.., before, found] = times[..]
            && found <= before
        {
            let line = point.get("time_from_start").map_or(node.line, |time| time.line);
            let reason = format!("expected a time after {before} s, that of the point before; found {found} s");
            return Err(Fault::new(line, reason));
        }
        lines.push(node.line);
    }
    if stamp != ExactTime::default() {
        points.notes.push(format!(
            "its header.stamp is {stamp} s: a controller that takes it later than that enters in its midst, which is not judged"
        ));
    }
    points.start = times.first().copied().unwrap_or_default();
    let after = |time: &ExactTime| time.since(points.start);
    points.t_s = (!times.is_empty()).then(|| times.iter().map(after).collect());
    points.qd_rad_s = (!speeds.is_empty()).then_some(speeds);
    points.qdd_rad_s2 = (!accelerations.is_empty()).then_some(accelerations);
    Ok((points, lines))
}

/// Reads the stamp of a header.
fn stamp(header: &Node<'_>) -> Result<ExactTime, Fault> {
    let fields = Fields::of(header, "a Header", &["stamp", "frame_id", "seq"])?;
    fields.get("stamp").map_or(Ok(ExactTime::default()), duration)
}

impl Joints<'_> {
    /// Reads the names of a message's joints.
    fn columns(&self, node: &Node<'_>) -> Result<Columns<'_>, Fault> {
        let known = self.arm.joints().each_ref().map(|joint| joint.name.as_str());
        let all = known.join(", ");
        let mut names: Vec<String> = Vec::new();
        for name in list(node)? {
            let (line, name) = (name.line, text(name)?);
            let found = quoted(&name);
            if names.contains(&name) {
                let reason = format!("expected each joint once; found {found} again");
                return Err(Fault::new(line, reason));
            }
            if !known.contains(&name.as_str()) && !self.fixed.contains_key(&name) {
                let reason = format!(
                    "expected the arm's joints {all}; found {found}, which is none of them (one that does not move can be fixed: --fix)"
                );
                return Err(Fault::new(line, reason));
            }
            names.push(name);
        }
        let place = |joint: &str| {
            let found = names.iter().position(|name| name == joint);
            match found {
                None if !self.fixed.contains_key(joint) => Err(format!(
                    "expected the arm's joints {all}; {} is missing (one that does not move can be fixed: --fix)",
                    quoted(joint)
                )),
                found => Ok(found),
            }
        };
        let refused = |reason| Fault::new(node.line, reason);
        let places = known
            .into_iter()
            .map(place)
            .collect::<Result<_, _>>()
            .map_err(refused)?;
        let of_file = |name: &str| names.iter().any(|other| other == name);
        check_fixed_names(self.arm, self.fixed, of_file).map_err(refused)?;
        let joints = self;
        Ok(Columns { names, joints, places })
    }
}

impl Columns<'_> {
    /// Numbers of a point, in the order of the arm's axes; `None` for a row that is left out or empty. Joints that are fixed are at rest.
    fn row(&self, point: &Fields<'_, '_>, name: &str) -> Result<Option<JointVector>, Fault> {
        let Some(node) = point.get(name) else { return Ok(None) };
        let row: Vec<_> = list(node)?.iter().map(number).collect::<Result<_, _>>()?;
        let expected = self.names.len();
        match row.len() {
            0 => return Ok(None),
            found if found != expected => {
                return Err(Fault::new(
                    node.line,
                    format!("expected {expected} {name}; found {found}"),
                ));
            }
            _ => {}
        }
        let at_rest = |at: f64| if name == "positions" { at } else { 0.0 };
        for (joint, found) in self.names.iter().zip(&row) {
            if let Some(at) = self.joints.fixed.get(joint) {
                check_fixed(joint, at_rest(*at), *found).map_err(|reason| Fault::new(node.line, reason))?;
            }
        }
        let axes = self.joints.arm.joints().iter().zip(&self.places);
        let number = |(joint, place): (&Joint, &Option<usize>)| match place {
            Some(place) => row[*place],
            None => self.joints.fixed.get(&joint.name).copied().map_or(f64::NAN, at_rest),
        };
        Ok(Some(JointVector::from_iterator(axes.map(number))))
    }
}

fn number(node: &Node<'_>) -> Result<f64, Fault> {
    match parse_number(node) {
        ParsedNumber::Float(value) | ParsedNumber::TextInYaml11(value) => Ok(value),
        ParsedNumber::Whole(value) => Ok(value as f64),
        ParsedNumber::Nothing => {
            let found = node.kind.message();
            Err(Fault::new(
                node.line,
                format!("expected a finite number in decimals; found {found}"),
            ))
        }
    }
}

/// A duration of ROS 2 (`sec`, `nanosec`) or ROS 1 (`secs`, `nsecs`).
fn duration(node: &Node<'_>) -> Result<ExactTime, Fault> {
    let fields = Fields::of(node, "a Duration", &["sec", "nanosec", "secs", "nsecs"])?;
    if fields.is_empty() {
        return Err(Fault::new(node.line, "expected a Duration with sec; it is missing"));
    }
    let has = |keys: [&str; 2]| keys.into_iter().any(|key| fields.get(key).is_some());
    if has(["sec", "nanosec"]) && has(["secs", "nsecs"]) {
        let reason =
            "expected a Duration of ROS 2 with sec and nanosec, or of ROS 1 with secs and nsecs; found keys of both";
        return Err(Fault::new(node.line, reason));
    }
    // What is left out is 0, as in messages.
    let whole = |keys: [&str; 2]| {
        let Some(node) = keys.into_iter().find_map(|key| fields.get(key)) else {
            return Ok(0);
        };
        match parse_number(node) {
            ParsedNumber::Whole(found) if found >= 0 => Ok(i128::from(found)),
            _ => {
                let found = node.kind.message();
                Err(Fault::new(
                    node.line,
                    format!("expected a whole number from 0 on; found {found}"),
                ))
            }
        }
    };
    let ns = whole(["sec", "secs"])? * i128::from(NS_PER_S) + whole(["nanosec", "nsecs"])?;
    ExactTime::of_nanoseconds(ns).ok_or_else(|| Fault::new(node.line, "expected a time of at most 1e15 s; found more"))
}
