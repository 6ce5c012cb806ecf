//! A plan as ROS 2 messages, read back: knots, times, bytes, several files as one program.

use platewash_certificate::{Certified, certify};
use platewash_export::dialect::Dialect;
use platewash_export::dialects::by_name;
use platewash_export::program::{Point, Program, ProgramFile};
use platewash_export::reading::{Reading, SegmentShape};
use platewash_export::ros2::times::LEAD_IN_S;
use platewash_export::{ExportSettings, Joint3, ProgramComparison, compare, export};
use platewash_fixtures as fixtures;
use platewash_kinematics::RobotModel;
use platewash_motion::plan::Plan;
use platewash_workcell::cancel::CancelToken;
use proptest::prelude::*;
use std::sync::LazyLock;

const FILES: [&str; 5] = [
    "joint_trajectory.yaml",
    "joint_trajectory.json",
    "follow_joint_trajectory.yaml",
    "follow_joint_trajectory.json",
    "play.py",
];

static KITCHEN: LazyLock<(RobotModel, Plan)> = LazyLock::new(|| {
    let plan = platewash_planner::plan(&fixtures::kitchen()).unwrap().plan;
    (RobotModel::irb120().unwrap(), plan)
});

fn ros2() -> &'static dyn Dialect {
    by_name("ros2").unwrap()
}

/// The kitchen's plan as a program with all its knots.
fn program(speed_share: f64) -> Program<'static> {
    let (arm, plan) = &*KITCHEN;
    let knots = &plan.knots;
    let point = |k: usize| Point {
        t_s: knots.t_s[k],
        q_rad: knots.q_rad[k],
        qd_rad_s: knots.qd_rad_s[k],
        rests: false,
        segment: 0,
    };
    Program {
        name: "kitchen".to_owned(),
        plan,
        arm,
        points: (0..knots.t_s.len()).map(point).collect(),
        speed_share,
        joint_3: Joint3::Independent,
        corner_m: 0.005,
        header: vec!["a plan's head: \u{202e}with\nanything".to_owned()],
    }
}

fn read(files: &[ProgramFile]) -> Reading {
    ros2().read(files, &KITCHEN.0).unwrap()
}

/// Refuses a reading that is not the program, at this share of the speed, whatever share it states.
fn assert_says(reading: &Reading, speed_share: f64) {
    let knots = &KITCHEN.1.knots;
    assert_eq!(reading.interpolation, SegmentShape::Cubics);
    assert_eq!(reading.points.len(), knots.t_s.len());
    let mut lines = Vec::new();
    for (k, point) in reading.points.iter().enumerate() {
        assert!(
            (point.t_s - knots.t_s[k] / speed_share).abs() <= 1e-9,
            "time of knot {k}"
        );
        assert_eq!(point.q_rad, knots.q_rad[k], "knot {k}");
        assert_eq!(point.qd_rad_s.unwrap(), knots.qd_rad_s[k] * speed_share, "knot {k}");
        lines.push(point.place.line);
    }
    assert!(lines.windows(2).all(|pair| pair[1] == pair[0] + 1), "a point a line");
}

#[test]
fn each_file_states_the_plan_to_the_bit_and_times_to_a_nanosecond() {
    for speed_share in [1.0, 0.5, 0.1] {
        let files = ros2().write(&program(speed_share));
        assert_eq!(files.iter().map(|file| file.name.as_str()).collect::<Vec<_>>(), FILES);
        assert_says(&read(&files), speed_share);
        assert_eq!(read(&files).speed_share, Some(speed_share));
        for file in &files[..4] {
            assert!(ros2().is_in(file), "{}", file.name);
            let reading = read(std::slice::from_ref(file));
            assert_says(&reading, speed_share);
            let states_it = file.name.ends_with(".yaml");
            assert_eq!(reading.speed_share, states_it.then_some(speed_share));
            assert_eq!(reading.points[7].place.file, file.name);
            assert!(!file.text.contains("-0.0,") && file.text.ends_with('\n') && !file.text.contains('\r'));
        }
    }
}

