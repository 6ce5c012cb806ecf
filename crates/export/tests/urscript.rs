//! URScript: written, read back, refused.

use crate::programs::{damaged, edited, file, plan, points, program, ur5};
use nalgebra::{UnitQuaternion, Vector3};
use platewash_export::Refusal;
use platewash_export::dialect::{Dialect, ReadError};
use platewash_export::program::Point;
use platewash_export::reading::{Reading, SegmentShape};
use platewash_export::urscript::UrScript;
use platewash_fixtures::{kitchen_plates, kitchen_terms};
use platewash_kinematics::{JointVector, RobotModel};
use proptest::prelude::*;
use std::sync::LazyLock;

const BY_HAND: &str = include_str!("fixtures/urscript/by_hand.script");

static ARM: LazyLock<RobotModel> = LazyLock::new(ur5);

fn read(text: &str) -> Result<Reading, ReadError> {
    UrScript.read(&[file("x.script", text)], &ARM)
}

proptest! {
    /// What is written says the same points at the same times, and the same tool.
    #[test]
    fn reads_back_the_written_program((points, share) in points()) {
        let plan = plan(&ARM);
        let program = program(&plan, &ARM, points, share);
        let files = UrScript.write(&program);
        prop_assert_eq!(&files, &UrScript.write(&program));
        prop_assert!(files[0].text.is_ascii() && !files[0].text.contains('\r'));
        prop_assert!(files[0].text.lines().all(|line| line.trim_end() == line));
        let reading = UrScript.read(&files, &ARM).unwrap();
        prop_assert_eq!(reading.points.len(), program.points.len());
        prop_assert_eq!(reading.speed_share, Some(share));
        prop_assert_eq!(reading.interpolation, SegmentShape::Lines);
        for (read, point) in reading.points.iter().zip(&program.points) {
            prop_assert!((read.t_s - point.t_s / share).abs() < 1e-6);
            prop_assert!((read.q_rad - point.q_rad).amax() < 1e-7);
        }
        let tool = reading.tool.unwrap();
        let mass = program.tool().mass.unwrap();
        let tip = tool.tip.unwrap();
        prop_assert!((tip.translation.vector - program.tool().tip.translation.vector).amax() < 1e-9);
        prop_assert!(tip.rotation.angle_to(&program.tool().tip.rotation) < 1e-7);
        prop_assert!((tool.mass_kg - mass.mass_kg).abs() < 1e-9);
        prop_assert!((Vector3::from(tool.com_m) - Vector3::from(mass.com_m)).amax() < 1e-9);
    }

    /// Any tip survives, turned by as little or as much as it may be.
    #[test]
    fn reads_back_a_turned_tip(
        at in proptest::array::uniform3(-0.5..0.5_f64),
        axis in proptest::array::uniform3(-1.0..1.0_f64),
        angle in prop_oneof![Just(0.0), Just(1e-8), Just(std::f64::consts::PI), 0.0..3.1_f64],
    ) {
        prop_assume!(Vector3::from(axis).norm() > 1e-3);
        let mut plan = plan(&ARM);
        let turn = UnitQuaternion::from_scaled_axis(Vector3::from(axis).normalize() * angle);
        plan.job.workcell.tool.tip = platewash_kinematics::Pose::from_parts(Vector3::from(at).into(), turn);
        let still = Point {
            t_s: 0.0,
            q_rad: JointVector::zeros(),
            qd_rad_s: JointVector::zeros(),
            rests: true,
            segment: 0,
        };
        let then = Point { t_s: 0.008, ..still };
        let files = UrScript.write(&program(&plan, &ARM, vec![still, then], 1.0));
        let tip = UrScript.read(&files, &ARM).unwrap().tool.unwrap().tip.unwrap();
        prop_assert!(tip.rotation.angle_to(&turn) < 1e-7);
        prop_assert!((tip.translation.vector - Vector3::from(at)).amax() < 1e-9);
    }

    /// A damaged program is read or refused at a line that it has.
    #[test]
    fn a_damaged_program_is_read_or_refused(text in damaged(BY_HAND)) {
        if let Err(error) = read(&text) {
            prop_assert!(error.place.line >= 1 && error.place.line <= text.lines().count().max(1), "{}", error);
            prop_assert!(!error.reason.contains('\n'));
        }
    }

    /// Noise is refused.
    #[test]
    fn rejects_random_text(text in any::<String>()) {
        prop_assert!(read(&text).is_err());
    }
}

