//! Every number and every name of a trajectory's file is used, named or refused, or it is on the list of what cannot matter.

use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::FixedJoints;
use platewash_motion_proof::{PointMotion, TrajectoryFile};

/// Keys whose numbers change nothing of the positions that are asked of the joints: docs/prove-motion.md lists them.
const CANNOT_MATTER: [&str; 8] = [
    "frame_id",
    "seq",
    "effort",
    "position",
    "velocity",
    "goal_time_tolerance",
    "segment",
    "plate",
];

fn outcome(name: &str, text: &str) -> Result<PointMotion, String> {
    let arm = RobotModel::irb120().unwrap();
    let file = TrajectoryFile::read(name, text, &arm, &FixedJoints::new()).map_err(|error| error.to_string())?;
    file.motion(&arm, None).map_err(|error| error.to_string())
}

/// Ranges of the numbers of a text that are no part of a name.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let bytes = text.as_bytes();
    let is_part = |byte: u8| byte.is_ascii_digit() || byte == b'.';
    let mut found = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        let begins = bytes[at].is_ascii_digit()
            && (at == 0 || !(bytes[at - 1].is_ascii_alphanumeric() || bytes[at - 1] == b'_'));
        let end = at + bytes[at..].iter().take_while(|byte| is_part(**byte)).count();
        if begins {
            found.push((at, end));
        }
        at = end.max(at + 1);
    }
    found
}

/// Key that a place of a YAML or JSON text belongs to: the last word before it that a colon follows.
fn key(text: &str, at: usize) -> String {
    let before = &text[..at];
    let colon = before.rfind(':').unwrap_or(0);
    let word: String = before[..colon]
        .chars()
        .rev()
        .skip_while(|c| *c == '"')
        .take_while(|c| c.is_alphanumeric() || *c == '_')
        .collect();
    word.chars().rev().collect()
}

/// Changes each number and checks that the motion, its notes or the error tell so. `key` names what a place belongs to.
fn every_number_counts(name: &str, text: &str, key: impl Fn(&str, usize) -> String) {
    let plain = outcome(name, text).unwrap();
    let mut changed = 0;
    for (from, to) in numbers(text) {
        let number: f64 = text[from..to].parse().unwrap();
        let other = if text[from..to].contains('.') {
            format!("{:?}", number + 0.125)
        } else {
            format!("{}", number as i64 + 1)
        };
        let edited = format!("{}{other}{}", &text[..from], &text[to..]);
        let key = key(text, from);
        let same = outcome(name, &edited) == Ok(plain.clone());
        assert!(
            !same || CANNOT_MATTER.contains(&&*key),
            "{name}: {key}: {} → {other} changes nothing",
            &text[from..to]
        );
        changed += usize::from(!same);
    }
    assert!(changed > 30, "{name}: {changed}");
}

const MESSAGE: &str = r#"header:
  stamp: {sec: 0, nanosec: 0}
  frame_id: "base_link"
joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]
points:
- positions: [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
  velocities: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
  accelerations: [0.5, 0.0, 0.0, 0.0, 0.0, 0.0]
  effort: []
  time_from_start: {sec: 0, nanosec: 1000}
- positions: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
  velocities: [0.25, 0.0, 0.0, 0.0, 0.0, 0.0]
  accelerations: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
  effort: [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]
  time_from_start: {sec: 1, nanosec: 1000}
"#;

const GOAL: &str = r#"{"trajectory": {"header": {"seq": 3, "stamp": {"secs": 0, "nsecs": 0}, "frame_id": "7"},
  "joint_names": ["joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6"],
  "points": [
    {"positions": [0.0, 0.1, 0.2, 0.3, 0.4, 0.5], "velocities": [0.0, 0.0, 0.0, 0.0, 0.0, 0.0], "accelerations": [],
     "effort": [], "time_from_start": {"secs": 0, "nsecs": 0}},
    {"positions": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], "velocities": [0.5, 0.0, 0.0, 0.0, 0.0, 0.0], "accelerations": [],
     "effort": [], "time_from_start": {"secs": 2, "nsecs": 500}},
    {"positions": [0.2, 0.2, 0.3, 0.4, 0.5, 0.6], "velocities": [0.0, 0.0, 0.0, 0.0, 0.0, 0.0], "accelerations": [],
     "effort": [], "time_from_start": {"secs": 4, "nsecs": 500}}]},
 "path_tolerance": [{"name": "joint_1", "position": 0.1, "velocity": 0.2, "acceleration": 0.0}],
 "goal_tolerance": [], "goal_time_tolerance": {"secs": 1, "nsecs": 0}}"#;

