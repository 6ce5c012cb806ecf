//! Trajectories of any planner, proved or not.

use super::other_arms::UR5;
use super::*;

const POST: &str =
    "[[obstacle]]\nname = \"post\"\nshape = \"box\"\nsize_m = [0.04, 0.04, 0.6]\nat_m = [0.35, 0.25, 0.3]\n";

/// Joint 1 turns from 0 to 1.3 rad with the arm bent forward; a post stands between.
const SWING: &str = "t_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n0.5,0,0.6,0,0,0,0\n2.5,1.3,0.6,0,0,0,0\n";

fn write(dir: &Path, name: &str, text: &str) -> String {
    std::fs::write(dir.join(name), text).unwrap();
    name.to_owned()
}

fn prove(dir: &Path, arguments: &[&str]) -> CommandOutput {
    platewash(dir, &[&["prove-motion"], arguments].concat())
}

#[test]
fn a_motion_without_obstacles_is_proved() {
    let folder = folder();
    let dir = folder.path();
    let file = write(dir, "swing.csv", SWING);
    let found = prove(dir, &[&file]).done();
    assert!(
        found.stdout.starts_with("PROVED: a motion through 2 points over 2 s"),
        "{}",
        found.stdout
    );
    assert!(
        found.stdout.contains("(5 mm required)") && found.stdout.contains("no floor"),
        "{}",
        found.stdout
    );
    let data = prove(dir, &[&file, "--json", "--clearance", "0"]).done().json();
    assert_eq!(
        (&data["verdict"], &data["interpolation"]),
        (&"proved".into(), &"linear".into())
    );
    assert_eq!(data["span_s"], serde_json::json!([0.5, 2.5]));
    assert_eq!(names(dir), ["swing.csv"], "no file is written");
}

#[test]
fn a_collision_between_two_clear_points_is_found() {
    let folder = folder();
    let dir = folder.path();
    let (file, around) = (write(dir, "swing.csv", SWING), write(dir, "post.toml", POST));
    let found = prove(dir, &[&file, "--obstacles", &around]);
    assert_eq!(found.code, 4, "{}", found.stderr);
    for words in [
        "BROKEN: ",
        "and post touch (5 mm required)",
        "of the way from point 0 to point 1; at the points all is clear",
    ] {
        assert!(found.stdout.contains(words), "{words}: {}", found.stdout);
    }
    let data = prove(dir, &[&file, "--obstacles", &around, "--json"]).json();
    assert_eq!(
        (&data["verdict"], &data["only_between_points"]),
        (&"broken".into(), &true.into())
    );
    let rules = data["rules"].as_array().unwrap();
    let clearance = rules.iter().find(|rule| rule["requirement"] == "clearance").unwrap();
    let time_s = clearance["worst"]["time_s"].as_f64().unwrap();
    let q1 = clearance["worst"]["q_rad"][0].as_f64().unwrap();
    assert!(
        (q1 - 1.3 * (time_s - 0.5) / 2.0).abs() < 1e-9 && q1 > 0.1 && q1 < 1.2,
        "{clearance}"
    );
    // A turn the other way keeps clear of it.
    let away = write(dir, "away.csv", &SWING.replace("1.3", "-1.3"));
    prove(dir, &[&away, "--obstacles", &around]).done();
}

#[test]
fn limits_that_are_broken_are_named() {
    let folder = folder();
    let dir = folder.path();
    let file = write(dir, "far.csv", &SWING.replace("1.3", "3.2"));
    let found = prove(dir, &[&file]);
    assert_eq!(found.code, 4);
    assert!(
        found.stdout.starts_with("BROKEN: joint_1 is at 3.2"),
        "{}",
        found.stdout
    );
    let file = write(dir, "fast.csv", &SWING.replace("\n2.5", "\n0.6"));
    let found = prove(dir, &[&file]);
    assert!(
        found.stdout.starts_with("BROKEN: joint speed of joint_1 is 13"),
        "{}",
        found.stdout
    );
    // Corners of straight lines have no acceleration limit, and neither have their ends, before and behind which the arm rests.
    let found = prove(dir, &[&write(dir, "ends.csv", SWING), "--acceleration-limits", "100"]);
    assert!(
        found.stdout.starts_with("BROKEN: the speed of joint_1 jumps at 0.5 s"),
        "{}",
        found.stdout
    );
    let still = SWING.replace("\n0.5", "\n0,0,0.6,0,0,0,0\n0.5");
    let file = write(dir, "corner.csv", &format!("{still}3.5,1.3,0.6,0,0,0,0\n"));
    prove(dir, &[&file]).done();
    let found = prove(dir, &[&file, "--acceleration-limits", "100"]);
    assert!(
        found.stdout.starts_with("BROKEN: the speed of joint_1 jumps at 0.5 s"),
        "{}",
        found.stdout
    );
}

