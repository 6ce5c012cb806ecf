//! A message out of a tree: each key known, each value of its type.

use super::message::{At, Message, MessagePoint, Span, Tolerance, Tolerances};
use super::node::{Entry, Fault, Kind, Node};
use super::number::{self, Said};
use platewash_workcell::words::quoted;

/// Reads a `trajectory_msgs/JointTrajectory`, or a `control_msgs/action/FollowJointTrajectory` goal.
pub(super) fn message(root: &Node<'_>) -> Result<Message, Fault> {
    let fields = entries(root, "a message")?;
    if fields.iter().all(|entry| entry.key != "trajectory") {
        return trajectory(root);
    }
    let goal = Fields::of(
        root,
        "a FollowJointTrajectory goal",
        &["trajectory", "path_tolerance", "goal_tolerance", "goal_time_tolerance"],
    )?;
    let tolerances = Tolerances {
        path: tolerances(goal.needed("path_tolerance")?)?,
        goal: tolerances(goal.needed("goal_tolerance")?)?,
        goal_time: span(goal.needed("goal_time_tolerance")?)?,
    };
    Ok(Message {
        tolerances: Some(tolerances),
        ..trajectory(goal.needed("trajectory")?)?
    })
}

fn trajectory(root: &Node<'_>) -> Result<Message, Fault> {
    let fields = Fields::of(root, "a JointTrajectory", &["header", "joint_names", "points"])?;
    let (names, points) = (fields.needed("joint_names")?, fields.needed("points")?);
    Ok(Message {
        stamp: fields.get("header").map(stamp).transpose()?.unwrap_or_default(),
        joint_names: all(names, name)?,
        points: all(points, point)?,
        tolerances: None,
    })
}

/// The time of a `std_msgs/Header`, whose frame says nothing to a controller.
fn stamp(node: &Node<'_>) -> Result<Span, Fault> {
    let fields = Fields::of(node, "a Header", &["stamp", "frame_id"])?;
    fields.get("frame_id").map(name).transpose()?;
    fields.get("stamp").map(span).transpose().map(Option::unwrap_or_default)
}

fn point(node: &Node<'_>) -> Result<MessagePoint, Fault> {
    let rows = ["positions", "velocities", "accelerations", "effort"];
    let fields = Fields::of(
        node,
        "a JointTrajectoryPoint",
        &[&rows[..], &["time_from_start"]].concat(),
    )?;
    let row = |key: &str| match fields.get(key) {
        Some(node) => all(node, float),
        // A row that is left out is empty.
        None => Ok(At::on(node.line, Vec::new())),
    };
    let [positions, velocities, accelerations, effort] = rows.map(row);
    Ok(MessagePoint {
        line: node.line,
        positions: positions?,
        velocities: velocities?,
        accelerations: accelerations?,
        effort: effort?,
        time_from_start: span(fields.needed("time_from_start")?)?,
    })
}

fn tolerances(node: &Node<'_>) -> Result<At<Vec<Tolerance>>, Fault> {
    all(node, tolerance)
}

fn tolerance(node: &Node<'_>) -> Result<Tolerance, Fault> {
    let numbers = ["position", "velocity", "acceleration"];
    let fields = Fields::of(node, "a JointTolerance", &[&["name"], &numbers[..]].concat())?;
    let number = |key: &str| match fields.get(key) {
        Some(node) => Ok(At::on(node.line, float(node)?)),
        None => Ok(At::on(node.line, 0.0)),
    };
    let [position, velocity, acceleration] = numbers.map(number);
    Ok(Tolerance {
        name: name(fields.needed("name")?)?,
        position: position?,
        velocity: velocity?,
        acceleration: acceleration?,
    })
}

fn span(node: &Node<'_>) -> Result<Span, Fault> {
    let fields = Fields::of(node, "a Duration", &["sec", "nanosec"])?;
    Ok(Span {
        sec: whole(fields.needed("sec")?)?,
        nanosec: whole(fields.needed("nanosec")?)?,
    })
}

