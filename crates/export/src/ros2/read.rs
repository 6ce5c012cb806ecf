//! Messages as a reading: each key known, each value of its type, each rule of the controller and of the proof kept.
//!
//! The controller's own rules are those of its check of messages in ros2_controllers 2.54 (Humble) and 6.9, with the parameters that
//! it has by default; they are the same in both, but that 6.9 takes effort where it commands effort. Those of 4.42 (Jazzy), between them, were
//! not read.

use crate::controller_settings::{Accepted, SettingList};
use crate::program::{Place, ProgramFile};
use crate::reading::{ReadPoint, Reading, SegmentShape};
use crate::ros2::times::{LEAD_IN_NS, LEAD_IN_S, seconds_between};
use crate::ros2::write;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion_proof::ReadError;
use platewash_motion_proof::message::number;
use platewash_motion_proof::message::{
    Fault, Fields, Kind, NS_PER_S, Node, ParsedNumber, again, document, entries, list, parse_number, text,
};
use platewash_workcell::words::quoted;

/// Greatest last speed that the controller takes for zero \[rad/s\].
const AT_REST_RAD_S: f64 = f32::EPSILON as f64;

/// Component that a rule belongs to.
const CONTROLLER: &str = "joint_trajectory_controller";
const TYPE: &str = "the message's type";
const PROOF: &str = "the proof";

/// Fault of a broken rule.
fn broken<T>(node: &Node<'_>, (rule, by): (&str, &str), found: impl AsRef<str>) -> Result<T, Fault> {
    node.refused(format!("{} (rule {rule} of {by})", found.as_ref()))
}

/// Reads the files, which must all state the same motion.
pub(crate) fn reading(files: &[&ProgramFile], arm: &RobotModel) -> Result<Reading, ReadError> {
    let mut first: Option<(&ProgramFile, Reading)> = None;
    for file in files {
        let found = one(file, arm).map_err(|fault| fault.in_file(&file.name))?;
        match &mut first {
            None => first = Some((file, found)),
            Some((other, expected)) => {
                same(&other.name, expected, &found).map_err(|fault| fault.in_file(&file.name))?;
                expected.settings.extend(found.settings);
            }
        }
    }
    let Some((file, reading)) = first else {
        let reason = "expected a message in YAML or JSON; found none";
        return Err(ReadError::at("joint_trajectory.yaml", 1, reason));
    };
    let speed_share = files.iter().find_map(|file| speed_share(&file.text)).transpose();
    let speed_share = speed_share.map_err(|fault| fault.in_file(&file.name))?;
    Ok(Reading { speed_share, ..reading })
}

/// Reads one file.
fn one(file: &ProgramFile, arm: &RobotModel) -> Result<Reading, Fault> {
    let other = "expected a file .yaml, .yml or .json, or play.py; found another name";
    let root = document(&file.name, &file.text, other)?;
    let known: Vec<&str> = arm.joints().iter().map(|joint| joint.name.as_str()).collect();
    entries(&root, "a message")?;
    let mut settings = SettingList::default();
    let points = match root.get("trajectory").is_some() {
        true => goal(&root, &file.name, &known, &mut settings)?,
        false => trajectory(&root, &file.name, &known)?,
    };
    Ok(Reading {
        settings: settings.into_vec(),
        ..Reading::from_points(points, SegmentShape::Cubics)
    })
}

fn goal(root: &Node<'_>, file: &str, known: &[&str], settings: &mut SettingList) -> Result<Vec<ReadPoint>, Fault> {
    let goal = Fields::new(
        root,
        "a FollowJointTrajectory goal",
        &["trajectory", "path_tolerance", "goal_tolerance", "goal_time_tolerance"],
    )?;
    let points = trajectory(goal.needed("trajectory")?, file, known)?;
    for key in ["path_tolerance", "goal_tolerance"] {
        for (line, name, found) in tolerances(goal.needed(key)?, key, known)? {
            let (value, accepted) = tolerance_setting(found);
            settings.note_with(&name, &value, &Place::new(file, line), accepted);
        }
    }
    let late = goal.needed("goal_time_tolerance")?;
    let found = seconds_between(0, i128::from(duration(late)?));
    let (value, accepted) = tolerance_setting(found);
    settings.note_with("goal_time_tolerance", &value, &Place::new(file, late.line), accepted);
    Ok(points)
}

/// Checks that the first point comes after the lead-in, and any other after the point before it \[ns\].
fn check_order(time: &Node<'_>, before_ns: Option<i64>, time_ns: i64) -> Result<(), Fault> {
    let seconds = |ns: i64| format!("{}.{:09} s", ns / NS_PER_S, ns % NS_PER_S);
    match before_ns {
        None if time_ns < LEAD_IN_NS => {
            let found = seconds(time_ns);
            let found = format!("expected the first point at {LEAD_IN_S} s or later; found {found}");
            broken(time, ("lead-in", PROOF), found)
        }
        Some(before) if time_ns <= before => {
            let [before, found] = [before, time_ns].map(seconds);
            let found = format!("expected a time after {before}, that of the point before; found {found}");
            broken(time, ("time-order", CONTROLLER), found)
        }
        _ => Ok(()),
    }
}

