//! Trajectories of files: what is read, and what is refused with its line.

use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion_proof::{ExactTime, Interpolation, JointPoints, PointMotion, PointsError, TrajectoryFile};

fn arm() -> RobotModel {
    RobotModel::irb120().unwrap()
}

fn read(name: &str, text: &str) -> Result<TrajectoryFile, String> {
    fixed(name, text, &[])
}

fn fixed(name: &str, text: &str, fixed: &[(&str, f64)]) -> Result<TrajectoryFile, String> {
    let fixed = fixed.iter().map(|(name, at)| ((*name).to_owned(), *at)).collect();
    TrajectoryFile::read(name, text, &arm(), &fixed).map_err(|e| e.to_string())
}

fn motion(name: &str, text: &str) -> Result<PointMotion, String> {
    read(name, text)?.motion(&arm(), None).map_err(|e| e.to_string())
}

fn error(name: &str, text: &str) -> String {
    motion(name, text).unwrap_err()
}

const ZEROS: &str = "[0.0, 0.0, 0.0, 0.0, 0.0, 0.0]";

/// A message whose joints are in the reverse order, with some lines for its second point.
fn message(second: &str) -> String {
    format!(
        "joint_names: [joint_6, joint_5, joint_4, joint_3, joint_2, joint_1]\npoints:\n- positions: {ZEROS}\n  velocities: {ZEROS}\n  \
         time_from_start: {{sec: 0, nanosec: 500000000}}\n- {second}\n"
    )
}

const SECOND: &str = "positions: [0.6, 0.5, 0.4, 0.3, 0.2, 1e-1]\n  velocities: [0, 0.0, 0.0, 0.0, 0.0, 0.25]\n  time_from_start:\n    sec: 2\n    nanosec: 0";

#[test]
fn reads_messages_with_joints_by_name() {
    let expected = JointVector::new(0.1, 0.2, 0.3, 0.4, 0.5, 0.6);
    let bare = message(SECOND);
    let indented: String = bare.lines().map(|line| format!("  {line}\n")).collect();
    let robot = format!("joint_trajectory:\n{indented}multi_dof_joint_trajectory: {{joint_names: [], points: []}}\n");
    let goal = format!("trajectory:\n{indented}path_tolerance: []\ngoal_time_tolerance: {{sec: 1, nanosec: 0}}\n");
    for text in [bare.clone(), format!("{bare}---\n"), robot, goal] {
        let found = motion("a.yaml", &text).unwrap();
        assert_eq!(
            (found.interpolation(), found.start.map(ExactTime::seconds)),
            (Interpolation::Cubic, Some(0.5))
        );
        let [piece] = found.motion.pieces() else {
            panic!("{found:?}")
        };
        assert_eq!(
            (piece.t_s, piece.q_rad[1], piece.qd_rad_s[1][0]),
            ([0.0, 1.5], expected, 0.25)
        );
    }
    let json = r#"{"joint_names": ["joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6"], "points": [
        {"positions": [0, 0, 0, 0, 0, 0], "time_from_start": {"secs": 0, "nsecs": 0}},
        {"positions": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], "time_from_start": {"secs": 1, "nsecs": 0}, "effort": []}]}"#;
    let found = motion("a.json", json).unwrap();
    assert_eq!(
        (found.interpolation(), found.motion.pieces()[0].q_rad[1]),
        (Interpolation::Linear, expected)
    );
}

