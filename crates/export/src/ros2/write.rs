//! The messages as YAML and JSON, a point a line.

use super::language::Language;
use super::message::{Message, MessagePoint, Span, Tolerance, Tolerances};
use super::number::{float, quoted};
use crate::program::Program;
use platewash_workcell::words::printable;

/// Before the share of the speed in the head of a YAML file.
pub(super) const SPEED_SHARE: &str = "# speed_share: ";

/// A `trajectory_msgs/JointTrajectory`.
pub(super) fn trajectory(message: &Message, language: Language) -> String {
    let fields = trajectory_fields(message, language, "");
    document(fields, language)
}

/// A `control_msgs/action/FollowJointTrajectory` goal.
pub(super) fn goal(message: &Message, tolerances: &Tolerances, language: Language) -> String {
    let inner = block(trajectory_fields(message, language, "  "), language, "  ");
    let each = |all: &[Tolerance]| list(all.iter().map(|t| tolerance(t, language)), language, "");
    let fields = vec![
        field("trajectory", &inner, language, ""),
        field("path_tolerance", &each(&tolerances.path.value), language, ""),
        field("goal_tolerance", &each(&tolerances.goal.value), language, ""),
        field(
            "goal_time_tolerance",
            &format!(" {}", span(&tolerances.goal_time, language)),
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
    let names = message.joint_names.value.iter().map(|name| quoted(&name.value));
    let points = message.points.value.iter().map(|p| point(p, language));
    vec![
        field("joint_names", &format!(" {}", row(names)), language, indent),
        field("points", &list(points, language, indent), language, indent),
    ]
}

fn point(point: &MessagePoint, language: Language) -> String {
    let numbers = |all: &[f64]| row(all.iter().copied().map(float));
    flow(
        [
            ("positions", numbers(&point.positions.value)),
            ("velocities", numbers(&point.velocities.value)),
            ("time_from_start", span(&point.time_from_start, language)),
        ],
        language,
    )
}

fn tolerance(tolerance: &Tolerance, language: Language) -> String {
    flow(
        [
            ("name", quoted(&tolerance.name.value)),
            ("position", float(tolerance.position.value)),
        ],
        language,
    )
}

fn span(span: &Span, language: Language) -> String {
    let numbers = [("sec", span.sec.value), ("nanosec", span.nanosec.value)];
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
