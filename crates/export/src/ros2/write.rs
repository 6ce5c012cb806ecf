//! The messages as YAML and JSON, a point a line.

use super::language::Language;
use super::message::{GOAL_RAD, GOAL_TIME_NS, Message, MessagePoint};
use super::number::{float, quoted};
use super::timing::NS_PER_S;
use crate::program::Program;
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::words::printable;

/// Before the share of the speed in the head of a YAML file.
pub(super) const SPEED_SHARE: &str = "# speed_share: ";

/// A `trajectory_msgs/JointTrajectory`.
pub(super) fn trajectory(message: &Message, language: Language) -> String {
    let fields = trajectory_fields(message, language, "");
    document(fields, language)
}

/// A `control_msgs/action/FollowJointTrajectory` goal.
pub(super) fn goal(message: &Message, language: Language) -> String {
    let inner = block(trajectory_fields(message, language, "  "), language, "  ");
    let each = |all: &[f64]| {
        let tolerances = message.joint_names.iter().zip(all);
        list(
            tolerances.map(|(name, rad)| tolerance(name, *rad, language)),
            language,
            "",
        )
    };
    let fields = vec![
        field("trajectory", &inner, language, ""),
        field("path_tolerance", &each(&message.path_rad), language, ""),
        field("goal_tolerance", &each(&[GOAL_RAD; AXES]), language, ""),
        field(
            "goal_time_tolerance",
            &format!(" {}", span(GOAL_TIME_NS, language)),
            language,
            "",
        ),
    ];
    document(fields, language)
}

/// The head of a YAML file: comments.
pub(super) fn head(program: &Program<'_>, of_the_message: &[String]) -> String {
    let comment = |line: &String| format!("# {}\n", printable(line));
    let said: String = program.header.iter().chain(of_the_message).map(comment).collect();
    format!("{said}{SPEED_SHARE}{}\n", float(program.speed_share))
}

fn trajectory_fields(message: &Message, language: Language, indent: &str) -> Vec<String> {
    let names = message.joint_names.iter().map(|name| quoted(name));
    let points = message.points.iter().map(|p| point(p, language));
    vec![
        field("joint_names", &format!(" {}", row(names)), language, indent),
        field("points", &list(points, language, indent), language, indent),
    ]
}

fn point(point: &MessagePoint, language: Language) -> String {
    let numbers = |all: &JointVector| row(all.iter().copied().map(float));
    flow(
        [
            ("positions", numbers(&point.q_rad)),
            ("velocities", numbers(&point.qd_rad_s)),
            ("time_from_start", span(point.time_ns, language)),
        ],
        language,
    )
}

fn tolerance(name: &str, position_rad: f64, language: Language) -> String {
    flow([("name", quoted(name)), ("position", float(position_rad))], language)
}

fn span(time_ns: i64, language: Language) -> String {
    let numbers = [("sec", time_ns / NS_PER_S), ("nanosec", time_ns % NS_PER_S)];
    flow(numbers.map(|(name, value)| (name, value.to_string())), language)
}

fn key(name: &str, language: Language) -> String {
    match language {
        Language::Yaml => format!("{name}:"),
        Language::Json => format!("\"{name}\":"),
    }
}

/// `key: value`, where the value begins with what stands between.
fn field(name: &str, value: &str, language: Language, indent: &str) -> String {
    let more = if language == Language::Json { "  " } else { "" };
    format!("{more}{indent}{}{value}", key(name, language))
}

/// A table within a line.
fn flow<const N: usize>(fields: [(&str, String); N], language: Language) -> String {
    let fields = fields.map(|(name, value)| format!("{} {value}", key(name, language)));
    format!("{{{}}}", fields.join(", "))
}

/// A list within a line.
fn row(values: impl Iterator<Item = String>) -> String {
    format!("[{}]", values.collect::<Vec<_>>().join(", "))
}

/// A list with a line for each entry.
fn list(entries: impl Iterator<Item = String>, language: Language, indent: &str) -> String {
    let entries: Vec<String> = entries.collect();
    match language {
        _ if entries.is_empty() => " []".to_owned(),
        Language::Yaml => entries.iter().map(|entry| format!("\n{indent}- {entry}")).collect(),
        Language::Json => {
            let lines: Vec<String> = entries.iter().map(|entry| format!("\n    {indent}{entry}")).collect();
            format!(" [{}\n  {indent}]", lines.join(","))
        }
    }
}

/// A table with a line for each field, inside another one.
fn block(fields: Vec<String>, language: Language, indent: &str) -> String {
    match language {
        Language::Yaml => format!("\n{}", fields.join("\n")),
        Language::Json => format!(" {{\n{}\n{indent}}}", fields.join(",\n")),
    }
}

fn document(fields: Vec<String>, language: Language) -> String {
    match language {
        Language::Yaml => format!("{}\n", fields.join("\n")),
        Language::Json => format!("{{\n{}\n}}\n", fields.join(",\n")),
    }
}
