//! Trajectories in the messages of planners, action clients and recorders.

use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::FixedJoints;
use platewash_motion_proof::{Interpolation, PointMotion, TrajectoryFile};

const NAMES: &str = "joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]";

/// A `JointTrajectory` from 0 to `to` rad of joint 1 in 2 s, indented.
fn trajectory(indent: usize, to: f64) -> String {
    let lines = [
        NAMES.to_owned(),
        "points:".to_owned(),
        "- {positions: [0.0, 0.6, 0.0, 0.0, 0.0, 0.0], time_from_start: {sec: 0, nanosec: 0}}".to_owned(),
        format!("- {{positions: [{to:?}, 0.6, 0.0, 0.0, 0.0, 0.0], time_from_start: {{sec: 2, nanosec: 0}}}}"),
    ];
    lines.map(|line| format!("{}{line}\n", " ".repeat(indent))).concat()
}

fn read_all(name: &str, text: &str) -> Result<Vec<PointMotion>, String> {
    let arm = RobotModel::irb120().unwrap();
    let files = TrajectoryFile::read_all(name, text, &arm, &FixedJoints::new());
    let files = files.map_err(|error| error.to_string())?;
    files
        .iter()
        .map(|file| file.motion(&arm, None).map_err(|error| error.to_string()))
        .collect()
}