#[test]
fn the_same_program_gives_the_same_bytes() {
    assert_eq!(ros2().write(&program(0.7)), ros2().write(&program(0.7)));
    assert_ne!(ros2().write(&program(0.7)), ros2().write(&program(0.8)));
}

#[test]
fn the_first_point_is_after_the_lead_in_and_lines_name_it() {
    let files = ros2().write(&program(1.0));
    for file in &files[..4] {
        let reading = read(std::slice::from_ref(file));
        let line = file.text.lines().nth(reading.points[0].place.line - 1).unwrap();
        let nanoseconds = (LEAD_IN_S * 1e9) as i64;
        let expected = [
            format!("sec: 0, nanosec: {nanoseconds}"),
            format!("\"sec\": 0, \"nanosec\": {nanoseconds}"),
        ];
        assert!(expected.iter().any(|time| line.contains(time)), "{line}");
        assert_eq!(reading.points[0].t_s, 0.0);
    }
}

#[test]
fn headers_stay_comments() {
    let files = ros2().write(&program(1.0));
    let first = files[0].text.lines().next().unwrap();
    assert_eq!(first, "# a plan's head: \\u{202e}with\\nanything");
    for file in files.iter().filter(|file| file.name.ends_with(".json")) {
        serde_json::from_str::<serde_json::Value>(&file.text).unwrap();
    }
}

/// A file with one line changed; the line's number.
fn edited(file: &ProgramFile, from: &str, to: &str) -> (ProgramFile, usize) {
    let at = file.text.find(from).unwrap();
    let line = file.text[..at].lines().count() + usize::from(file.text[..at].ends_with('\n'));
    let text = file.text.replacen(from, to, 1);
    assert_ne!(text, file.text);
    let name = file.name.clone();
    (ProgramFile { name, text }, line)
}

#[test]
fn rejects_files_that_contradict_each_other() {
    let files = ros2().write(&program(1.0));
    let point = files[3].text.lines().nth(200).unwrap().to_owned();
    let digits = point
        .split_once("\"positions\": [")
        .unwrap()
        .1
        .split_once(',')
        .unwrap()
        .0;
    let (json, line) = edited(&files[3], digits, "0.123");
    let all = [files[..3].to_vec(), vec![json, files[4].clone()]].concat();
    let error = ros2().read(&all, &KITCHEN.0).err().unwrap();
    assert_eq!(
        (error.place.file.as_str(), error.place.line),
        ("follow_joint_trajectory.json", line)
    );
    assert!(error.reason.contains("joint_trajectory.yaml"), "{error}");

    let (player, line) = edited(&files[4], "MOST_DEG = 0.5", "MOST_DEG = 50.0");
    let error = ros2().read(&[files[0].clone(), player], &KITCHEN.0).err().unwrap();
    assert_eq!((error.place.file.as_str(), error.place.line), ("play.py", line));
}

#[test]
fn finds_a_changed_digit_in_its_line() {
    let files = ros2().write(&program(1.0));
    let before = read(&files[..1]);
    let k = 1234;
    let line = before.points[k].place.line;
    let text = files[0].text.lines().nth(line - 1).unwrap();
    let changed = text.replacen("nanosec: ", "nanosec: 1", 1);
    if let Ok(after) = ros2().read(&[edited(&files[0], text, &changed).0], &KITCHEN.0) {
        assert_ne!(before.points[k].t_s, after.points[k].t_s);
    }
    let digit = text.find("[").unwrap() + 4;
    let other = if &text[digit..=digit] == "5" { "6" } else { "5" };
    let changed = format!("{}{other}{}", &text[..digit], &text[digit + 1..]);
    let after = read(&[edited(&files[0], text, &changed).0]);
    for (i, (a, b)) in before.points.iter().zip(&after.points).enumerate() {
        assert_eq!(a == b, i != k, "point {i}");
    }
    assert_eq!(after.points[k].place.line, line);
}