#[test]
fn points_without_times_are_judged_for_any_timing() {
    let folder = folder();
    let dir = folder.path();
    let text = SWING.replace("t_s,", "").replace("0.5,", "").replace("2.5,", "");
    let file = write(dir, "path.csv", &text);
    let found = prove(dir, &[&file]).done();
    assert!(
        found.stdout.contains("for any timing") && !found.stdout.contains("joint speed"),
        "{}",
        found.stdout
    );
    let around = write(dir, "post.toml", POST);
    let found = prove(dir, &[&file, "--obstacles", &around]);
    assert!(found.code == 4 && !found.stdout.contains(" s, "), "{}", found.stdout);
    prove(dir, &[&file, "--acceleration-limits", "100"]).refused(2, &["has no times"]);
    prove(dir, &[&file, "--interpolation", "cubic"]).refused(2, &["path.csv:2", "no times"]);
}

/// The motion of a plan, as the export writes it for ROS 2, is its own cubic.
#[test]
fn ros_messages_of_another_arm_are_read_by_joint_names() {
    let folder = folder();
    let dir = folder.path();
    let message = |last: f64, names: &str| {
        let point = |q: f64, t: u32| {
            format!(
                "- positions: [{q}, -1.5, 1.5, -1.5, -1.5, 0]\n  velocities: [0, 0, 0, 0, 0, 0]\n  time_from_start: {{sec: {t}, nanosec: 0}}\n"
            )
        };
        format!("joint_names: [{names}]\npoints:\n{}{}", point(0.0, 0), point(last, 3))
    };
    let names = "shoulder_pan, shoulder_lift, elbow, wrist_1_joint, wrist_2_joint, wrist_3_joint";
    let file = write(dir, "ur5.yaml", &message(1.0, names));
    let found = prove(dir, &[&file, "--urdf", UR5]).done();
    assert!(found.stdout.contains("cubic motion"), "{}", found.stdout);
    // Limits of acceleration: a cubic between two rests begins with 6 q / h².
    prove(dir, &[&file, "--urdf", UR5, "--acceleration-limits", "0.67,1,1,1,1,1"]).done();
    let found = prove(dir, &[&file, "--urdf", UR5, "--acceleration-limits", "0.66,1,1,1,1,1"]);
    assert!(
        found.code == 4 && found.stdout.starts_with("BROKEN: joint acceleration of shoulder_pan"),
        "{}",
        found.stdout
    );
    // With accelerations it is a quintic: this one, at rest at both ends, accelerates by up to 5.78 q / h².
    let zeros = "[0, 0, 0, 0, 0, 0]";
    let timed = message(1.0, names).replace("  time_from", &format!("  accelerations: {zeros}\n  time_from"));
    let file = write(dir, "timed.yaml", &timed);
    let found = prove(dir, &[&file, "--urdf", UR5, "--acceleration-limits", "0.642,1,1,1,1,1"]).done();
    assert!(found.stdout.contains("quintic motion"), "{}", found.stdout);
    let found = prove(dir, &[&file, "--urdf", UR5, "--acceleration-limits", "0.641,1,1,1,1,1"]);
    assert_eq!(found.code, 4, "{}", found.stdout);
    prove(dir, &[&file, "--urdf", UR5, "--interpolation", "linear"]).done();
    // The trajectory of another arm.
    prove(dir, &[&file]).refused(
        2,
        &["timed.yaml:1", "joint_1", "\"shoulder_pan\", which is none of them"],
    );
}

/// One obstacle, in MoveIt's words and in ours.
#[test]
fn planning_scenes_are_obstacles() {
    let folder = folder();
    let dir = folder.path();
    let file = write(dir, "swing.csv", SWING);
    let scene = write(
        dir,
        "post.scene",
        "(noname)+\n* post\n0 0 0\n0 0 0 1\n1\nbox\n0.04 0.04 0.6\n0.35 0.25 0.3\n0 0 0 1\n0 0 0 0\n0\n.\n",
    );
    let around = write(dir, "post.toml", POST);
    let clearance = |around: &str| prove(dir, &[&file, "--obstacles", around, "--json"]).json()["clearance"].clone();
    assert_eq!(clearance(&scene), clearance(&around));
    write(dir, "bad.scene", "s\n* post\n1\nbox\n0.04 0.04\n");
    prove(dir, &[&file, "--obstacles", "bad.scene"]).refused(2, &["error: bad.scene, line 6", "three sizes"]);
}