fn read(name: &str, text: &str) -> PointMotion {
    let mut all = read_all(name, text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(all.len(), 1, "{text}");
    all.remove(0)
}

fn error(text: &str) -> String {
    read_all("a.yaml", text).unwrap_err()
}

fn wrapped(head: &str, indent: usize, tail: &str) -> String {
    format!("{head}{}{tail}", trajectory(indent, 1.3))
}

const EMPTY: &str = "  multi_dof_joint_trajectory: {joint_names: [], points: []}\n";

#[test]
fn wrapped_messages_are_the_trajectory_in_them() {
    let plain = read("a.yaml", &trajectory(0, 1.3));
    assert_eq!(
        (plain.interpolation(), &plain.notes[..]),
        (Interpolation::Linear, &[][..])
    );
    let start = "trajectory_start:\n  joint_state: {name: [joint_1, joint_2], position: [0.0, 0.6], velocity: [], effort: []}\n  is_diff: \
                 false\n";
    for text in [
        // DisplayTrajectory.
        wrapped(
            "model_id: irb120\ntrajectory:\n- joint_trajectory:\n",
            4,
            &format!("{EMPTY}{start}---\n"),
        ),
        // Goals of ExecuteTrajectory and FollowJointTrajectory, and those in actions of ROS 1 and ROS 2.
        wrapped(
            "trajectory:\n  joint_trajectory:\n",
            4,
            &format!("{EMPTY}controller_names: []\n"),
        ),
        wrapped(
            "goal:\n  trajectory:\n",
            4,
            "  path_tolerance: []\ngoal_id: {uuid: [1, 2, 3]}\n",
        ),
        wrapped(
            "header: {seq: 1, stamp: {secs: 7, nsecs: 5}, frame_id: ''}\ngoal_id: {stamp: {secs: 0, nsecs: 0}, id: x}\ngoal:\n  \
             trajectory:\n    joint_trajectory:\n",
            6,
            "",
        ),
        // Answers of planners.
        wrapped(
            "motion_plan_response:\n  group_name: arm\n  planning_time: 0.05\n  error_code: {val: 1}\n  trajectory:\n    \
             joint_trajectory:\n",
            6,
            "",
        ),
        wrapped(
            "fraction: 1.0\nerror_code: {val: 1, message: '', source: ''}\nsolution:\n  joint_trajectory:\n",
            4,
            "",
        ),
        wrapped(
            "error_code: {val: 1}\nplanning_time: 0.1\nexecuted_trajectory: {joint_trajectory: {joint_names: [], points: []}}\nplanned_trajectory:\n  \
             joint_trajectory:\n",
            4,
            "",
        ),
        // rosbridge, as YAML.
        wrapped(
            "op: publish\ntopic: /arm/joint_trajectory\ntype: trajectory_msgs/JointTrajectory\nmsg:\n",
            2,
            "",
        ),
        wrapped("op: send_action_goal\naction: /arm\nargs:\n  trajectory:\n", 4, ""),
        // Empty documents.
        format!("---\n---\n{}---\n---\n", trajectory(0, 1.3)),
        // Anchors.
        trajectory(0, 1.3).replacen("[0.0, 0.6, 0.0, 0.0, 0.0, 0.0]", "&q [0.0, 0.6, 0.0, 0.0, 0.0, 0.0]", 1),
        // What is left out is 0.
        trajectory(0, 1.3).replacen(", time_from_start: {sec: 0, nanosec: 0}", "", 1),
        trajectory(0, 1.3).replace(", nanosec: 0", ""),
        // As PyYAML breaks long lists: YAML 1.1 alone reads it.
        wrapped("goal:\n  trajectory:\n", 4, "  path_tolerance: []\n")
            .replace("joint_4, joint_5", "joint_4,\n  joint_5"),
        wrapped("trajectory:\n", 2, "path_tolerance: [ # a [ note\n]\n").replace(
            "[1.3, 0.6, 0.0, 0.0, 0.0, 0.0], time_from_start: {sec: 2",
            "[1.3, 0.6,\n0.0, 0.0, # it's {\n0.0, 0.0], time_from_start: {\nsec: 2",
        ),
        // As the command line of ROS 1 takes durations.
        trajectory(0, 1.3)
            .replace("{sec: 0, nanosec: 0}", "[0, 0]")
            .replace("{sec: 2, nanosec: 0}", "[2.0, 0.0]"),
        format!(
            "{{header: {{}}, goal_id: {{}}, goal: {{trajectory: {{{NAMES}, points: [{{positions: [0, 0.6, 0, 0, 0, 0], time_from_start: [0, 0]}}, \
                 {{positions: [1.3, 0.6, 0, 0, 0, 0], time_from_start: [2, 0]}}]}}}}}}\n"
        ),
    ] {
        assert_eq!(read("a.yaml", &text), plain, "{text}");
    }
    let aliased = trajectory(0, 1.3).replacen("[0.0, 0.6, 0.0, 0.0, 0.0, 0.0]", "&q [0.0, 0.6, 0.0, 0.0, 0.0, 0.0]", 1);
    let aliased = aliased.replacen("[1.3, 0.6, 0.0, 0.0, 0.0, 0.0]", "*q", 1);
    assert_eq!(read("a.yaml", &aliased).motion.pieces()[0].q_rad[1][1], 0.6);
    let json = r#"{"op": "publish", "topic": "/t", "msg": {"joint_names": ["joint_1", "joint_2", "joint_3", "joint_4", "joint_5", "joint_6"],
        "points": [{"positions": [0, 0.6, 0, 0, 0, 0], "velocities": [], "time_from_start": {"sec": 0}},
                   {"positions": [1.3, 0.6, 0, 0, 0, 0], "time_from_start": {"sec": 2, "nanosec": 0}}]}}"#;
    assert_eq!(read("A.JSON", json), plain);
}