#[test]
fn accelerations_make_quintics() {
    let at_rest = message(SECOND).replace(
        "  time_from_start",
        "  accelerations: [0.6, 0.5, 0.4, 0.3, 0.2, -0.5]\n  time_from_start",
    );
    let found = motion("a.yaml", &at_rest).unwrap();
    assert_eq!(found.interpolation(), Interpolation::Quintic);
    let [piece] = found.motion.pieces() else {
        panic!("{found:?}")
    };
    let expected = JointVector::new(-0.5, 0.2, 0.3, 0.4, 0.5, 0.6);
    assert_eq!(piece.qdd_rad_s2, Some([expected; 2]));
    let cubic = read("a.yaml", &at_rest)
        .unwrap()
        .motion(&arm(), Some(Interpolation::Cubic))
        .unwrap();
    assert_eq!(cubic.motion.pieces()[0].qdd_rad_s2, None);
    let columns = |unit: &str| (1..=6).map(|k| format!(",joint_{k}{unit}")).collect::<String>();
    let head = ["t_s".to_owned(), columns(""), columns("_rad_s"), columns("_rad_s2")].concat();
    let row = |t: f64| format!("{t}{}\n", ",0.25".repeat(18));
    let found = motion("a.csv", &format!("{head}\n{}{}", row(0.0), row(1.0))).unwrap();
    assert_eq!(found.interpolation(), Interpolation::Quintic);
    let bare = head.replace("_rad_s2", "_rad_s");
    assert!(error("a.csv", &format!("{bare}\n{}{}", row(0.0), row(1.0))).contains("there twice"));
}

#[test]
fn reads_tables_by_column() {
    let full = "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,qd1_rad_s,qd2_rad_s,qd3_rad_s,qd4_rad_s,qd5_rad_s,qd6_rad_s\n\
                1,0,0,0,0,0,0,0,0,0,0,0,0\n2,1,0.2,0.3,0.4,0.5,0.6,0.7,0,0,0,0,0\n";
    let found = motion("a.csv", full).unwrap();
    assert_eq!(
        (
            found.interpolation(),
            found.start.map(ExactTime::seconds),
            found.motion.duration_s()
        ),
        (Interpolation::Cubic, Some(1.0), 1.0)
    );
    assert_eq!(found.motion.pieces()[0].qd_rad_s[1][0], 0.7);
    // Names of joints, in any order, without times; with a comment.
    let named = "# a path\njoint_2,joint_1,joint_3,joint_4,joint_5,joint_6\n0,0,0,0,0,0\n0.2,0.1,0.3,0.4,0.5,0.6\n0.2,0.1,0.3,0.4,0.5,0.6\n";
    let found = motion("A.CSV", named).unwrap();
    assert_eq!(
        (found.interpolation(), found.start.map(ExactTime::seconds)),
        (Interpolation::Linear, None)
    );
    let pieces = found.motion.pieces();
    assert_eq!(pieces[0].q_rad[1], JointVector::new(0.1, 0.2, 0.3, 0.4, 0.5, 0.6));
    assert_eq!((pieces.len(), pieces[1].t_s), (2, [1.0, 2.0]));
    assert_eq!(pieces[1].qd_rad_s, [JointVector::zeros(); 2]);
}

#[test]
fn refuses_messages_with_the_line() {
    let second = |from: &str, to: &str| message(&SECOND.replace(from, to));
    let cases = [
        (
            message(SECOND).replace("joint_6,", "finger,"),
            "a.yaml:1: expected the arm's joints",
            "\"finger\"",
        ),
        (
            message(SECOND).replace("joint_6, ", ""),
            "a.yaml:1:",
            "\"joint_6\" is missing",
        ),
        (
            message(SECOND).replace("joint_6", "joint_5"),
            "a.yaml:1:",
            "\"joint_5\" again",
        ),
        (second("0.6, 0.5", "0.6"), "a.yaml:6: expected 6 positions; found 5", ""),
        (second("0.6,", ".nan,"), "a.yaml:6:", "expected a finite number"),
        (
            second("velocities", "velocity"),
            "a.yaml:7:",
            "found the key \"velocity\"",
        ),
        (
            second("sec: 2", "sec: 0"),
            "a.yaml:9: expected a time after 0.5 s",
            "found 0 s",
        ),
        (second("sec: 2", "sec: -2"), "a.yaml:9:", "whole number"),
        (
            second("[0.6, 0.5", "[60.0, 50.0"),
            "a.yaml:6: point 1: joint joint_5 at 50 rad",
            "look like degrees",
        ),
        (
            "joint_names: []\npoints: []\n".to_owned(),
            "a.yaml:1:",
            "\"joint_1\" is missing",
        ),
        (
            message(SECOND).split("\n- ").next().unwrap().to_owned() + "\n",
            "a.yaml:2: expected a list; found nothing",
            "",
        ),
        ("{".to_owned(), "a.yaml", "YAML"),
    ];
    for (text, start, words) in cases {
        let found = error("a.yaml", &text);
        assert!(
            found.starts_with(start) && found.contains(words),
            "{start} {words}: {found}"
        );
    }
    assert!(error("a.json", "{").contains("not JSON"));
    assert!(error("a.txt", "x").contains("another name"));
    let chosen = read("a.yaml", &message(SECOND))
        .unwrap()
        .motion(&arm(), Some(Interpolation::Quintic));
    assert!(chosen.unwrap_err().to_string().contains("no accelerations"));
}