/// What the fixture says, worked out by hand.
#[test]
fn reads_a_program_written_by_hand() {
    let reading = read(BY_HAND).unwrap();
    assert_eq!(
        (reading.speed_share, reading.interpolation),
        (Some(0.5), SegmentShape::Lines)
    );
    assert!(reading.start_within_deg.is_none(), "two joints are checked");
    let expected = [
        (11, 0.0, [0.0, -1.57, 1.5, -1.5, -1.5, 0.0], None),
        (26, 0.008, [0.001, -1.57, 1.5, -1.5, -1.5, 0.0], Some(0.0)),
        (7, 0.016, [0.002, -1.57, 1.5, -1.5, -1.5, -0.001], None),
        (8, 0.020, [0.002, -1.57, 1.5, -1.5, -1.5, -0.001], None),
        (29, 0.028, [0.003, -1.57, 1.5, -1.5, -1.5, -0.001], None),
    ];
    assert_eq!(reading.points.len(), expected.len());
    for (point, (line, t_s, q_rad, corner_m)) in reading.points.iter().zip(expected) {
        assert_eq!(point.corner_m, corner_m);
        // The first point has the line of the movej.
        assert_eq!(point.place.line, if t_s == 0.0 { 25 } else { line }, "{point:?}");
        assert!((point.t_s - t_s).abs() < 1e-12, "{point:?}");
        assert!((point.q_rad - JointVector::from(q_rad)).amax() < 1e-12, "{point:?}");
    }
    let tool = reading.tool.unwrap();
    assert_eq!((tool.mass_kg, tool.com_m), (0.5, [0.0, 0.0, 0.05]));
    let tip = tool.tip.unwrap();
    assert!((tip * nalgebra::Point3::new(0.0, 0.1, 0.0) - nalgebra::Point3::new(0.0, -0.1, 0.1)).amax() < 1e-11);
}

