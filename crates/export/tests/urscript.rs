//! URScript: written, read back, refused.

use crate::programs::{damaged, edited, file, plan, points, program, ur5};
use nalgebra::{UnitQuaternion, Vector3};
use platewash_export::Refusal;
use platewash_export::dialect::{Dialect, ReadError};
use platewash_export::program::Point;
use platewash_export::reading::{Between, Reading};
use platewash_export::urscript::UrScript;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::fixtures::{kitchen_plates, kitchen_terms};
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
    fn what_is_written_is_read_back((points, share) in points()) {
        let plan = plan(&ARM);
        let program = program(&plan, &ARM, points, share);
        let files = UrScript.write(&program);
        prop_assert_eq!(&files, &UrScript.write(&program));
        prop_assert!(files[0].text.is_ascii() && !files[0].text.contains('\r'));
        prop_assert!(files[0].text.lines().all(|line| line.trim_end() == line));
        let reading = UrScript.read(&files, &ARM).unwrap();
        prop_assert_eq!(reading.points.len(), program.points.len());
        prop_assert_eq!(reading.speed_share, Some(share));
        prop_assert_eq!(reading.between, Between::Lines);
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
    fn a_turned_tip_is_read_back(
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
    fn noise_is_refused(text in any::<String>()) {
        prop_assert!(read(&text).is_err());
    }
}

/// Everything that the reader claims: what the fixture says, worked out by hand.
#[test]
fn a_program_by_hand_is_carried_out() {
    let reading = read(BY_HAND).unwrap();
    assert_eq!((reading.speed_share, reading.between), (Some(0.5), Between::Lines));
    let quarter = -std::f64::consts::FRAC_PI_2;
    let expected = [
        (28, 0.0, [0.0, quarter, 1.5, -1.5, -1.5, 0.0], None),
        (29, 0.008, [0.001, -1.57, 1.5, -1.5, -1.5, 0.0], Some(0.0)),
        (30, 0.016, [0.002, -1.57, 1.5, -1.5, -1.5, -0.001], None),
        (31, 0.020, [0.002, -1.57, 1.5, -1.5, -1.5, -0.001], None),
        (33, 0.028, [0.003, -1.57, 1.5, -1.5, -1.5, -0.001], None),
    ];
    assert_eq!(reading.points.len(), expected.len());
    for (point, (line, t_s, q_rad, corner_m)) in reading.points.iter().zip(expected) {
        assert_eq!((point.place.line, point.corner_m), (line, corner_m));
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
fn faults_are_refused_with_their_line() {
    let faults = [
        (
            3,
            "def by_hand():",
            "def by_hand()",
            3,
            "expected \":\", found the end of the line",
        ),
        (3, "def by_hand():", "def by_hand(x):", 3, "a program has no parameters"),
        (38, "end", "", 3, "this \"def\" has no \"end\""),
        (38, "end", "end\nend", 39, "\"end\" closes nothing"),
        (5, "0, 0])", "0])", 5, "a pose of 6 numbers, found 5"),
        (
            5,
            "set_tcp(p[",
            "set_tcp([",
            5,
            "expected a pose p[x, y, z, rx, ry, rz], found a list",
        ),
        (6, "0.5", "-0.5", 6, "expected m above 0, found -0.5"),
        (6, "cog=", "cogs=", 6, "\"set_payload\" has no argument \"cogs\""),
        (
            6,
            "set_payload(0.5, cog=[0.0, 0.0, 0.05])",
            "",
            36,
            "a tip and no payload",
        ),
        (7, "0.5", "1.5", 7, "expected speed_share above 0 and at most 1"),
        (7, "0.5", "0", 7, "expected speed_share above 0 and at most 1"),
        (8, "4e2", "4e999", 8, "expected a decimal number, found \"4e999\""),
        (8, "(100 + 4e2)", "(100 / 0)", 8, "no number to go by"),
        (12, "q[5]", "q[6]", 12, "no entry 6"),
        (12, "local twice", "local found", 13, "no variable \"twice\""),
        (16, "d2r(-90)", "d2r(\"-90\")", 16, "expected a number, found a text"),
        (16, "start = [0.0", "start = [90.0", 28, "are these degrees?"),
        (
            17,
            "get_actual_joint_positions()",
            "get_forward_kin()",
            17,
            "\"get_forward_kin\": it is neither",
        ),
        (
            19,
            "away > 0.01",
            "away > -0.01",
            21,
            "halts here, though the arm stands where it begins",
        ),
        (
            19,
            "away > 0.01",
            "1 or True",
            19,
            "expected True or False, found a number",
        ),
        (
            21,
            "halt",
            "movej(start)",
            21,
            "this depends on where the arm stands; expected popup, textmsg or halt alone",
        ),
        (
            23,
            "textmsg(\"at the start: \", away)",
            "gain = 300",
            23,
            "this depends on where the arm stands",
        ),
        (23, "away)", "far)", 23, "no variable \"far\""),
        (
            32,
            "gain = 300",
            "if get_actual_joint_positions()[0] > 1:\n  end",
            32,
            "depends on where the arm is",
        ),
        (
            33,
            "[0.0030",
            "[found[0]",
            13,
            "expected a list of 6 numbers, found a measured value",
        ),
        (20, "title", "headline", 20, "\"popup\" has no argument \"headline\""),
        (22, "elif", "else", 22, "expected \":\""),
        (24, "else:", "else:\nelse:", 25, "\"else\" behind \"else\""),
        (
            28,
            "movej(start, a=0.1, v=0.05)",
            "",
            29,
            "servoj before the arm is at its start",
        ),
        (
            28,
            "v=0.05",
            "t=2",
            28,
            "movej with t: its ramps and blends are the controller's",
        ),
        (
            29,
            "0.008,",
            "0.5,",
            29,
            "servoj with t = 0.5 s: it hastens to its target",
        ),
        (29, "0.008,", "-0.008,", 29, "expected t above 0, found -0.008"),
        (
            29,
            "0.1, 300",
            "0.01, 300",
            29,
            "expected lookahead_time from 0.03 to 0.2, found 0.01",
        ),
        (29, "300)", "30)", 29, "expected gain from 100 to 2000, found 30"),
        (29, "300)", "300, 1)", 29, "\"servoj\" takes 6 arguments at most"),
        (29, "0.001, ", "", 29, "expected a list of 6 numbers, found one of 5"),
        (
            29,
            "servoj([0.001",
            "servoj(p[0.001",
            29,
            "expected joint positions, found a pose",
        ),
        (30, "go(", "movel(", 30, "\"movel\": its path needs inverse kinematics"),
        (30, "go(", "come(", 30, "\"come\": it is neither a function"),
        (30, ", step)", ")", 30, "expected an argument \"t\""),
        (31, "t=step / 2, q", "step / 2, q", 31, "argument 1 is given twice"),
        (
            32,
            "gain = 300",
            "sleep(1)",
            32,
            "how the arm moves on while the program waits",
        ),
        (
            32,
            "gain = 300",
            "set_tcp(p[0,0,0,0,0,0])",
            32,
            "set in the midst of the motion",
        ),
        (
            32,
            "gain = 300",
            "popup(\"wait\")",
            32,
            "a popup in the midst of the motion",
        ),
        (32, "gain = 300", "while True:", 32, "loops are not read"),
        (32, "gain = 300", "def go():\n  end", 32, "a second function \"go\""),
        (33, "go(", "stopj(1)\n  go(", 13, "servoj behind stopj"),
        (35, "0.003", "0.004", 35, "movej to a place 0.001000 rad away"),
    ];
    for (line, from, to, at, said) in faults {
        let error = read(&edited(BY_HAND, line, from, to)).expect_err(to);
        assert_eq!(error.place.line, at, "{to}: {error}");
        assert!(error.reason.contains(said), "{to}: {error}");
        assert_eq!(error.to_string(), format!("x.script:{at}: {}", error.reason));
    }
}

/// A function that changes a variable from outside without saying which it means.
#[test]
fn a_variable_that_may_be_either_is_refused() {
    let text = "def x():\n  a = 1\n  def f():\n    a = 2\n  end\n  f()\nend\n";
    let error = read(text).unwrap_err();
    assert_eq!(error.place.line, 4);
    assert!(
        error.reason.contains("expected \"local\" or \"global\" before it"),
        "{error}"
    );
}

#[test]
fn calls_steps_and_nesting_are_bounded() {
    let forever = "def x():\n  def f():\n    f()\n  end\n  f()\nend\n";
    let error = read(forever).unwrap_err();
    assert_eq!(error.place.line, 3);
    assert!(error.reason.contains("deeper than 32"), "{error}");
    // Each function calls the one before twice: 2^20 calls.
    let mut doubling = "def x():\n  def f0():\n    a = 1\n  end\n".to_owned();
    for k in 1..=20 {
        doubling += &format!("  def f{k}():\n    f{0}()\n    f{0}()\n  end\n", k - 1);
    }
    let error = read(&(doubling + "  f20()\nend\n")).unwrap_err();
    assert!(error.reason.contains("steps, the most"), "{error}");
    for (text, said) in [
        (
            format!("a = {}1{}", "(".repeat(40), ")".repeat(40)),
            "nested deeper than 32 brackets",
        ),
        ("if True:\n".repeat(20), "nested deeper than 16"),
        (
            format!("a = \"{}\"", "x".repeat(20_000)),
            "a line of more than 10000 bytes",
        ),
        (String::new(), "the program ends here and has not moved"),
    ] {
        let error = read(&text).unwrap_err();
        assert!(error.reason.contains(said), "{error}");
    }
}

/// The check of the start is not only written: an arm that stands elsewhere is not moved.
#[test]
fn a_start_that_the_check_does_not_know_is_noticed() {
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
    let moved = text
        .lines()
        .position(|line| line.trim() == "movej(start, a=0.1, v=0.05)")
        .unwrap()
        + 1;
    let elsewhere = "movej([0.51, 0.5, 0.5, 0.5, 0.5, 0.5], a=0.1, v=0.05)";
    let error = read(&edited(text, moved, "movej(start, a=0.1, v=0.05)", elsewhere)).unwrap_err();
    assert!(
        error
            .reason
            .contains("halts here, though the arm stands where it begins"),
        "{error}"
    );
    assert!(
        text.lines()
            .nth(error.place.line - 2)
            .unwrap()
            .contains("Joint 1 is more than 0.5 deg"),
        "{error}"
    );
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
fn arms_of_others_and_tools_without_a_mass_are_refused() {
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