/// One joint of the arm is left out, and one of a gripper is there.
#[test]
fn joints_are_fixed_at_stated_values() {
    let message = message(SECOND)
        .replace("joint_6", "finger")
        .replace("[0.6, 0.5", "[0.02, 0.5")
        .replacen("[0.0, 0.0", "[0.02, 0.0", 1);
    let at = [("finger", 0.02), ("joint_6", 0.7)];
    let found = fixed("a.yaml", &message, &at).unwrap();
    assert_eq!(found.points.q_rad[1], JointVector::new(0.1, 0.2, 0.3, 0.4, 0.5, 0.7));
    assert_eq!(found.points.qd_rad_s.as_ref().unwrap()[1][5], 0.0);
    assert_eq!(found.points.fixed.len(), 2);
    let columns = "joint_2,joint_1,joint_3,joint_4,joint_5,finger";
    let table = format!("{columns}\n0,0,0,0,0,0.02\n0.2,0.1,0.3,0.4,0.5,0.02\n");
    let of_table = fixed("a.csv", &table, &at).unwrap();
    assert_eq!(of_table.points.q_rad[1], found.points.q_rad[1]);
    let numbered = "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad\n0,0,0,0,0\n0.1,0.2,0.3,0.4,0.5\n";
    let found = fixed("a.csv", numbered, &[("joint_6", 0.7)]).unwrap();
    assert_eq!(found.points.q_rad[1], of_table.points.q_rad[1]);
    let error = |name: &str, text: &str, at: &[(&str, f64)]| fixed(name, text, at).unwrap_err();
    assert!(
        error("a.yaml", &message, &at[..1]).contains("\"joint_6\" is missing (one that does not move can be fixed")
    );
    assert!(error("a.yaml", &message, &at[1..]).contains("found \"finger\", which is none of them"));
    let moved = message.replace("[0.02, 0.5", "[0.03, 0.5");
    assert!(
        error("a.yaml", &moved, &at)
            .contains("a.yaml:6: expected 0.02 for joint \"finger\", which is fixed; found 0.03")
    );
    let moving = message.replace("velocities: [0, 0.0", "velocities: [0.1, 0.0");
    assert!(error("a.yaml", &moving, &at).contains("a.yaml:7: expected 0 for joint \"finger\""));
    assert!(
        error("a.csv", &table.replace(",0.02\n0.2", ",0.03\n0.2"), &at)
            .contains("a.csv:2: column 6 (finger): expected 0.02")
    );
    for (name, text) in [("a.yaml", &message), ("a.csv", &table)] {
        let at = [at[0], at[1], ("thumb", 0.0)];
        assert!(error(name, text, &at).contains("joint \"thumb\" is fixed, and neither"));
    }
}