#[test]
fn statements_around_a_trajectory_are_named() {
    let display = |start: &str| {
        let head = "trajectory:\n- joint_trajectory:\n";
        read("a.yaml", &wrapped(head, 4, &format!("trajectory_start:\n{start}")))
    };
    let planned = |more: &str| {
        read(
            "a.yaml",
            &wrapped(&format!("{more}trajectory:\n  joint_trajectory:\n"), 4, ""),
        )
    };
    for (found, words) in [
        (
            display("  joint_state: {name: [joint_2], position: [0.5]}\n"),
            "joint \"joint_2\" at 0.5, its first point at 0.6",
        ),
        (
            display("  joint_state: {name: [finger], position: [0.02]}\n"),
            "joints that the arm does not have: \"finger\"",
        ),
        (
            display("  attached_collision_objects: [{link_name: link_6}]\n"),
            "attaches 1 object to the arm, which is not judged",
        ),
        (
            display(
                "  multi_dof_joint_state: {joint_names: [base], transforms: [{translation: {x: 0.5, y: 0.0, z: 0.0}}]}\n",
            ),
            "state the place with --mount",
        ),
        (planned("error_code: {val: -4}\n"), "its error_code is -4"),
        (
            read(
                "a.yaml",
                &wrapped("fraction: 0.7\nsolution:\n  joint_trajectory:\n", 4, ""),
            ),
            "its fraction is 0.7",
        ),
        (
            read(
                "a.yaml",
                &wrapped(
                    "executed_trajectory: {joint_trajectory: {points: [{}]}}\nplanned_trajectory:\n  joint_trajectory:\n",
                    4,
                    "",
                ),
            ),
            "its executed_trajectory is not judged",
        ),
    ] {
        assert_eq!(found.notes.len(), 1, "{:?}", found.notes);
        assert!(found.notes[0].contains(words), "{words}: {:?}", found.notes);
    }
    // The identity places nothing.
    let identity = "{translation: {x: 0.0, y: 0, z: 0.0}, rotation: {x: 0.0, y: 0.0, z: 0.0, w: 1.0}}";
    let at_rest = display(&format!(
        "  multi_dof_joint_state: {{joint_names: [base], transforms: [{identity}]}}\n"
    ));
    assert!(at_rest.notes.is_empty());
}

#[test]
fn several_trajectories_are_read_in_order() {
    let two = format!("{}---\n{}---\n", trajectory(0, 1.3), trajectory(0, 0.2));
    let display = format!(
        "trajectory:\n- joint_trajectory:\n{}- joint_trajectory:\n{}",
        trajectory(4, 1.3),
        trajectory(4, 0.2)
    );
    for text in [two.clone(), display] {
        let all = read_all("a.yaml", &text).unwrap();
        let ends: Vec<_> = all.iter().map(|motion| motion.motion.pieces()[0].q_rad[1][0]).collect();
        assert_eq!(ends, [1.3, 0.2]);
    }
    let arm = RobotModel::irb120().unwrap();
    let one = TrajectoryFile::read("a.yaml", &two, &arm, &FixedJoints::new()).unwrap_err();
    assert_eq!(
        one.to_string(),
        "a.yaml:8: expected one trajectory; found 2, the last of them here"
    );
}

/// joint_trajectory_controller moves straight where a point states no speeds.
#[test]
fn speeds_at_some_points_count_between_those_points() {
    let point = |second: u32, more: &str| {
        format!(
            "- {{positions: [0.{second}, 0.6, 0.0, 0.0, 0.0, 0.0], {more}time_from_start: {{sec: {second}, nanosec: 0}}}}\n"
        )
    };
    let (slow, none) = ("velocities: [0.05, 0.0, 0.0, 0.0, 0.0, 0.0], ", "velocities: [], ");
    let bent = format!("{slow}accelerations: [0.5, 0.0, 0.0, 0.0, 0.0, 0.0], ");
    let message = |points: &[&str]| {
        let points: String = (1..).zip(points).map(|(second, more)| point(second, more)).collect();
        read("a.yaml", &format!("{NAMES}\npoints:\n{points}"))
    };
    let found = message(&[slow, slow, none, slow, &bent, &bent]);
    let words: Vec<_> = found.shapes.iter().map(|shape| shape.word()).collect();
    assert_eq!(words, ["cubic", "linear", "linear", "cubic", "quintic"]);
    assert_eq!(found.interpolation(), Interpolation::Quintic);
    assert_eq!(
        found.notes,
        ["4 of 5 pieces are simpler than quintic, as some points state no speeds or accelerations"]
    );
    let speeds: Vec<_> = found.motion.pieces().iter().map(|piece| piece.qd_rad_s[0][0]).collect();
    assert_eq!((speeds[0], speeds[3]), (0.05, 0.05));
    assert!((speeds[1] - 0.1).abs() < 1e-12, "{speeds:?}");
    assert!(found.motion.pieces()[4].qdd_rad_s2.is_some() && found.motion.pieces()[3].qdd_rad_s2.is_none());
    assert!(!found.rests_outside());
    let lines = message(&[slow, none, slow]);
    assert!(lines.rests_outside());
    assert_eq!(
        lines.notes,
        ["2 of 2 pieces are simpler than cubic, as some points state no speeds"]
    );
    let alone = format!(
        "{NAMES}\npoints:\n{}",
        point(1, "accelerations: [0.5, 0.0, 0.0, 0.0, 0.0, 0.0], ")
    );
    assert!(error(&alone).contains("a.yaml:3: expected velocities beside the accelerations"));
}