fn trajectory(root: &Node<'_>, file: &str, known: &[&str]) -> Result<Vec<ReadPoint>, Fault> {
    let fields = Fields::new(root, "a JointTrajectory", &["header", "joint_names", "points"])?;
    fields.get("header").map(check_header).transpose()?;
    let order = order(fields.needed("joint_names")?, known)?;
    let points = fields.needed("points")?;
    let mut all: Vec<ReadPoint> = Vec::new();
    let (mut start_ns, mut before_ns) = (0, None);
    let nodes = list(points)?;
    for (k, node) in nodes.iter().enumerate() {
        let rows = ["positions", "velocities", "accelerations", "effort"];
        let point = Fields::new(
            node,
            "a JointTrajectoryPoint",
            &[&rows[..], &["time_from_start"]].concat(),
        )?;
        let time = point.needed("time_from_start")?;
        let time_ns = duration(time)?;
        check_order(time, before_ns, time_ns)?;
        start_ns = before_ns.map_or(time_ns, |_| start_ns);
        before_ns = Some(time_ns);
        let positions = row(&point, "positions", AXES, CONTROLLER)?;
        let velocities = row(&point, "velocities", AXES, PROOF)?;
        row(&point, "accelerations", 0, PROOF)?;
        row(&point, "effort", 0, CONTROLLER)?;
        let ends = [
            (0, "first", 0.0, ("start-speed", PROOF)),
            (nodes.len() - 1, "last", AT_REST_RAD_S, ("end-speed", CONTROLLER)),
        ];
        for (_, which, most_rad_s, rule) in ends.into_iter().filter(|end| end.0 == k) {
            if let Some(speed) = velocities.iter().find(|speed| speed.abs() > most_rad_s) {
                let found = format!("expected velocities of 0 at the {which} point; found {speed} rad/s");
                return broken(point.get("velocities").unwrap_or(node), rule, found);
            }
        }
        let joints = |row: &[f64]| JointVector::from_fn(|joint, _| row.get(order[joint]).copied().unwrap_or(f64::NAN));
        all.push(ReadPoint {
            place: Place::new(file, node.line),
            t_s: seconds_between(i128::from(start_ns), i128::from(time_ns)),
            q_rad: joints(&positions),
            qd_rad_s: Some(joints(&velocities)),
            corner_m: None,
        });
    }
    if all.is_empty() {
        return broken(points, ("points", CONTROLLER), "expected points; found none");
    }
    Ok(all)
}

/// Checks that the trajectory starts at once.
fn check_header(header: &Node<'_>) -> Result<(), Fault> {
    let header = Fields::new(header, "a Header", &["stamp", "frame_id"])?;
    header.get("frame_id").map(text).transpose()?;
    if let Some(stamp) = header.get("stamp")
        && duration(stamp)? != 0
    {
        let found = "expected a header.stamp of 0, which is at once; found a time of the clock";
        return broken(stamp, ("stamp", PROOF), found);
    }
    Ok(())
}

/// Place in the message of each joint of the arm.
fn order(node: &Node<'_>, known: &[&str]) -> Result<[usize; AXES], Fault> {
    let mut names: Vec<String> = Vec::new();
    for stated in list(node)? {
        let name = text(stated)?;
        if names.contains(&name) {
            return broken(stated, ("joint-twice", PROOF), again(&name));
        }
        if !known.contains(&name.as_str()) {
            return broken(stated, ("joint-name", CONTROLLER), unknown(&name, known));
        }
        names.push(name);
    }
    if names.len() != AXES {
        let missing: Vec<_> = known
            .iter()
            .filter(|joint| !names.iter().any(|name| name == *joint))
            .copied()
            .collect();
        let (found, missing) = (names.len(), missing.join(", "));
        let found = format!("expected the {AXES} joints of the arm; found {found}, without {missing}");
        return broken(node, ("joint-count", CONTROLLER), found);
    }
    Ok(std::array::from_fn(|joint| {
        names.iter().position(|name| name == known[joint]).unwrap_or(joint)
    }))
}

fn unknown(name: &str, known: &[&str]) -> String {
    format!(
        "expected one of the arm's joints {}; found {}",
        known.join(", "),
        quoted(name)
    )
}

/// Numbers of a point, as many as there must be; a row that is left out is empty.
fn row(point: &Fields<'_, '_>, name: &str, expected: usize, by: &str) -> Result<Vec<f64>, Fault> {
    let row = point.get(name).map(list).transpose()?.unwrap_or_default();
    let row = row.iter().map(float).collect::<Result<Vec<_>, _>>()?;
    if row.len() == expected {
        return Ok(row);
    }
    let found = format!("expected {expected} {name}; found {}", row.len());
    broken(point.get(name).unwrap_or(point.node), (name, by), found)
}