/// Tables as NumPy, spreadsheets and other programs write them.
#[test]
fn tables_of_other_programs_are_the_same_motion() {
    let names = "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad";
    let rows = "0,0,0.6,0,0,0,0\n2,1.3,0.6,0,0,0,0\n";
    let plain = motion("a.csv", &format!("{names}\n{rows}")).unwrap();
    let quoted = names
        .split(',')
        .map(|name| format!("\"{name}\""))
        .collect::<Vec<_>>()
        .join(",");
    let of_clock = rows
        .replace("0,0,0.6", "1700000000.25,0,0.6")
        .replace("2,1.3", "1700000002.25,1.3");
    for text in [
        format!("# {names}\n{rows}"),
        format!("#{names}\r\n{}", rows.replace('\n', "\r\n")),
        format!("\u{feff}# a note: t_s\n\n# {names}\n{rows}"),
        format!("{quoted}\n{rows}"),
        format!("{names},\n{}", rows.replace('\n', ",\n")),
        format!("{names},\n{rows}"),
        format!("{names}\n{}", rows.replace("1.3", "\"1.3\"")),
    ] {
        assert_eq!(motion("a.csv", &text).unwrap(), plain, "{text}");
    }
    let clock = motion("a.csv", &format!("{names}\n{of_clock}")).unwrap();
    assert_eq!(
        (clock.motion, clock.start.map(|t| t.to_string())),
        (plain.motion, Some("1700000000.25".to_owned()))
    );
    // A comment with as many commas is no header where there is one already, and a header with other names says so.
    let other = error(
        "a.csv",
        &format!("# 1,2,3,4,5,6,7\n{names}\n# {names}\n0,0,0.6,0,0,0\n"),
    );
    assert!(other.contains("a.csv:4: found 6 columns; expected 7"), "{other}");
    for (text, words) in [
        (
            format!("{}\n{rows}", names.replace("t_s", "time")),
            "rename it t_s (those of a clock may stay",
        ),
        (
            format!("{}\n{rows}", names.replace("t_s", "__time")),
            "column \"__time\" is unknown; if it has times in seconds",
        ),
        (format!("# {}\n{rows}", names.replace("t_s", "t")), "rename it t_s"),
        (
            format!("{}\n{rows}", names.replace("q2_rad", "q2_deg")),
            "angles must be radians",
        ),
        (
            format!("{}\n{rows}", names.replace("q1_rad", "/joint_states/joint_1/position")),
            "if it has positions of joint_1 in radians, rename it joint_1",
        ),
        (
            rows.to_owned(),
            "a.csv:1: found numbers in the first line; expected a header there: t_s [s]",
        ),
        (
            format!("{names},gripper\n0,0,0.6,0,0,0,0,0\n"),
            "can be fixed (--fix gripper=VALUE)",
        ),
        (format!("{names},,\n{rows}"), "column \"\" is unknown; it has no name"),
        (
            format!("{}\n{rows}", names.replace(',', ";")),
            "columns are separated by ';'",
        ),
        (
            format!("{}\n{rows}", names.replace(',', " ")),
            "columns are separated by ' '",
        ),
    ] {
        let found = error("a.csv", &text);
        assert!(found.contains(words), "{words}: {found}");
        if found.contains("is unknown") {
            let all = "q1_rad to q6_rad or the names of the joints (joint_1, joint_2, joint_3, joint_4, joint_5, joint_6) [rad]";
            assert!(found.contains("expected t_s [s]") && found.contains(all), "{found}");
        }
    }
}

#[test]
fn refuses_tables_with_the_line() {
    let head = "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n";
    let cases = [
        (
            format!("{head}0,0,0,0,0,0,0\n"),
            "a.csv:2:",
            "two points at least; found 1",
        ),
        (
            format!("{head}0,0,0,0,0,0,0\n0,0,0,0,0,0,0.1\n"),
            "a.csv:3:",
            "must come after",
        ),
        (
            format!("{head}0,0,0,0,0,0,0\n1,0,0,NaN,0,0,0.1\n"),
            "a.csv:3: column 4 (q3_rad)",
            "\"NaN\"",
        ),
        (
            format!("{head}0,0,0,0,0,0,0\n1,0,0,0,0,0\n"),
            "a.csv:3:",
            "found 6 columns; expected 7",
        ),
        (
            format!("{head}0,0,0,0,0,0,0\n1,90,0,45,0,0,180\n"),
            "a.csv:3: point 1: joint joint_1 at 90 rad",
            "degrees",
        ),
        (
            head.replace("q6_rad", "q7_rad"),
            "a.csv:1: column \"q7_rad\" is unknown",
            "",
        ),
        (
            "joint_1,joint_2\n0,0\n".to_owned(),
            "a.csv:1: column \"joint_3\" is missing",
            "",
        ),
        (
            head.replace("t_s,", "")
                .replace('\n', ",qd1_rad_s,qd2_rad_s,qd3_rad_s,qd4_rad_s,qd5_rad_s,qd6_rad_s\n")
                + "0,0,0,0,0,0,0,0,0,0,0,0\n",
            "a.csv:2:",
            "speeds and no times",
        ),
    ];
    for (text, start, words) in cases {
        let found = error("a.csv", &text);
        assert!(
            found.starts_with(start) && found.contains(words),
            "{start} {words}: {found}"
        );
    }
    let times = format!("{head}0,0,0,0,0,0,0\n1,0,0,0,0,0,0.1\n");
    let cubic = read("a.csv", &times)
        .unwrap()
        .motion(&arm(), Some(Interpolation::Cubic));
    assert!(cubic.unwrap_err().to_string().contains("no speeds"));
}

