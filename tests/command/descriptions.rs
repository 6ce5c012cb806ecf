//! What a description states is kept: limits, friction, and the frame that carries the tool.

use super::*;

/// The IRB 120's description with an edit, each time that it fits, as a file.
fn arm(dir: &Path, edits: &[(&str, &str)]) -> String {
    let text = edits.iter().fold(
        platewash::kinematics::irb120::IRB120_URDF.to_owned(),
        |text, (old, new)| {
            assert!(text.contains(old), "{old}");
            text.replace(old, new)
        },
    );
    let path = dir.join("arm.urdf");
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

const SWING: &str = "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,qd1_rad_s,qd2_rad_s,qd3_rad_s,qd4_rad_s,qd5_rad_s,qd6_rad_s\n\
                     0,0,0,0,0,0.5,0,0,0,0,0,0,0\n0.5,0.8,0,0,0,0.5,0,0,0,0,0,0,0\n";

#[test]
fn accelerations_of_the_description_are_kept_and_shown() {
    let folder = folder();
    let dir = folder.path();
    let urdf = arm(dir, &[("effort=\"0\"", "effort=\"0\" acceleration=\"2.5\"")]);
    std::fs::write(dir.join("swing.csv"), SWING).unwrap();
    let prove = |file: &str, more: &[&str]| platewash(dir, &[&["prove-motion", file, "--urdf", &urdf], more].concat());
    let found = prove("swing.csv", &[]);
    assert_eq!(found.code, 4, "{}", found.stderr);
    assert!(
        found
            .stdout
            .starts_with("BROKEN: joint acceleration of joint_1 is 19.2000 rad/s², its limit is 2.5000 rad/s²"),
        "{}",
        found.stdout
    );
    // The lesser one counts: that of the option, or that of the description.
    assert!(
        prove("swing.csv", &["--acceleration-limits", "1"])
            .stdout
            .contains("its limit is 1.0000")
    );
    assert!(
        prove("swing.csv", &["--acceleration-limits", "30"])
            .stdout
            .contains("its limit is 2.5000")
    );
    // Between points without speeds nothing is known of accelerations, which is said.
    let points: Vec<_> = SWING
        .lines()
        .map(|line| line.split(',').take(7).collect::<Vec<_>>().join(","))
        .collect();
    std::fs::write(dir.join("points.csv"), points.join("\n")).unwrap();
    let found = prove("points.csv", &[]).done();
    assert!(
        found
            .stdout
            .contains("acceleration limits of the description are not judged"),
        "{}",
        found.stdout
    );
    let said = platewash(dir, &["robot", "--urdf", &urdf]).done().stdout;
    assert!(
        said.contains("accelerations [2.5, 2.5, 2.5, 2.5, 2.5, 2.5] rad/s², as the URDF states"),
        "{said}"
    );
    assert!(
        platewash(dir, &["robot"])
            .done()
            .stdout
            .contains("assumed: the URDF states none")
    );

    let plan = ["plan", "-q", "--scenario", "sink", "--urdf", &urdf];
    platewash(dir, &plan).done();
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    let read: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(
        read["job"]["limits"]["joint_acceleration_rad_s2"],
        serde_json::json!([2.5, 2.5, 2.5, 2.5, 2.5, 2.5])
    );
    let verified = platewash(dir, &["verify", "out/plan.json", "--urdf", &urdf, "--details"]).done();
    assert!(
        verified
            .stdout
            .contains("joint accelerations 2.5, 2.5, 2.5, 2.5, 2.5, 2.5 rad/s² (from the description)"),
        "{}",
        verified.stdout
    );
}

#[test]
fn soft_limits_are_kept_and_unused_statements_are_named() {
    let folder = folder();
    let dir = folder.path();
    let soft = "effort=\"0\" jerk=\"80\"/><safety_controller soft_lower_limit=\"-0.7\" soft_upper_limit=\"0.7\" k_velocity=\"0\"/>";
    let urdf = arm(dir, &[("effort=\"0\"/>", soft)]);
    std::fs::write(dir.join("swing.csv"), SWING).unwrap();
    let found = platewash(dir, &["prove-motion", "swing.csv", "--urdf", &urdf]);
    assert_eq!(found.code, 4, "{}", found.stderr);
    for words in [
        "BROKEN: joint_1 is at 0.8000 rad, its soft limit is 0.7000 rad",
        "not used of the description: joint 'joint_1', limit: jerk=\"80\"",
        "and 5 more",
    ] {
        assert!(found.stdout.contains(words), "{words}: {}", found.stdout);
    }
    let said = platewash(dir, &["robot", "--urdf", &urdf]).done().stdout;
    for words in [
        "position limits of the safety controller: joint_1 (both), joint_2 (both)",
        "jerk limits, which nothing keeps: joint_1 80 rad/s³",
        "stated, and not used or not complete:\n  joint 'joint_1', limit: jerk=\"80\" (line ",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
}

#[test]
fn a_tool0_that_does_not_leave_the_flange_is_no_place_for_a_tool() {
    let folder = folder();
    let dir = folder.path();
    let tool0 = "<child link=\"tool0\"/>\n    <origin xyz=\"0 0 0\" rpy=\"0 1.5707963267948966 0\"/>";
    let sideways = "<child link=\"tool0\"/>\n    <origin xyz=\"0 0 0\"/>";
    let urdf = arm(
        dir,
        &[
            (tool0, sideways),
            ("<robot name=\"irb120\">", "<robot name=\"abb_sideways\">"),
        ],
    );
    let plan = |more: &[&str]| {
        platewash(
            dir,
            &[&["plan", "-q", "--scenario", "sink", "--urdf", &urdf], more].concat(),
        )
    };
    plan(&[]).refused(
        2,
        &[
            "'tool0' whose z axis is 90.0° from axis 6",
            "not the tool0 of a controller",
            "--tool-mount",
            "'tool0' (x leads out)",
        ],
    );
    // So are one behind a prefix, and one whose z axis leads into the arm.
    let inwards = "<child link=\"tool0\"/>\n    <origin xyz=\"0 0 0\" rpy=\"0 -1.5707963267948966 0\"/>";
    for (edits, words) in [
        (
            [(tool0, sideways), ("\"tool0\"", "\"left_tool0\"")],
            "'left_tool0' whose z axis is 90.0° from axis 6",
        ),
        (
            [(tool0, inwards), ("\"flange\"", "\"face\"")],
            "z axis should leave the arm by its name, but -z leads away",
        ),
    ] {
        let other = folder.path().join("other");
        std::fs::create_dir_all(&other).unwrap();
        let urdf = arm(&other, &edits);
        let refused = platewash(dir, &["plan", "-q", "--scenario", "sink", "--urdf", &urdf]);
        refused.refused(2, &[words, "--tool-mount"]);
    }
    // Where it is stated, a tool at the flange's side is planned with, or named where it is in the way; no controller has it there.
    let found = plan(&["--tool-mount", "tool0"]);
    if found.code != 0 {
        assert!(
            found.stdout.contains("the tool is mounted on tool0"),
            "{}",
            found.stdout
        );
    }
    plan(&["--tool-mount", "tool0:x", "--out", "right"]).done();
    let export = |plan: &str| {
        platewash(
            dir,
            &["export", plan, "--urdf", &urdf, "--to", "rapid", "--out", "rapid"],
        )
    };
    export("right/plan.json").done();
}