#[test]
fn the_arm_stands_at_its_mount_and_carries_its_tool() {
    let folder = folder();
    let dir = folder.path();
    let (file, around) = (write(dir, "swing.csv", SWING), write(dir, "post.toml", POST));
    let data = |more: &[&str]| prove(dir, &[&[&file[..], "--obstacles", &around, "--json"], more].concat()).json();
    // Turned by 90° at the same place, the arm swings away from the post; and one that moves with the post meets it.
    assert_eq!(data(&["--mount", "0,0,0,0,0,-90"])["verdict"], "proved");
    assert_eq!(data(&["--mount", "0.2,0,0"])["verdict"], "broken");
    let moved = write(dir, "moved.toml", &POST.replace("0.35, 0.25, 0.3", "-0.25, 1.35, 0.8"));
    let there = prove(dir, &[&file, "--obstacles", &moved, "--mount=0,1,0.5,0,0,90", "--json"]).json();
    let here = data(&[]);
    let worst = |data: &serde_json::Value| data["rules"].as_array().unwrap().last().unwrap().clone();
    assert_eq!(worst(&there)["pair"], worst(&here)["pair"]);
    let gap = worst(&there)["measure"]["seen"].as_f64().unwrap() - worst(&here)["measure"]["seen"].as_f64().unwrap();
    assert!(gap.abs() < 1e-6, "{gap}");
    let tool = write(dir, "tool.toml", "[tool]\nlength_m = 0.2\n");
    let found = prove(dir, &[&file, "--tool", &tool]).done();
    assert!(found.stdout.contains("a tool: handle, sponge."), "{}", found.stdout);
    let arm_alone = prove(dir, &[&file, "--json"]).json()["clearance"]
        .as_array()
        .unwrap()
        .len();
    let with_tool = prove(dir, &[&file, "--tool", &tool, "--json"]).json()["clearance"]
        .as_array()
        .unwrap()
        .len();
    assert!(with_tool > arm_alone);
    prove(dir, &[&file, "--tool", &around]).refused(2, &["error: post.toml, line 1", "[tool] and [[tool_body]]"]);
    prove(dir, &[&file, "--mount", "1,2"]).refused(2, &["--mount", "x, y, z in metres"]);
}

/// The controller of this arm counts from 0.3 m above its root link: a mount says for which of the two it is.
#[test]
fn a_mount_says_for_which_link_it_is() {
    let folder = folder();
    let dir = folder.path();
    let old = "<child link=\"base\"/>\n    <origin xyz=\"0 0 0\"/>";
    let arm = platewash::kinematics::irb120::IRB120_URDF.replace(old, &old.replace("0 0 0", "0 0 0.3"));
    let (file, arm) = (write(dir, "swing.csv", SWING), write(dir, "arm.urdf", &arm));
    let around = write(dir, "post.toml", POST);
    let proved = |more: &[&str]| {
        prove(
            dir,
            &[&[&file[..], "--urdf", &arm, "--obstacles", &around, "--json"], more].concat(),
        )
    };
    proved(&["--mount", "0,0,0.3"]).refused(
        2,
        &[
            "--mount, --mount-link: the root link 'base_link' and the controller's base, 'base',",
            "As \"root\" link 'base_link' stands at (0.0000, 0.0000, 0.3000) m in the world, as \"base\" at (0.0000, 0.0000, 0.0000) m",
        ],
    );
    let [at_origin, of_base] = [
        proved(&[]).json(),
        proved(&["--mount", "0,0,0.3", "--mount-link", "base"]).json(),
    ];
    assert_eq!(at_origin["clearance"], of_base["clearance"]);
    let of_root = proved(&["--mount", "0,0,0.3", "--mount-link", "root"]).json();
    assert_ne!(at_origin["clearance"], of_root["clearance"]);
    let said = at_origin["assumptions"].to_string();
    assert!(
        said.contains("stands at the mount; the controller counts from link 'base'"),
        "{said}"
    );
}