#[test]
fn refuses_arrays_that_do_not_fit() {
    let q = vec![JointVector::zeros(), JointVector::repeat(0.1)];
    let made = |t_s, qd_rad_s| JointPoints {
        q_rad: q.clone(),
        t_s,
        qd_rad_s,
        ..JointPoints::default()
    };
    let error = |points: JointPoints| points.motion(&arm(), None).unwrap_err();
    assert_eq!(
        error(made(Some(vec![0.0]), None)),
        PointsError::Count {
            what: "times",
            expected: 2,
            found: 1
        }
    );
    assert_eq!(
        error(made(Some(vec![0.0, f64::NAN]), None)),
        PointsError::NotFinite { point: 1 }
    );
    assert!(matches!(
        error(made(Some(vec![0.0, -1.0]), None)),
        PointsError::TimeOrder { point: 1, .. }
    ));
    // The last two differ by less than their distance from the first can tell.
    let close = JointPoints {
        q_rad: vec![JointVector::zeros(); 3],
        t_s: Some(vec![-1e17, 0.0, 0.5]),
        ..JointPoints::default()
    };
    assert!(matches!(error(close), PointsError::TimeOrder { point: 2, .. }));
}

/// A message of two points, the second a millisecond after the first, and where it begins.
fn millisecond(sec: u64, nanosec: u64) -> String {
    let end = nanosec + 1_000_000;
    format!(
        "joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]\npoints:\n- positions: {ZEROS}\n  time_from_start: {{sec: {sec}, \
         nanosec: {nanosec}}}\n- positions: [0.004363, 0.0, 0.0, 0.0, 0.0, 0.0]\n  time_from_start: {{sec: {sec}, nanosec: {end}}}\n"
    )
}

/// Times are subtracted before they are rounded: the motion is the same wherever they begin.
#[test]
fn times_of_a_clock_make_the_same_motion() {
    let from_0 = motion("a.yaml", &millisecond(0, 0)).unwrap();
    for (sec, nanosec) in [
        (1_700_000_000, 1_300_039),
        (4_000_000_000, 998_999_999),
        (1, 123_456_789),
    ] {
        let found = motion("a.yaml", &millisecond(sec, nanosec)).unwrap();
        assert_eq!(found.motion, from_0.motion);
        assert_eq!(
            found.start.unwrap().to_string(),
            format!("{sec}.{:0>9}", nanosec).trim_end_matches('0')
        );
    }
    let head = "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n";
    let table = |from: &str, to: &str| motion("a.csv", &format!("{head}{from},0,0,0,0,0,0\n{to},0.1,0,0,0,0,0\n"));
    let near = table("0", "0.0001").unwrap();
    for (from, to) in [
        ("999999.0001", "999999.0002"),
        ("1700000000.3", "1700000000.3001"),
        ("-0.00005", "5e-5"),
    ] {
        let found = table(from, to).unwrap();
        assert_eq!(found.motion, near.motion, "{from}");
    }
    // A nanosecond apart, ten digits before the point.
    assert!(table("1700000000.000000001", "1700000000.000000002").is_ok());
    let refused = table("1700000000.000000002", "1700000000.000000001").unwrap_err();
    assert_eq!(
        refused,
        "a.csv:3: column 1 (t_s): 1700000000.000000001 s must come after 1700000000.000000002 s, the time of the row before"
    );
    for wrong in ["nan", "inf", "", "1e99", "1;5", "0x1"] {
        let refused = table("0", wrong).unwrap_err();
        assert!(refused.contains("expected a time in seconds"), "{refused}");
    }
}