/// A tolerance as a setting: wider ones are accepted; 0 leaves it to the controller, whose own is not known, and -1 removes it.
fn tolerance_setting(found: f64) -> (String, Accepted) {
    match found {
        -1.0 => ("none".to_owned(), Accepted::AtLeast(f64::INFINITY)),
        0.0 => ("the controller's own".to_owned(), Accepted::Equal),
        found => (format!("{found:?}"), Accepted::AtLeast(found)),
    }
}

/// The tolerances of a list: the line of each, its name, and its number.
fn tolerances(node: &Node<'_>, which: &str, known: &[&str]) -> Result<Vec<(usize, String, f64)>, Fault> {
    const RULE: (&str, &str) = ("tolerance", CONTROLLER);
    let mut names: Vec<String> = Vec::new();
    let mut all = Vec::new();
    for tolerance in list(node)? {
        let numbers = ["position", "velocity", "acceleration"];
        let fields = Fields::new(tolerance, "a JointTolerance", &[&["name"], &numbers[..]].concat())?;
        let stated = fields.needed("name")?;
        let name = text(stated)?;
        if !known.contains(&name.as_str()) {
            return broken(stated, RULE, unknown(&name, known));
        }
        if names.contains(&name) {
            return broken(stated, RULE, again(&name));
        }
        for key in numbers {
            let number = fields.get(key);
            let (at, found) = (number.unwrap_or(tolerance), number.map_or(Ok(0.0), float)?);
            all.push((at.line, format!("{which} of {name}, {key}"), found));
            if !(found >= 0.0 || found == -1.0) {
                let found = format!(
                    "expected a tolerance above 0, or 0 for the controller's own, or -1.0 for none; found {found}"
                );
                return broken(at, RULE, found);
            }
        }
        names.push(name);
    }
    match names.len() {
        AXES => Ok(all),
        found => {
            let found = format!("expected a {which} for each of the {AXES} joints; found {found}");
            broken(node, RULE, found)
        }
    }
}

/// A Duration \[ns\].
fn duration(node: &Node<'_>) -> Result<i64, Fault> {
    let fields = Fields::new(node, "a Duration", &["sec", "nanosec"])?;
    let whole = |key: &str, most: i64| {
        let node = fields.needed(key)?;
        match parse_number(node) {
            ParsedNumber::Whole(found) if (0..=most).contains(&found) => Ok(found),
            ParsedNumber::Whole(found) => {
                let found = format!("expected {key} from 0 to {most}; found {found}");
                broken(node, ("duration", TYPE), found)
            }
            _ => node.unexpected("a whole number"),
        }
    };
    Ok(whole("sec", i64::from(i32::MAX))? * NS_PER_S + whole("nanosec", NS_PER_S - 1)?)
}

/// Checks that two files state the same motion.
fn same(other: &str, expected: &Reading, found: &Reading) -> Result<(), Fault> {
    let same = |a: &ReadPoint, b: &ReadPoint| a.t_s == b.t_s && a.q_rad == b.q_rad && a.qd_rad_s == b.qd_rad_s;
    for (k, (a, b)) in expected.points.iter().zip(&found.points).enumerate() {
        if !same(a, b) {
            let reason = format!(
                "expected point {k} as {other}:{} has it; found another one",
                a.place.line
            );
            return Fault::err(b.place.line, reason);
        }
    }
    match [expected.points.len(), found.points.len()] {
        [many, few] if many != few => {
            let line = found.points.last().map_or(1, |point| point.place.line);
            let reason = format!("expected {many} points, as many as {other} has; found {few}");
            Fault::err(line, reason)
        }
        _ => Ok(()),
    }
}

/// The share of the plan's speed at the head of a text.
fn speed_share(text: &str) -> Option<Result<f64, Fault>> {
    let mut head = text.lines().enumerate().take_while(|(_, line)| line.starts_with('#'));
    let (line, stated) = head.find_map(|(k, line)| Some((k + 1, line.strip_prefix(write::SPEED_SHARE)?)))?;
    Some(match number::read(stated.trim_end()) {
        ParsedNumber::Float(share) if share > 0.0 && share <= 1.0 => Ok(share),
        _ => Fault::err(
            line,
            "expected a speed share above 0.0 and at most 1.0; found another value",
        ),
    })
}

fn float(node: &Node<'_>) -> Result<f64, Fault> {
    let found = node.kind.message();
    let reason = match parse_number(node) {
        ParsedNumber::Float(value) => return Ok(value),
        ParsedNumber::TextInYaml11(value) if matches!(node.kind, Kind::OfJson(_)) => return Ok(value),
        ParsedNumber::Whole(whole) => {
            format!("expected a float, which ROS 2 does not take a whole number for; write {whole}.0 for {found}")
        }
        ParsedNumber::TextInYaml11(_) => format!(
            "expected a float; {found} is a text in YAML 1.1, which ROS 2 reads: a float has a point, and its exponent a sign, as in 1.0e-5"
        ),
        ParsedNumber::Nothing => format!("expected a float, finite and in decimals; found {found}"),
    };
    node.refused(reason)
}