/// A gripper of the description is held still; a joint of the arm that the trajectory leaves out, too.
#[test]
fn joints_that_do_not_move_are_fixed() {
    let folder = folder();
    let dir = folder.path();
    let finger = "<link name=\"finger\"><collision><geometry><box size=\"0.02 0.02 0.1\"/></geometry></collision></link>\
                  <joint name=\"slide\" type=\"prismatic\"><parent link=\"wrist_3\"/><child link=\"finger\"/>\
                  <origin xyz=\"0 0 0.2\"/><axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"0.1\" velocity=\"1\"/></joint></robot>";
    let arm = std::fs::read_to_string(UR5).unwrap().replace("</robot>", finger);
    let arm = write(dir, "arm.urdf", &arm);
    let table = "shoulder_pan,shoulder_lift,elbow,wrist_1_joint,wrist_2_joint,slide\n0,-1.5,1.5,-1.5,-1.5,0.05\n1,-1.5,1.5,-1.5,-1.5,0.05\n";
    let file = write(dir, "path.csv", table);
    let found = prove(
        dir,
        &[
            &file,
            "--urdf",
            &arm,
            "--fix",
            "slide=0.05",
            "--fix",
            "wrist_3_joint=-0.5",
        ],
    )
    .done();
    assert!(
        found
            .stdout
            .contains("These joints do not move: slide at 0.05, wrist_3_joint at -0.5."),
        "{}",
        found.stdout
    );
    let all = ["--urdf", &arm, "--fix", "slide=0.05"];
    prove(dir, &[&[&file[..]], &all[..2]].concat())
        .refused(2, &["arm.urdf", "'slide' is prismatic", "--fix slide=VALUE"]);
    prove(dir, &[&[&file[..]], &all[..]].concat()).refused(2, &["path.csv:1", "\"wrist_3_joint\" is missing"]);
    prove(dir, &[&file, "--urdf", &arm, "--fix", "slide=0.2"])
        .refused(2, &["'slide' is fixed at 0.2, beyond its limits 0 … 0.1"]);
    prove(dir, &[&file, "--fix", "slide"]).refused(2, &["--fix", "finger_joint=0.02"]);
}

#[test]
fn a_page_shows_the_motion_and_the_worst_place() {
    let folder = folder();
    let dir = folder.path();
    let (file, around) = (write(dir, "swing.csv", SWING), write(dir, "post.toml", POST));
    let found = prove(dir, &[&file, "--obstacles", &around, "--page", "motion.html"]);
    assert_eq!(found.code, 4, "{}", found.stderr);
    let page = std::fs::read_to_string(dir.join("motion.html")).unwrap();
    assert!(page.contains("BROKEN: ") && page.contains("swing.csv") && page.len() > 100_000);
}

#[test]
fn bad_input_is_refused_with_file_and_line() {
    let folder = folder();
    let dir = folder.path();
    let good = write(dir, "good.csv", SWING);
    write(dir, "nan.csv", &SWING.replace("1.3", "NaN"));
    write(dir, "back.csv", &SWING.replace("2.5", "0.25"));
    write(dir, "degrees.csv", &SWING.replace("1.3", "75"));
    write(dir, "one.csv", &SWING[..SWING.len() - 19]);
    write(dir, "post.toml", &POST.replace("at_m", "at"));
    write(dir, "scenario.toml", "[wash]\nturns = 3\n");
    write(dir, "empty.toml", "# nothing yet\n");
    let cases: [(&[&str], &[&str]); 14] = [
        (
            &[&good, "--obstacles", "empty.toml"],
            &["error: empty.toml: expected obstacles; found none"],
        ),
        (&["none.csv"], &["none.csv: cannot be read"]),
        (&["nan.csv"], &["nan.csv:3: column 2 (q1_rad)", "\"NaN\""]),
        (&["back.csv"], &["back.csv:3: column 1 (t_s)", "must come after 0.5 s"]),
        (
            &["degrees.csv"],
            &["degrees.csv:3: point 1: joint joint_1 at 75 rad", "look like degrees"],
        ),
        (&["one.csv"], &["one.csv:"]),
        (&["post.toml"], &["post.toml:1", "another name"]),
        (
            &[&good, "--obstacles", "post.toml"],
            &["error: post.toml, line 5", "obstacle[0]"],
        ),
        (
            &[&good, "--obstacles", "scenario.toml"],
            &["scenario.toml, line 1", "[[obstacle]]"],
        ),
        (&[&good, "--obstacles", "none.toml"], &["none.toml", "cannot be read"]),
        (&[&good, "--urdf", "none.urdf"], &["none.urdf: cannot be read"]),
        (&[&good, "--scenario", "kitchen"], &["--scenario", "leave it out"]),
        (&[&good, "--clearance", "-1"], &["--clearance", "from 0 to 1"]),
        (
            &[&good, "--acceleration-limits", "1,2"],
            &["--acceleration-limits", "six between commas"],
        ),
    ];
    for (arguments, words) in cases {
        prove(dir, arguments).refused(2, words);
    }
}