/// A joint without limits, in a path without times: planners keep it within half a turn of 0.
#[test]
fn a_long_turn_of_a_joint_without_limits_is_refused() {
    let text = IRB120_URDF.replace(
        r#"<joint name="joint_6" type="revolute">"#,
        r#"<joint name="joint_6" type="continuous">"#,
    );
    let endless = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let made = |arm: &RobotModel, to: f64, t_s: Option<Vec<f64>>| {
        let turned = |q: f64| JointVector::from([0.0, 0.0, 0.0, 0.0, 0.0, q]);
        let points = JointPoints {
            q_rad: vec![turned(2.9), turned(to)],
            t_s,
            ..JointPoints::default()
        };
        points.motion(arm, None)
    };
    let refused = made(&endless, -2.9, None).unwrap_err();
    assert!(matches!(refused, PointsError::LongTurn { point: 1, .. }));
    let said = refused.to_string();
    assert!(
        said.contains("turns by -5.8 rad") && said.contains("mean the 0.483185 rad the other way"),
        "{said}"
    );
    assert!(made(&endless, -0.2, None).is_ok(), "less than half a turn");
    assert!(made(&endless, -2.9, Some(vec![0.0, 9.0])).is_ok(), "times tell which");
    assert!(made(&arm(), -2.9, None).is_ok(), "limits tell which");
}

#[test]
fn what_a_header_says_is_read_or_refused() {
    let with = |header: &str| format!("header: {header}\n{}", message(SECOND));
    for plain in [
        "{stamp: {sec: 0, nanosec: 0}, frame_id: base}",
        "{seq: 7, stamp: {secs: 0, nsecs: 0}, frame_id: ''}",
        "{}",
    ] {
        assert_eq!(
            motion("a.yaml", &with(plain)).unwrap().notes,
            Vec::<String>::new(),
            "{plain}"
        );
    }
    let stamped = motion("a.yaml", &with("{stamp: {sec: 1700000000, nanosec: 5}, frame_id: ''}")).unwrap();
    assert!(
        stamped.notes[0].starts_with("its header.stamp is 1700000000.000000005 s: "),
        "{:?}",
        stamped.notes
    );
    let robot = format!(
        "joint_trajectory:\n  header: {{stamp: {{sec: 1}}}}\n{}",
        message(SECOND)
            .lines()
            .map(|line| format!("  {line}\n"))
            .collect::<String>()
    );
    assert_eq!(motion("a.yaml", &robot).unwrap().notes.len(), 1);
    assert!(error("a.yaml", &with("{stamp: {sec: 1, nsecs: 2}}")).contains("found keys of both"));
    assert!(error("a.yaml", &with("{stamp: {}}")).contains("expected a Duration with sec"));
    assert!(error("a.yaml", &with("{when: 3}")).contains("expected a Header"));
}

/// Only the table of a plan has accelerations that are none of its motion, and then it is said.
#[test]
fn accelerations_are_used_or_named() {
    let table = |more: &str, cells: &str| {
        let rates: String = (1..7)
            .map(|k| format!(",qd{k}_rad_s"))
            .chain((1..7).map(|k| format!(",qdd{k}_rad_s2")))
            .collect();
        let row = |t: i32, q: f64| format!("{t},{q},0,0,0,0,0,0,0,0,0,0,0,50,0,0,0,0,0{cells}\n");
        let text = format!(
            "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad{rates}{more}\n{}{}",
            row(0, 0.0),
            row(1, 0.1)
        );
        motion("a.csv", &text).unwrap()
    };
    let plain = table("", "");
    assert_eq!((plain.interpolation(), plain.notes.len()), (Interpolation::Quintic, 0));
    // A column of the same name as one of ours makes no plan of it.
    assert_eq!(table(",segment,plate", ",1,1"), plain);
    let plan = table(",segment,plate,tip_x_m,tip_y_m,tip_z_m", ",1,1,0,0,0");
    assert_eq!(plan.interpolation(), Interpolation::Cubic);
    assert!(
        plan.notes[0].starts_with("its accelerations are not used"),
        "{:?}",
        plan.notes
    );
}