/// A line, what is changed there, the line that is refused, and words of the reason.
#[test]
fn rejects_faults_with_their_line() {
    let faults = [
        (1, "def by_hand():", "def by_hand()", 1, "expected `def NAME():`"),
        (
            1,
            "def by_hand():",
            "def by_hand(x):",
            1,
            "functions with parameters are not read",
        ),
        (33, "end", "", 1, "this `def` has no `end`"),
        (33, "end", "end\nend", 34, "which ends before this line"),
        (2, "0, 0])", "0])", 2, "a pose of 6 numbers, found 5"),
        (
            2,
            "set_tcp(p[",
            "set_tcp([",
            2,
            "expected a pose p[x, y, z, rx, ry, rz], found a list",
        ),
        (3, "0.5", "-0.5", 3, "expected m above 0, found -0.5"),
        (3, "cog=", "cogs=", 3, "no argument `cogs`"),
        (
            3,
            "set_payload(0.5, cog=[0.0, 0.0, 0.05])",
            "",
            32,
            "a tip and no payload",
        ),
        (4, "0.5", "1.5", 4, "expected speed_share above 0 and at most 1"),
        (4, "0.5", "0", 4, "expected speed_share above 0 and at most 1"),
        (5, "500", "4e999", 5, "expected a decimal number"),
        (5, "500", "5 * 100", 5, "computed values are not read"),
        (5, "500", "size", 5, "no variable `size`"),
        (
            7,
            "servoj(",
            "if True:\n  end\n  servoj(",
            7,
            "in functions, only instructions are read",
        ),
        (
            12,
            "get_actual_joint_positions()",
            "get_forward_kin()",
            12,
            "no variable `get_forward_kin`",
        ),
        (
            13,
            "norm(found[0] - start[0])",
            "norm(found[0] - start[1])",
            13,
            "only the check of the start is read",
        ),
        (13, "> 0.008", "> limit", 13, "only the check of the start is read"),
        (
            13,
            "norm(found[0]",
            "norm(start[0]",
            13,
            "only the check of the start is read",
        ),
        (
            15,
            "halt",
            "textmsg(\"go on\")",
            13,
            "only the check of the start is read",
        ),
        (15, "halt", "movej(start)", 13, "only the check of the start is read"),
        (14, "title", "headline", 13, "no argument `headline`"),
        (
            25,
            "movej(start, a=0.1, v=0.05)",
            "",
            26,
            "servoj before the arm is at its start",
        ),
        (
            25,
            "v=0.05",
            "t=2",
            25,
            "movej with t: its ramps and blends are the controller's",
        ),
        (
            26,
            "0.008,",
            "0.5,",
            26,
            "servoj with t = 0.5 s: it hastens to its target",
        ),
        (26, "0.008,", "-0.008,", 26, "expected t above 0, found -0.008"),
        (
            26,
            "0.1, 300",
            "0.01, 300",
            26,
            "expected lookahead_time from 0.03 to 0.2, found 0.01",
        ),
        (26, "300)", "30)", 26, "expected gain from 100 to 2000, found 30"),
        (26, "300)", "300, 1)", 26, "expected 6 arguments at most"),
        (26, "0.001, ", "", 26, "expected a list of 6 numbers, found one of 5"),
        (
            26,
            "servoj([0.001",
            "servoj(p[0.001",
            26,
            "expected joint positions, found a pose",
        ),
        (26, "[0.001", "[90.0", 26, "are these degrees?"),
        (
            27,
            "go()",
            "movel(start)",
            27,
            "`movel`: the controller plans or times this motion",
        ),
        (27, "go()", "come()", 27, "`come`: it is neither a function"),
        (27, "go()", "go(1)", 27, "expected `go()`"),
        (
            28,
            "set_digital_out(1, True)",
            "sleep(1)",
            28,
            "how the arm moves on while the program waits",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "set_tcp(p[0,0,0,0,0,0])",
            28,
            "set behind a motion",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "popup(\"wait\")",
            28,
            "a popup in the midst of the motion",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "gain = 300",
            28,
            "before the first motion alone",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "def textmsg():\n  end",
            28,
            "is the controller's own",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "def go():\n  end",
            28,
            "`go` is given twice",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "return 1",
            28,
            "loops, conditions and jumps",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "thread x():\n  end",
            28,
            "runs beside the motion",
        ),
        (
            28,
            "set_digital_out(1, True)",
            "if norm(found[2] - start[2]) > 0.008:\n popup(\"\")\n halt\n end",
            28,
            "before the first motion",
        ),
        (29, "servoj(", "stopj(1)\n  servoj(", 30, "servoj behind stopj"),
        (31, "0.003", "0.004", 31, "movej to a place 0.001000 rad away"),
    ];
    for (line, from, to, at, said) in faults {
        let error = read(&edited(BY_HAND, line, from, to)).expect_err(to);
        assert!(error.reason.contains(said), "{to}: {error}");
        assert_eq!(error.place.line, at, "{to}: {error}");
        assert_eq!(error.to_string(), format!("x.script:{at}: {}", error.reason));
    }
    let looped = edited(BY_HAND, 28, "set_digital_out(1, True)", "while True:\n  end");
    assert!(
        read(&looped)
            .unwrap_err()
            .reason
            .contains("loops, conditions and jumps")
    );
}

/// What hides in a function that is never called is no part of another one.
#[test]
fn blocks_end_where_a_controller_ends_them() {
    let hidden = edited(
        BY_HAND,
        27,
        "go()",
        "def never():\n  while True:\n  end\n  servoj([0.1, -1.57, 1.5, -1.5, -1.5, 0.0], t=0.008)\n  halt\n  end\n  go()",
    );
    let error = read(&hidden).unwrap_err();
    assert!(error.reason.contains("in functions, only instructions"), "{error}");
    assert!(read(&format!("{BY_HAND}def more():\nend\n")).is_err());
}

