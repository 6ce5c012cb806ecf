//! Messages that are refused, with the rule and the line: one for each rule, and texts that are no message.

use platewash_export::dialect::ReadError;
use platewash_export::dialects::by_name;
use platewash_export::program::ProgramFile;
use platewash_export::reading::Reading;
use platewash_kinematics::RobotModel;
use std::time::Instant;

/// A goal that is accepted, a row a line.
const GOAL: &str = "\
trajectory:
  header: {stamp: {sec: 0, nanosec: 0}, frame_id: ''}
  joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]
  points:
  - positions: [0.0, 0.1, 0.2, 0.3, 0.4, 0.5]
    velocities: [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    time_from_start: {sec: 0, nanosec: 500000000}
  - positions: [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    velocities: [0.1, 0.2, 0.1, 0.1, 0.1, 0.1]
    accelerations: []
    effort: []
    time_from_start: {sec: 1, nanosec: 250000000}
  - positions: [0.2, 0.3, 0.4, 0.5, 0.6, 0.7]
    velocities: [0.0, 0.0, 0.0, 0.0, 0.0, 1.0e-7]
    time_from_start: {sec: 2, nanosec: 0}
path_tolerance:
- {name: joint_1, position: 0.1}
- {name: joint_2, position: 0.1, velocity: 0.0}
- {name: joint_3, position: -1.0}
- {name: joint_4, position: 0.1}
- {name: joint_5, position: 0.1}
- {name: joint_6, position: 0.1}
goal_tolerance:
- {name: joint_1, position: 0.01}
- {name: joint_2, position: 0.01}
- {name: joint_3, position: 0.01}
- {name: joint_4, position: 0.01}
- {name: joint_5, position: 0.01}
- {name: joint_6, position: 0.01}
goal_time_tolerance: {sec: 1, nanosec: 0}
";

fn read_as(name: &str, text: &str) -> Result<Reading, ReadError> {
    let file = ProgramFile {
        name: name.to_owned(),
        text: text.to_owned(),
    };
    by_name("ros2").unwrap().read(&[file], &RobotModel::irb120().unwrap())
}

fn read(text: &str) -> Result<Reading, ReadError> {
    read_as("goal.yaml", text)
}

/// The goal with a part of one line replaced.
fn with(line: usize, from: &str, to: &str) -> String {
    let edit = |(k, text): (usize, &str)| match k + 1 == line {
        true => {
            assert!(text.contains(from), "line {line} has no {from}: {text}");
            format!("{}\n", text.replacen(from, to, 1))
        }
        false => format!("{text}\n"),
    };
    let edited: String = GOAL.lines().enumerate().map(edit).collect();
    assert_ne!(edited, GOAL);
    edited
}

#[test]
fn accepts_the_goal_that_these_tests_edit() {
    let reading = read(GOAL).unwrap();
    assert_eq!(
        reading.points.iter().map(|p| p.place.line).collect::<Vec<_>>(),
        [5, 8, 13]
    );
    assert_eq!(
        reading.points.iter().map(|p| p.t_s).collect::<Vec<_>>(),
        [0.0, 0.75, 1.5]
    );
}

#[test]
fn every_rule_names_itself_and_the_line_that_breaks_it() {
    let first_row = "[0.0, 0.1, 0.2, 0.3, 0.4, 0.5]";
    let breaches = [
        ("joint-count", 3, ", joint_6]", "]", "without joint_6"),
        ("joint-name", 3, "joint_6]", "joint_7]", "found \"joint_7\""),
        ("joint-name", 3, "joint_6]", "joint_6, joint_7]", "found \"joint_7\""),
        ("joint-twice", 3, "joint_6]", "joint_1]", "found \"joint_1\" again"),
        ("stamp", 2, "sec: 0", "sec: 5", "header.stamp"),
        ("duration", 7, "sec: 0", "sec: -1", "found -1"),
        ("duration", 15, "sec: 2", "sec: 2147483648", "found 2147483648"),
        ("duration", 12, "250000000", "1000000000", "found 1000000000"),
        ("duration", 12, "250000000", "-1", "found -1"),
        ("lead-in", 7, "500000000", "0", "found 0.000000000 s"),
        ("lead-in", 7, "500000000", "499999999", "0.5 s or later"),
        (
            "time-order",
            12,
            "{sec: 1, nanosec: 250000000}",
            "{sec: 0, nanosec: 500000000}",
            "after 0.500000000 s",
        ),
        ("time-order", 15, "sec: 2", "sec: 1", "after 1.250000000 s"),
        ("positions", 5, first_row, "[0.0, 0.1, 0.2, 0.3, 0.4]", "found 5"),
        ("positions", 5, first_row, "[]", "found 0"),
        ("velocities", 9, "[0.1, 0.2,", "[0.1, 0.2, 0.3,", "found 7"),
        ("velocities", 9, "[0.1, 0.2, 0.1, 0.1, 0.1, 0.1]", "[]", "found 0"),
        ("accelerations", 10, "[]", "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]", "found 6"),
        ("effort", 11, "[]", "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]", "found 6"),
        ("start-speed", 6, "[0.0", "[0.01", "found 0.01 rad/s"),
        ("end-speed", 14, "1.0e-7", "1.3e-7", "found 0.00000013 rad/s"),
        ("end-speed", 14, "[0.0", "[-0.2", "found -0.2 rad/s"),
        ("tolerance", 17, "joint_1", "joint_9", "found \"joint_9\""),
        ("tolerance", 18, "joint_2", "joint_1", "found \"joint_1\" again"),
        ("tolerance", 24, "0.01", "-0.5", "found -0.5"),
    ];
    for (rule, line, from, to, found) in breaches {
        let error = read(&with(line, from, to)).unwrap_err();
        assert_eq!(
            (error.place.file.as_str(), error.place.line),
            ("goal.yaml", line),
            "{error}"
        );
        let code = format!("(rule {} of ", rule);
        assert!(error.reason.contains(&code) && error.reason.contains(found), "{error}");
    }
    // Lines that are taken away.
    for (rule, lines, line) in [
        ("points", 5..=15, 4),
        ("tolerance", 18..=18, 17),
        ("velocities", 6..=6, 5),
    ] {
        let kept = GOAL.lines().enumerate().filter(|(k, _)| !lines.contains(&(k + 1)));
        let text: String = kept.map(|(_, text)| format!("{text}\n")).collect();
        let text = text.replace("  points:\npath", "  points: []\npath");
        let error = read(&text).unwrap_err();
        assert_eq!(error.place.line, line, "{error}");
        assert!(error.reason.contains(&format!("(rule {} of ", rule)), "{error}");
    }
}

#[test]
fn rejects_values_of_other_types() {
    let cases = [
        (5, "0.1,", "1,", "write 1.0"),
        (5, "0.1,", "1e-05,", "a text in YAML 1.1"),
        (5, "0.1,", ".nan,", "found .nan"),
        (5, "0.1,", ".inf,", "found .inf"),
        (5, "0.1,", "NaN,", "found NaN"),
        (5, "0.1,", "1.0e+999,", "found 1.0e+999"),
        (5, "0.1,", "'0.1',", "found the text \"0.1\""),
        (5, "0.1,", "~,", "found ~"),
        (5, "0.1,", ",", "not YAML"),
        (5, "0.1,", "[0.1],", "found a list"),
        (5, "[0.0, 0.1, 0.2, 0.3, 0.4, 0.5]", "0.0", "expected a list"),
        (7, "sec: 0", "sec: 0.5", "expected a whole number"),
        (7, "sec: 0", "sec: 00", "expected a whole number"),
        (7, "sec: 0", "sec: 99999999999999999999", "expected a whole number"),
        (7, "sec: 0", "secs: 0", "found the key \"secs\""),
        (7, "sec: 0, ", "", "with sec; it is missing"),
        (7, "{sec: 0, nanosec: 500000000}", "0.5", "expected a Duration"),
        (3, "joint_1", "yes", "expected a text"),
        (3, "joint_1", "1.5", "expected a text"),
        (3, "joint_1", "!!str joint_1", "a tag"),
        (3, "joint_1", "*a", "not YAML"),
        (4, "points", "point", "found the key \"point\""),
        (1, "trajectory", "trajectory:", "expected a JointTrajectory"),
        (18, "velocity", "position", "stands twice"),
        (17, "name", "joint", "found the key \"joint\""),
        (30, "goal_time_tolerance", "goal_time", "found the key \"goal_time\""),
    ];
    for (line, from, to, found) in cases {
        let error = read(&with(line, from, to)).unwrap_err();
        assert!(error.reason.contains(found), "{to}: {error}");
        assert!(error.place.line.abs_diff(line) <= 1, "{to}: {error}");
    }
}

#[test]
fn rejects_texts_that_are_no_message() {
    let deep = "[".repeat(100_000);
    let bomb: String = (0..40)
        .map(|k| format!("a{k}: &a{k} [{}]\n", format!("*a{}, ", k - 1_i32).repeat(10)))
        .collect();
    let long = format!("joint_names: [{}]\npoints: []\n", "a, ".repeat(200_000));
    let many_keys: String = (0..100_000).map(|k| format!("k{k}: 0\n")).collect();
    let twice = format!("{GOAL}---\n{GOAL}");
    let texts = [
        ("", "found nothing"),
        ("# only a comment\n", "found nothing"),
        ("0.5\n", "expected a message"),
        ("[]\n", "expected a message"),
        ("{}\n", "with joint_names; it is missing"),
        ("points: []\n", "with joint_names; it is missing"),
        ("\u{feff}", "found nothing"),
        ("\0", ""),
        (&deep, ""),
        (&bomb, ""),
        (&long, "expected one of the arm's joints"),
        (&many_keys, "keys at most"),
        (&twice, "another one"),
    ];
    for (text, found) in texts {
        let began = Instant::now();
        let error = read(text).unwrap_err();
        assert!(error.reason.contains(found), "{error}");
        assert!(error.reason.len() < 400 && error.place.line >= 1, "{error}");
        assert!(began.elapsed() < std::time::Duration::from_secs(120), "{found}");
    }
    let huge = format!("joint_names: [{}]\n", "'a', ".repeat(8_000_000));
    assert!(read(&huge).unwrap_err().reason.contains("bytes at most"));
}

#[test]
fn long_texts_are_read_in_time() {
    for part in [
        "a\n", "a ", "a: ", "- ", "? ", "#", "'", "\"", "[a, ", "a: b\n", "- a\n", "{a: ", "  \n", "&a ", "%a\n",
        "--- a\n", "|\n", "é",
    ] {
        for before in ["", "points: [", "points: "] {
            let text = format!("{before}{}", part.repeat(4_000_000 / part.len()));
            let began = Instant::now();
            let error = read(&text).unwrap_err();
            assert!(error.reason.len() < 400, "{error}");
            assert!(
                began.elapsed().as_secs() < 120,
                "{part:?} after {before:?}: {:?}",
                began.elapsed()
            );
        }
    }
}

#[test]
fn written_json_files_are_valid_json() {
    let error = read_as("goal.json", GOAL).unwrap_err();
    assert!(error.reason.contains("not JSON") && error.place.line == 1, "{error}");
    let error = read_as("goal.json", "{\"joint_names\": [],\n \"points\": [],\n}").unwrap_err();
    assert!(error.reason.contains("not JSON") && error.place.line == 3, "{error}");
    let error = by_name("ros2")
        .unwrap()
        .read(&[], &RobotModel::irb120().unwrap())
        .unwrap_err();
    assert!(error.reason.contains("found none"), "{error}");
}

/// YAML 1.1 ends a comment at these, YAML 1.2 does not: a point behind one would be sent and not judged.
#[test]
fn rejects_text_behind_a_line_end_of_yaml_1_1() {
    for end in ['\u{85}', '\u{2028}', '\u{2029}'] {
        let hidden = format!("  points: # a note{end}  - positions: [9.0]");
        let error = read(&GOAL.replacen("  points:", &hidden, 1)).unwrap_err();
        assert_eq!(error.place.line, 4);
        assert!(error.reason.contains("YAML 1.1"), "{error}");
    }
}
