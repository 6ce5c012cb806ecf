//! The messages as YAML and JSON, a point a line.
//!
//! The script that sends a goal: always the same, it says nothing of a plan.

use crate::dialect::start_within::START_WITHIN_DEG;
use crate::program::{Program, ProgramFile};
use crate::ros2::message::{GOAL_RAD, GOAL_TIME_NS, Message, MessagePoint};
use crate::ros2::number::{float, quoted};
use platewash_kinematics::{AXES, JointVector};
use platewash_motion_proof::message::{Fault, Language, NS_PER_S};
use platewash_workcell::words::printable;

/// Text before the share of the speed in the head of a YAML file.
pub(crate) const SPEED_SHARE: &str = "# speed_share: ";

/// A `trajectory_msgs/JointTrajectory`.
pub(crate) fn trajectory(message: &Message, language: Language) -> String {
    let fields = trajectory_fields(message, language, "");
    document(fields, language)
}

/// A `control_msgs/action/FollowJointTrajectory` goal.
pub(crate) fn goal(message: &Message, language: Language) -> String {
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
pub(crate) fn head(program: &Program<'_>, of_the_message: &[String]) -> String {
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

/// Writes `key: value`, where the value begins with the text between.
fn field(name: &str, value: &str, language: Language, indent: &str) -> String {
    let more = if language == Language::Json { "  " } else { "" };
    format!("{more}{indent}{}{value}", key(name, language))
}

/// A table within a line.
fn flow<const N: usize>(fields: [(&str, String); N], language: Language) -> String {
    let fields = fields.map(|(name, value)| format!("{} {value}", key(name, language)));
    format!("{{{}}}", fields.join(", "))
}

/// Formats numbers as a list on one line.
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

/// File name of the script that sends a goal.
pub(crate) const NAME: &str = "play.py";

/// Text of the script that sends a goal, for plans that start at home.
const TEXT: &str = include_str!("play.py");

/// Text of the script that sends a goal, where the arm stands at most so far from its start \[°\].
pub(crate) fn script(within_deg: f64) -> String {
    let [at_home, _] = START_WITHIN_DEG;
    let [before, after] =
        [at_home, within_deg].map(|deg| (format!("MOST_DEG = {deg}"), format!("more than {deg} degrees")));
    TEXT.replace(&before.0, &after.0).replace(&before.1, &after.1)
}

/// Checks that a file is the script, by its name.
pub(crate) fn is_script(file: &ProgramFile) -> bool {
    file.name == NAME
}

/// Refuses a script that is not the one that belongs to the goals, and returns the largest distance from the start that it allows \[°\].
pub(crate) fn check(file: &ProgramFile) -> Result<f64, Fault> {
    let is_written = |within_deg: &f64| file.text == script(*within_deg);
    if let Some(within_deg) = START_WITHIN_DEG.into_iter().find(is_written) {
        return Ok(within_deg);
    }
    let same = |within_deg| {
        let expected = script(within_deg);
        let both = file.text.lines().zip(expected.lines());
        both.take_while(|(found, expected)| found == expected).count()
    };
    // The one that the text is like for longer is the one that was exported.
    let line = START_WITHIN_DEG.into_iter().map(same).max().unwrap_or(0) + 1;
    let reason = "expected the player as this version writes it; found another line: nothing is known of what it sends";
    Fault::err(line, reason)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ros2::times::{LEAD_IN_NS, LEAD_IN_S, nanoseconds, seconds_between};
    use proptest::prelude::*;

    #[test]
    fn the_first_point_is_after_the_lead_in() {
        assert_eq!(nanoseconds([0.0, 1.25].into_iter()), [500_000_000, 1_750_000_000]);
        assert_eq!(LEAD_IN_NS as f64 / NS_PER_S as f64, LEAD_IN_S);
    }

    #[test]
    fn keeps_times_apart_that_round_to_the_same_nanosecond() {
        assert_eq!(
            nanoseconds([0.0, 1e-10, 2e-10].into_iter()),
            [500_000_000, 500_000_001, 500_000_002]
        );
        // Huge times saturate; reading refuses the result.
        assert_eq!(
            nanoseconds([f64::INFINITY, f64::INFINITY].into_iter()),
            [i64::MAX, i64::MAX]
        );
    }

    proptest! {
        #[test]
        fn written_times_increase_and_are_within_a_nanosecond(steps in prop::collection::vec(2e-9..1.0_f64, 1..50)) {
            let times: Vec<f64> = steps.iter().scan(0.0, |t, step| { *t += step; Some(*t) }).collect();
            let all = nanoseconds(times.iter().copied());
            prop_assert!(all.windows(2).all(|pair| pair[0] < pair[1]));
            for (t_s, ns) in times.iter().zip(&all) {
                let read = seconds_between(i128::from(LEAD_IN_NS), i128::from(*ns));
                prop_assert!((read - t_s).abs() <= 1e-9, "{} {}", t_s, read);
            }
        }
    }
}