/// The last point is passed at 3 rad/s. By hand: at 100 rad/s² it takes 45 mrad more to stop, and a post stands 16 mrad behind.
#[test]
fn a_motion_that_ends_at_speed_stops_or_says_so() {
    let folder = folder();
    let dir = folder.path();
    let point = |q: f64, v: f64, ns: u32| {
        format!(
            "- {{positions: [{q}, 0.6, 0, 0, 0, 0], velocities: [{v}, 0, 0, 0, 0, 0], time_from_start: {{sec: 1700000000, nanosec: {ns}}}}}\n"
        )
    };
    let message = format!(
        "joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]\npoints:\n{}{}",
        point(0.0, 0.0, 1),
        point(0.3, 3.0, 200_000_001)
    );
    let file = write(dir, "end.yaml", &message);
    let post =
        "[[obstacle]]\nname = \"post\"\nshape = \"box\"\nsize_m = [0.04, 0.04, 0.6]\nat_m = [0.409, 0.232, 0.3]\n";
    let around = write(dir, "post.toml", post);
    let found = prove(dir, &[&file, "--obstacles", &around]).done().stdout;
    assert!(
        found
            .lines()
            .next()
            .unwrap()
            .ends_with("; it ends at 3 rad/s, and what follows is not judged"),
        "{found}"
    );
    assert!(
        found.contains("from 1700000000.000000001 s to 1700000000.200000001 s"),
        "{found}"
    );
    let stopped = ["--obstacles", &around, "--acceleration-limits", "100"];
    let found = prove(dir, &[&[&*file], &stopped[..]].concat()).stdout;
    let first = found.lines().next().unwrap();
    assert!(
        first.starts_with("BROKEN: link_4 and post touch")
            && first.contains(" s after the last point, while the arm stops"),
        "{first}"
    );
    // Alone it is proved, the stop included, and a page shows it.
    let words = [&*file, "--acceleration-limits", "100", "--json", "--page", "page.html"];
    let data = prove(dir, &words).done().json();
    assert_eq!(data["end_speeds_rad_s"], serde_json::json!([0.0, 3.0]));
    assert!((data["stop_s"].as_f64().unwrap() - 0.03).abs() < 1e-6, "{data}");
    assert!(
        data["headline"]
            .as_str()
            .unwrap()
            .ends_with("; it ends at 3 rad/s and stops within 0.03 s, judged, too"),
        "{data}"
    );
}

#[test]
fn numbers_of_usual_rounding_are_readable() {
    let folder = folder();
    let dir = folder.path();
    let file = write(
        dir,
        "tiny.csv",
        &SWING.replace(",0,0,0,0\n", ",0,0,-6.1e-17,6.9e-310\n"),
    );
    let found = prove(dir, &[&file]).done().stdout;
    assert!(
        found.contains("joint positions there [rad]: 0.65, 0.6, 0, 0, 0, 0\n"),
        "{found}"
    );
}

fn both_with_stamp(first: &str, second: &str) -> String {
    format!("{first}header: {{stamp: {{sec: 5, nanosec: 0}}, frame_id: ''}}\n{second}")
}