const DISPLAY: &str = r#"model_id: "irb120"
trajectory:
- joint_trajectory:
    joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]
    points:
    - positions: [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
      velocities: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    - positions: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
      velocities: [0.5, 0.0, 0.0, 0.0, 0.0, 0.0]
      time_from_start: {sec: 1}
    - positions: [0.2, 0.2, 0.3, 0.4, 0.5, 0.6]
      time_from_start: {sec: 2, nanosec: 7}
trajectory_start:
  joint_state:
    header: {seq: 5, frame_id: "world"}
    name: [joint_1, joint_2]
    position: [0.0, 0.1]
    velocity: [0.5, 0.5]
    effort: [2.0, 2.0]
  multi_dof_joint_state:
    joint_names: ["virtual_joint"]
    transforms: [{translation: {x: 0.0, y: 0.0, z: 0.0}, rotation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}}]
  is_diff: false
"#;

fn table() -> String {
    let head: Vec<String> = ["t_s".to_owned(), "segment".to_owned(), "plate".to_owned()]
        .into_iter()
        .chain((1..7).map(|k| format!("q{k}_rad")))
        .chain((1..7).map(|k| format!("qd{k}_rad_s")))
        .chain((1..7).map(|k| format!("qdd{k}_rad_s2")))
        .collect();
    let row = |t: f64| {
        let cells = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6].map(|q: f64| format!("{:?}", q + 0.1 * t));
        let rates = ["0.5,0.25,0.5,0.25,0.5,0.25"; 2];
        format!("{t:?},1,1,{},{}\n", cells.join(","), rates.join(","))
    };
    format!("{}\n{}{}{}", head.join(","), row(0.5), row(1.5), row(2.5))
}

#[test]
fn every_number_of_a_message_counts_or_cannot_matter() {
    every_number_counts("a.yaml", MESSAGE, key);
    let in_tolerance = |text: &str, at: usize| match text[..at].rfind("\"goal_time_tolerance\"") {
        Some(_) => "goal_time_tolerance".to_owned(),
        None => match key(text, at) {
            other if other == "acceleration" => "position".to_owned(),
            other => other,
        },
    };
    every_number_counts("a.json", GOAL, in_tolerance);
    let of_start = |text: &str, at: usize| match key(text, at) {
        other if other == "position" => "position of the start".to_owned(),
        other => other,
    };
    every_number_counts("a.yaml", DISPLAY, of_start);
}

#[test]
fn every_number_of_a_table_counts_or_cannot_matter() {
    let text = table();
    let head: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    let column = |text: &str, at: usize| {
        let line = text[..at].rfind('\n').map_or(0, |k| k + 1);
        head[text[line..at].matches(',').count()].to_owned()
    };
    every_number_counts("a.csv", &text, column);
}

/// A key or a column with another name is refused, or what it stood for is missing.
#[test]
fn every_name_counts() {
    for (name, text) in [
        ("a.yaml", MESSAGE.to_owned()),
        ("a.json", GOAL.to_owned()),
        ("a.yaml", DISPLAY.to_owned()),
        ("a.csv", table()),
    ] {
        let plain = outcome(name, &text).unwrap();
        let mut at = 0;
        while let Some(found) = text[at..].find(|c: char| c.is_ascii_alphabetic()) {
            let from = at + found;
            let to = from
                + text[from..]
                    .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
                    .unwrap_or(text.len() - from);
            at = to;
            let edited = format!("{}x{}", &text[..to], &text[to..]);
            let word = &text[from..to];
            // Tolerances are not read.
            let is_in_tolerance = text[..from].contains("\"path_tolerance\"") && !word.ends_with("_tolerance");
            let is_name = ["base_link", "irb120", "world", "virtual_joint"].contains(&word);
            let is_value = is_name || word == "false" || is_in_tolerance;
            assert!(
                is_value || outcome(name, &edited) != Ok(plain.clone()),
                "{name}: {word}"
            );
        }
    }
}