#[test]
fn other_messages_are_refused_by_name() {
    let unread = |text: &str, words: &str| {
        let found = error(text);
        assert!(found.contains(words) && found.len() < 500, "{words}: {found}");
    };
    unread(
        "name: [joint_1]\nposition: [0.0]\nvelocity: []\n",
        "positions of a JointState, which are no trajectory",
    );
    unread(
        "a: 1\nb: 2\nc: 3\nd: 4\ne: 5\nf: 6\ng: 7\n",
        "found the keys \"a\", \"b\", \"c\", \"d\", \"e\", \"f\", …",
    );
    unread(
        "op: subscribe\ntopic: /t\n",
        "whose op is publish or send_action_goal; found \"subscribe\"",
    );
    unread(
        &wrapped("op: publish\ncompress: 1\nmsg:\n", 2, ""),
        "a rosbridge message with op, id, topic, type, latch, queue_size, queue_length, msg; found the key \"compress\"",
    );
    unread(
        &wrapped("model: irb120\ntrajectory:\n- joint_trajectory:\n", 4, ""),
        "a DisplayTrajectory with model_id, trajectory, trajectory_start; found the key \"model\"",
    );
    unread(
        "trajectory: []\n",
        "expected a trajectory in the DisplayTrajectory; found none",
    );
    unread(
        &wrapped(
            "trajectory:\n- multi_dof_joint_trajectory: {joint_names: [base], points: [{time_from_start: {sec: 1}}]}\n  joint_trajectory:\n",
            4,
            "",
        ),
        "found points of one",
    );
    unread(
        &wrapped(
            "trajectory:\n- joint_trajectory:\n",
            4,
            "trajectory_start: {joint_state: {name: [a, b], position: [0.0]}}\n",
        ),
        "as many positions as names in the joint_state, 2; found 1",
    );
    unread("", "expected a message; found nothing");
    for list in ["[0.5, 0]", "[1]", "[1, -1]", "[1, 0, 0]", "[a, 0]"] {
        let text = trajectory(0, 1.3).replace("{sec: 2, nanosec: 0}", list);
        unread(
            &text,
            "a.yaml:4: expected a Duration [secs, nsecs] of two whole numbers",
        );
    }
    let one: String = trajectory(0, 1.3)
        .lines()
        .take(3)
        .map(|line| format!("{line}\n"))
        .collect();
    unread(
        &one,
        "found 1: where the arm moves from is not stated; add it as the first point",
    );
    unread("---\n---\n", "expected a message; found nothing");
    unread("a: &a [*a]\n", "an alias of a value that contains it");
    // Brackets within words begin nothing.
    unread("header: {frame_id: a}\n b: [1\nc: 2]\n", "a.yaml:2: not YAML");
    unread(
        &wrapped("trajectory:\n  header: {frame_id: 'a [b'}\n d: [\n", 2, ""),
        "not YAML",
    );
    // Aliases do not multiply a text without bounds.
    let bomb: String = (0..14)
        .map(|k| match k {
            0 => "- &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n".to_owned(),
            k => format!("- &a{k} [{}]\n", vec![format!("*a{}", k - 1); 10].join(", ")),
        })
        .collect();
    unread(&bomb, "aliases written out; found more");
    let deep: String = (0..40)
        .map(|k| match k {
            0 => "- &a0 [[[[1]]]]\n".to_owned(),
            k => format!("- &a{k} [[[[*a{}]]]]\n", k - 1),
        })
        .collect();
    unread(&deep, "aliases written out; found more");
}