/// A document of YAML each, of which the second runs into the post.
#[test]
fn each_trajectory_of_a_file_is_judged() {
    let folder = folder();
    let dir = folder.path();
    let message = |to: f64| {
        format!(
            "joint_names: [joint_1, joint_2, joint_3, joint_4, joint_5, joint_6]\npoints:\n- positions: [0.0, 0.6, 0.0, 0.0, 0.0, 0.0]\n  \
             time_from_start: {{sec: 0, nanosec: 0}}\n- positions: [{to:?}, 0.6, 0.0, 0.0, 0.0, 0.0]\n  time_from_start: {{sec: 2, nanosec: \
             0}}\n---\n"
        )
    };
    let around = write(dir, "post.toml", POST);
    let both = write(dir, "both.yaml", &[message(-1.3), message(1.3)].concat());
    let found = prove(dir, &[&both, "--obstacles", &around]);
    assert_eq!(found.code, 4, "{}", found.stderr);
    let lines: Vec<_> = found.stdout.lines().collect();
    assert!(
        lines[0].starts_with("BROKEN: trajectory 2 of 2 (line 10): link_4 and post touch"),
        "{}",
        found.stdout
    );
    assert!(
        lines[1].starts_with("  trajectory 1 (line 3): PROVED: "),
        "{}",
        found.stdout
    );
    assert!(
        lines[2].starts_with("  trajectory 2 (line 10): BROKEN: "),
        "{}",
        found.stdout
    );
    let data = prove(dir, &[&both, "--obstacles", &around, "--json"]).json();
    let verdicts: Vec<_> = data["trajectories"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| &one["verdict"])
        .collect();
    assert_eq!(verdicts, ["proved", "broken"]);
    assert_eq!(data["proved"], false);
    let details = prove(dir, &[&both, "--obstacles", &around, "--details"]).stdout;
    assert!(
        details.contains("trajectory 1 (line 3)\nPROVED: ") && details.contains("clearance of each pair [mm]"),
        "{details}"
    );
    prove(dir, &[&both, "--page", "page.html"]).refused(2, &["--page: both.yaml", "found 2"]);
    let stamped = both_with_stamp(&message(-1.3), &message(1.3));
    let stamped = write(dir, "stamped.yaml", &stamped);
    let first = prove(dir, &[&stamped]).done().stdout;
    assert!(
        first
            .lines()
            .next()
            .unwrap()
            .contains("; trajectory 2: its header.stamp is 5 s"),
        "{first}"
    );
    let alone = prove(dir, &[&both]).done().stdout;
    assert!(
        alone.starts_with("PROVED: 2 trajectories, each by itself; how the arm gets from the end of one to the start of the next is not"),
        "{alone}"
    );
}

/// A closed cell as one mesh: its walls are parts of their own, and where parts fill it the first line says so.
#[test]
fn a_mesh_that_fills_the_cell_of_the_arm_is_named() {
    let folder = folder();
    let dir = folder.path();
    let swing = write(dir, "swing.csv", SWING);
    // A shell of eight sides, its outer and its inner surface.
    let (mut corners, mut triangles) = (String::new(), String::new());
    for (shell, (radius, [low, high])) in [(1.6, [-0.8, 2.3]), (1.5, [-0.75, 2.25])].into_iter().enumerate() {
        for (z, k) in [low, high].into_iter().flat_map(|z| (0..8).map(move |k| (z, k))) {
            let (sin, cos) = (0.25 * std::f64::consts::PI * f64::from(k) + 0.2).sin_cos();
            corners += &format!("{} {} {z}\n", radius * cos, radius * sin);
        }
        corners += &format!("0 0 {low}\n0 0 {high}\n");
        for k in 0..8 {
            let (k, n, first) = (k, (k + 1) % 8, 18 * shell);
            for mut face in [[k, n, 8 + n], [k, 8 + n, 8 + k], [n, k, 16], [8 + k, 8 + n, 17]] {
                if shell == 1 {
                    face.swap(1, 2);
                }
                triangles += &face.map(|corner| (first + corner).to_string()).join(" ");
                triangles += "\n";
            }
        }
    }
    let scene =
        format!("s\n* cell\n0 0 0\n0 0 0 1\n1\nmesh\n36 64\n{corners}{triangles}0 0 0\n0 0 0 1\n0 0 0 0\n0\n.\n");
    let scene = write(dir, "cell.scene", &scene);
    let found = prove(dir, &[&swing, "--obstacles", &scene]);
    assert_eq!(found.code, 4, "{}", found.stderr);
    let first = found.stdout.lines().next().unwrap();
    assert!(first.starts_with("BROKEN: cell reaches "), "{first}");
    assert!(
        first.contains("; \"cell\" counts as convex parts, which reach up to ")
            && first.ends_with("cut the mesh into several closed bodies, or state boxes in its place"),
        "{first}"
    );
    let data = prove(dir, &[&swing, "--obstacles", &scene, "--json"]).json();
    assert!(
        data["notes"][0].as_str().unwrap().contains("it may fill a hollow"),
        "{}",
        data["notes"]
    );
}