#[test]
fn bounds_calls_and_lines() {
    let error = read("def x():\n  def f():\n    f()\n  end\n  f()\nend\n").unwrap_err();
    assert_eq!(error.place.line, 3);
    assert!(error.reason.contains("runs itself"), "{error}");
    // Each function calls the one before twice: 2^20 calls.
    let mut doubling = "def x():\n  def f0():\n    textmsg(\"\")\n  end\n".to_owned();
    for k in 1..=20 {
        doubling += &format!("  def f{k}():\n    f{0}()\n    f{0}()\n  end\n", k - 1);
    }
    let error = read(&(doubling + "  f20()\nend\n")).unwrap_err();
    assert!(error.reason.contains("steps, the most"), "{error}");
    let long = format!("def x():\n  textmsg(\"{}\")\nend\n", "x".repeat(200_000));
    assert!(read(&long).unwrap_err().reason.contains("longer than"));
    assert!(read("").unwrap_err().reason.contains("found nothing"));
}

/// The check counts where it compares with where the program goes.
#[test]
fn notices_a_start_check_of_another_configuration() {
    let plan = plan(&ARM);
    let point = |t_s, q| Point {
        t_s,
        q_rad: JointVector::repeat(q),
        qd_rad_s: JointVector::zeros(),
        rests: true,
        segment: 0,
    };
    let files = UrScript.write(&program(&plan, &ARM, vec![point(0.0, 0.5), point(0.008, 0.5)], 1.0));
    let text = &files[0].text;
    assert!(read(text).unwrap().start_within_deg.is_some());
    let moved = |from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        read(&text.replacen(from, to, 1))
    };
    let elsewhere = moved("movej(start,", "movej([0.51, 0.5, 0.5, 0.5, 0.5, 0.5],");
    assert!(elsewhere.unwrap_err().reason.contains("another start"));
    let limit = text
        .split("norm(found[0] - start[0]) > ")
        .nth(1)
        .unwrap()
        .split(':')
        .next()
        .unwrap();
    assert!(
        moved(&format!("start[0]) > {limit}"), "start[0]) > 1.0")
            .unwrap()
            .start_within_deg
            .is_none()
    );
    let block = text
        .split("  if norm(found[5]")
        .nth(1)
        .unwrap()
        .split("  set_tcp")
        .next()
        .unwrap();
    let block = format!(
        "  if norm(found[5]{}",
        &block[..block.rfind("  #").unwrap_or(block.len())]
    );
    assert!(moved(&block, "").unwrap().start_within_deg.is_none());
}

#[test]
fn a_plan_of_another_number_of_files_is_refused() {
    let [one, two] = ["a.script", "b.script"].map(|name| file(name, BY_HAND));
    let error = UrScript.read(&[one, two], &ARM).unwrap_err();
    assert_eq!(
        error.to_string(),
        "b.script:1: a second program; expected one .script file"
    );
    assert!(UrScript.read(&[], &ARM).is_err());
    assert!(UrScript.is_in(&file("A.SCRIPT", "")) && !UrScript.is_in(&file("a.csv", "")));
}

#[test]
fn rejects_arms_of_other_makers_and_tools_without_mass() {
    let mut terms = kitchen_terms(&ARM, kitchen_plates());
    assert_eq!(UrScript.accepts(&terms, &ARM), Ok(()));
    let other = RobotModel::irb120().unwrap();
    let refusal = UrScript.accepts(&terms, &other).unwrap_err();
    assert!(
        matches!(&refusal, Refusal::Arm { found, .. } if found == other.name()),
        "{refusal}"
    );
    terms.workcell.tool.mass = None;
    let refusal = UrScript.accepts(&terms, &ARM).unwrap_err();
    assert!(matches!(&refusal, Refusal::Load { .. }), "{refusal}");
}