#[test]
fn another_order_of_the_joints_is_the_same_program() {
    let text = |names: [usize; 6]| {
        let names: Vec<String> = names.iter().map(|j| format!("joint_{}", j + 1)).collect();
        let row = |scale: f64| {
            let numbers: Vec<String> = names
                .iter()
                .map(|name| format!("{:?}", scale * name[6..].parse::<f64>().unwrap()))
                .collect();
            numbers.join(", ")
        };
        let point = |q: f64, qd: f64, sec: u32| {
            format!(
                "- {{positions: [{}], velocities: [{}], time_from_start: {{sec: {sec}, nanosec: 0}}}}\n",
                row(q),
                row(qd)
            )
        };
        let points = [point(0.01, 0.0, 1), point(0.02, 0.1, 2), point(0.03, 0.0, 3)].concat();
        format!("joint_names: [{}]\npoints:\n{points}", names.join(", "))
    };
    let reading = |text: String| {
        read(&[ProgramFile {
            name: "a.yaml".to_owned(),
            text,
        }])
    };
    let expected = reading(text([0, 1, 2, 3, 4, 5]));
    assert_eq!(reading(text([5, 3, 1, 0, 2, 4])), expected);
    assert!((expected.points[1].q_rad[2] - 0.06).abs() < 1e-12);
}

/// What came of one file of a plan that was handed over at 0.3 of its speed, with a part of a line changed.
fn compared(name: &str, line: usize, from: &str, to: &str) -> ProgramComparison {
    static CERTIFIED: LazyLock<Certified<Plan>> = LazyLock::new(|| certify(KITCHEN.1.clone(), &KITCHEN.0).unwrap());
    static FILES: LazyLock<Vec<ProgramFile>> = LazyLock::new(|| {
        let settings = ExportSettings {
            speed_share: 0.3,
            ..ExportSettings::default()
        };
        export(&CERTIFIED, &KITCHEN.0, ros2(), &settings, &CancelToken::new())
            .unwrap()
            .files
    });
    let file = FILES.iter().find(|file| file.name == name).unwrap();
    let text: Vec<_> = file
        .text
        .lines()
        .enumerate()
        .map(|(k, text)| {
            if k + 1 == line {
                text.replacen(from, to, 1)
            } else {
                text.to_owned()
            }
        })
        .collect();
    let text = format!("{}\n", text.join("\n"));
    assert_eq!(text == file.text, from == to);
    compare(
        &CERTIFIED,
        &KITCHEN.0,
        &[ProgramFile {
            name: name.to_owned(),
            text,
        }],
        &CancelToken::new(),
    )
    .unwrap()
}

#[test]
fn judges_a_single_file_and_reports_its_changes() {
    let name = "joint_trajectory.json";
    let whole = compared(name, 1, "", "");
    assert!(whole.is_unchanged() && whole.judgement.holds(), "{:?}", whole.changes);
    let last = KITCHEN.1.knots.t_s.len() + 3;
    // The end a second later: slower, and still on the path.
    for (line, from, to, what) in [
        (last, "\"sec\": 142", "\"sec\": 143", "time"),
        (5, "\"positions\": [-0.0006", "\"positions\": [-0.0007", "joint 1"),
    ] {
        let edited = compared(name, line, from, to);
        assert_eq!(edited.changes.len() + edited.more_changes, 1, "{:?}", edited.changes);
        let change = &edited.changes[0];
        assert_eq!(
            (change.place.as_str(), change.what.as_str()),
            (format!("{name}:{line}").as_str(), what)
        );
    }
}

proptest! {
    #[test]
    fn damaged_files_are_read_or_refused(
        which in 0_usize..5,
        at in 0.0..1.0_f64,
        length in 0_usize..40,
        by in "[-\\[\\]{}:,&*!|>'\"%@` #0-9.eE\n\t\\PC]{0,12}",
        lines in 3_usize..40,
    ) {
        let mut short = program(1.0);
        short.points.truncate(lines);
        let file = ros2().write(&short).remove(which);
        let from = (0..file.text.len()).rev().find(|&i| i <= (at * file.text.len() as f64) as usize && file.text.is_char_boundary(i)).unwrap_or(0);
        let to = (from + length).min(file.text.len());
        prop_assume!(file.text.is_char_boundary(to));
        let text = format!("{}{by}{}", &file.text[..from], &file.text[to..]);
        let _ = ros2().read(&[ProgramFile { name: file.name, text }], &KITCHEN.0);
    }
}