fn name(node: &Node<'_>) -> Result<At<String>, Fault> {
    match &node.kind {
        Kind::Quoted(text) => Ok(At::on(node.line, text.to_string())),
        Kind::Plain(text) if is_word(text) => Ok(At::on(node.line, text.to_string())),
        other => Err(Fault::new(
            node.line,
            format!("expected a text; found {}", other.told()),
        )),
    }
}

/// Whether a value without quotes is a text to every reader: begins with a letter, goes on with letters, digits, `_`, `-`, `/` and `.`,
/// and is none of the words for yes, no and nothing.
fn is_word(text: &str) -> bool {
    const OTHERS: [&str; 9] = ["y", "n", "yes", "no", "on", "off", "true", "false", "null"];
    let named = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '/' | '.');
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(named)
        && !OTHERS.contains(&text.to_ascii_lowercase().as_str())
}

/// A list, each entry read.
fn all<T>(node: &Node<'_>, read: impl Fn(&Node<'_>) -> Result<T, Fault>) -> Result<At<Vec<T>>, Fault> {
    match &node.kind {
        Kind::List(entries) => Ok(At::on(node.line, entries.iter().map(read).collect::<Result<_, _>>()?)),
        other => Err(Fault::new(
            node.line,
            format!("expected a list; found {}", other.told()),
        )),
    }
}

fn said(node: &Node<'_>) -> Said {
    match &node.kind {
        Kind::Plain(text) | Kind::OfJson(text) => number::read(text),
        _ => Said::Nothing,
    }
}

fn float(node: &Node<'_>) -> Result<f64, Fault> {
    let found = node.kind.told();
    let reason = match said(node) {
        Said::Float(value) => return Ok(value),
        Said::TextInYaml11(value) if matches!(node.kind, Kind::OfJson(_)) => return Ok(value),
        Said::Whole(whole) => {
            format!("expected a float, which ROS 2 does not take a whole number for; write {whole}.0 for {found}")
        }
        Said::TextInYaml11(_) => format!(
            "expected a float; {found} is a text in YAML 1.1, which ROS 2 reads: a float has a point, and its exponent a sign, as in 1.0e-5"
        ),
        Said::Nothing => format!("expected a float, finite and in decimals; found {found}"),
    };
    Err(Fault::new(node.line, reason))
}

fn whole(node: &Node<'_>) -> Result<At<i64>, Fault> {
    match said(node) {
        Said::Whole(value) => Ok(At::on(node.line, value)),
        _ => Err(Fault::new(
            node.line,
            format!("expected a whole number; found {}", node.kind.told()),
        )),
    }
}

fn entries<'n, 'a>(node: &'n Node<'a>, what: &str) -> Result<&'n [Entry<'a>], Fault> {
    match &node.kind {
        Kind::Table(entries) => Ok(entries),
        other => Err(Fault::new(
            node.line,
            format!("expected {what}; found {}", other.told()),
        )),
    }
}

/// The fields of a table whose keys are all known.
struct Fields<'n, 'a> {
    node: &'n Node<'a>,
    what: &'static str,
    entries: &'n [Entry<'a>],
}

impl<'n, 'a> Fields<'n, 'a> {
    fn of(node: &'n Node<'a>, what: &'static str, known: &[&str]) -> Result<Self, Fault> {
        let entries = entries(node, what)?;
        match entries.iter().find(|entry| !known.contains(&entry.key.as_ref())) {
            Some(entry) => Err(Fault::new(
                entry.line,
                format!(
                    "expected {what} with {}; found the key {}",
                    known.join(", "),
                    quoted(&Kind::Plain(entry.key.clone()).told())
                ),
            )),
            None => Ok(Self { node, what, entries }),
        }
    }

    fn get(&self, key: &str) -> Option<&'n Node<'a>> {
        self.entries
            .iter()
            .find(|entry| entry.key == key)
            .map(|entry| &entry.value)
    }

    fn needed(&self, key: &str) -> Result<&'n Node<'a>, Fault> {
        let missing = || {
            Fault::new(
                self.node.line,
                format!("expected {} with {key}; it is missing", self.what),
            )
        };
        self.get(key).ok_or_else(missing)
    }
}
