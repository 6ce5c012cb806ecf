//! Other arms: files and what is wrong with them.

use super::*;
use std::time::{Duration, Instant};

#[test]
fn broken_arms_are_refused_by_name() {
    let folder = folder();
    let dir = folder.path();
    let urdf = platewash::kinematics::irb120::IRB120_URDF;
    let case = |text: &str| {
        std::fs::write(dir.join("arm.urdf"), text).unwrap();
        platewash(dir, &["robot", "--urdf", "arm.urdf"])
    };
    case(urdf).done();
    case(&urdf[..urdf.len() / 2]).refused(2, &["arm.urdf", "cut off"]);
    let nested = format!(
        "<robot name=\"deep\">{}{}</robot>",
        "<link name=\"a\">".repeat(20_000),
        "</link>".repeat(20_000)
    );
    case(&nested).refused(2, &["arm.urdf", "nests"]);
    case("").refused(2, &["arm.urdf", "<robot>"]);
    case(&urdf.replace(
        "name=\"joint_3\" type=\"revolute\"",
        "name=\"joint_3\" type=\"prismatic\"",
    ))
    .refused(2, &["joint_3", "prismatic"]);
    platewash(dir, &["robot", "--urdf", "nowhere.urdf"]).refused(2, &["nowhere.urdf"]);
    platewash(dir, &["robot", "--package-path", "x"]).refused(2, &["--urdf"]);
}

#[test]
fn descriptions_too_large_to_check_are_refused_soon() {
    let folder = folder();
    let link = |k: usize| {
        format!(
            "<link name=\"l{k}\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision></link>\
             <joint name=\"j{k}\" type=\"fixed\"><parent link=\"link_6\"/><child link=\"l{k}\"/></joint>"
        )
    };
    let write = |count: usize| {
        let more: String = (0..count).map(link).collect();
        let urdf = platewash::kinematics::irb120::IRB120_URDF.replace("</robot>", &format!("{more}</robot>"));
        std::fs::write(folder.path().join("arm.urdf"), urdf).unwrap();
        let start = Instant::now();
        let ran = platewash(folder.path(), &["robot", "--urdf", "arm.urdf"]);
        assert!(start.elapsed() < Duration::from_secs(300), "{:?}", start.elapsed());
        ran
    };
    write(20_000).refused(2, &["arm.urdf", "<link>", "at most 1000"]);
    write(900).refused(2, &["arm.urdf", "<collision>", "at most 500"]);
    write(400).done();
}

/// Paths need not be text.
#[cfg(target_os = "linux")]
#[test]
fn accepts_any_path_of_the_system() {
    use std::os::unix::ffi::OsStrExt;
    let folder = folder();
    let path = OsStr::from_bytes(b"arm\xff.urdf");
    std::fs::write(folder.path().join(path), platewash::kinematics::irb120::IRB120_URDF).unwrap();
    let arguments = ["plan", "--out", ".", "--urdf"].map(OsStr::new);
    let ran = platewash_os(folder.path(), &[&arguments[..], &[path]].concat()).done();
    assert!(ran.stdout.contains("from home to home"), "{}", ran.stdout);
    let arguments = ["verify", "plan.json", "--urdf"].map(OsStr::new);
    platewash_os(folder.path(), &[&arguments[..], &[path]].concat()).done();
}

/// Meshes of ROS packages are found without an option, and what newcomers type leads to `--urdf`.
#[test]
fn packages_of_ros_are_found_and_arms_are_given_as_urdf() {
    let folder = folder();
    let dir = folder.path();
    std::fs::create_dir_all(dir.join("ws/support/urdf")).unwrap();
    std::fs::create_dir_all(dir.join("ws/support/meshes")).unwrap();
    let mesh = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
    std::fs::write(dir.join("ws/support/meshes/part.obj"), mesh).unwrap();
    let body = "<link name=\"tool0\"><collision><geometry><mesh filename=\"package://support/meshes/part.obj\"/></geometry></collision></link>";
    let urdf = platewash::kinematics::irb120::IRB120_URDF.replace("<link name=\"tool0\"/>", body);
    assert!(urdf.contains("part.obj"));
    std::fs::write(dir.join("ws/support/urdf/arm.urdf"), &urdf).unwrap();
    std::fs::write(dir.join("arm.urdf"), &urdf).unwrap();
    platewash(dir, &["robot", "--urdf", "ws/support/urdf/arm.urdf"]).done();
    platewash(dir, &["robot", "--urdf", "arm.urdf"]).refused(2, &[". and the folders above it", "--package-path"]);
    platewash(dir, &["robot", "--urdf", "arm.urdf", "--package-path", "ws"]).done();
    for (variable, value) in [("ROS_PACKAGE_PATH", "ws"), ("AMENT_PREFIX_PATH", "prefix")] {
        if variable == "AMENT_PREFIX_PATH" {
            std::fs::create_dir_all(dir.join("prefix")).unwrap();
            std::fs::rename(dir.join("ws"), dir.join("prefix/share")).unwrap();
        }
        let mut command = Command::new(env!("CARGO_BIN_EXE_platewash"));
        let ran = command
            .current_dir(dir)
            .args(["robot", "--urdf", "arm.urdf"])
            .env(variable, value)
            .output()
            .unwrap();
        assert!(
            ran.status.success(),
            "{variable}: {}",
            String::from_utf8_lossy(&ran.stderr)
        );
    }
    platewash(dir, &["run", "--arm", "ur5e.urdf"]).refused(2, &["--urdf ARM.urdf"]);
    platewash(dir, &["run", "ur5e.urdf"]).refused(2, &["'--urdf ur5e.urdf'"]);
    platewash(dir, &["run", "ur5e.urdf.xacro"]).refused(2, &["'--urdf ur5e.urdf.xacro'"]);
}

/// A stand-in for xacro prints the IRB 120 with the arguments as its name.
#[cfg(unix)]
#[test]
fn arms_are_found_by_name_and_xacro_files_are_expanded() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    let dir = folder.path();
    std::fs::create_dir_all(dir.join("bin")).unwrap();
    let stand_in = "#!/bin/sh\nfile=$1\nshift\n[ -z \"$BROKEN\" ] || { echo \"undefined $BROKEN\" >&2; exit 1; }\n\
                    sed \"s/name=\\\"irb120\\\"/name=\\\"$*\\\"/\" \"$file\"\n";
    std::fs::write(dir.join("bin/xacro"), stand_in).unwrap();
    std::fs::set_permissions(dir.join("bin/xacro"), PermissionsExt::from_mode(0o755)).unwrap();
    let urdf = platewash::kinematics::irb120::IRB120_URDF;
    let write = |path: &str, text: &str| {
        let path = dir.join(path);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    write("ws/maker_support/urdf/small5.xacro", urdf);
    write("ws/ur_description/urdf/ur.urdf.xacro", urdf);
    write("ws/ur_description/config/ur5e/physical_parameters.yaml", "");
    let path = std::env::join_paths([dir.join("bin"), "/usr/bin".into(), "/bin".into()]).unwrap();
    let run = |arguments: &[&str], variables: &[(&str, &OsStr)]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_platewash"));
        command
            .current_dir(dir)
            .args(arguments)
            .env_remove("ROS_PACKAGE_PATH")
            .env("PATH", &path);
        CommandOutput::of(command.envs(variables.iter().copied()).output().unwrap())
    };
    let (ws, none) = (("ROS_PACKAGE_PATH", OsStr::new("ws")), ("PATH", OsStr::new("")));
    let name =
        |arguments: &[&str]| run(&[&["robot", "--json"], arguments].concat(), &[ws]).done().json()["name"].clone();
    assert_eq!(name(&["--arm", "ur5e"]), "name:=ur5e ur_type:=ur5e");
    assert_eq!(name(&["--arm", "small5", "--xacro-arg", "colour:=red"]), "colour:=red");
    assert_eq!(name(&["--urdf", "ws/ur_description/urdf/ur.urdf.xacro"]), "");

    // Verify expands it again.
    run(&["plan", "--quiet", "--arm", "small5"], &[ws]).done();
    run(&["verify", "out/plan.json", "--arm", "small5"], &[ws]).done();

    run(&["robot", "--arm", "small5"], &[]).refused(2, &["--arm small5", "which are not set", "'--urdf ARM.urdf'"]);
    run(&["robot", "--arm", "small5"], &[ws, none]).refused(2, &["small5.xacro", "not installed", "pip install xacro"]);
    run(&["robot", "--arm", "small5"], &[ws, ("BROKEN", OsStr::new("side"))])
        .refused(2, &["small5.xacro", "undefined side", "--xacro-arg NAME:=VALUE"]);
    run(&["robot", "--xacro-arg", "a:=b"], &[]).refused(2, &["--xacro-arg", "--urdf FILE"]);
    write("other/small_description/robots/small5.urdf", urdf);
    let both = std::env::join_paths(["ws", "other"]).unwrap();
    run(&["robot", "--arm", "small5"], &[("ROS_PACKAGE_PATH", &both)])
        .refused(2, &["several descriptions", "small_description"]);
}

/// The IRB 120 with a hand that has a mesh as its only shape: without the option the hand is not checked, with it the plan says what
/// stands for the hand, and verify needs the option, too.
#[test]
fn visual_shapes_are_taken_by_name() {
    let folder = folder();
    let dir = folder.path();
    let cube = "v 0 -0.02 -0.02\nv 0 0.02 -0.02\nv 0 0.02 0.02\nv 0 -0.02 0.02\nv -0.01 -0.02 -0.02\nv -0.01 0.02 -0.02\n\
                v -0.01 0.02 0.02\nv -0.01 -0.02 0.02\nf 1 2 3\nf 1 3 4\nf 5 7 6\nf 5 8 7\n";
    std::fs::write(dir.join("hand.obj"), cube).unwrap();
    let text = platewash::kinematics::irb120::IRB120_URDF;
    let (before, after) = text.split_at(text.find("<collision name=\"link_6_sphere_1\">").unwrap());
    let (_, after) = after.split_once("</collision>").unwrap();
    let mesh = "<visual><geometry><mesh filename=\"hand.obj\"/></geometry></visual>";
    std::fs::write(dir.join("arm.urdf"), format!("{before}{mesh}{after}")).unwrap();
    let run = |verb: &[&str], more: &[&str]| platewash(dir, &[verb, &["--urdf", "arm.urdf"], more].concat());
    let said = run(&["robot"], &[]).done().stderr;
    assert!(
        said.contains("links without collision shapes, whose clearance is not checked (--visual-shapes")
            && said.contains("link_6"),
        "{said}"
    );
    let said = run(&["robot"], &["--visual-shapes"]).done().stderr;
    assert!(
        said.contains("visuals stand for the collision shapes of link_6"),
        "{said}"
    );
    // Links 4 and 6 are near each other in every configuration: the SRDF leaves them out.
    let near = run(&["plan"], &["--visual-shapes", "--quiet"]);
    assert_eq!(near.code, 3, "{}", near.stderr);
    assert!(
        near.stdout.contains("mm from link_6 (by convex shapes of meshes)"),
        "{}",
        near.stdout
    );
    std::fs::write(dir.join("arm.srdf"), platewash::kinematics::irb120::IRB120_SRDF).unwrap();
    let srdf = ["--srdf", "arm.srdf"];
    run(&["plan"], &[&srdf[..], &["--visual-shapes", "--quiet"]].concat()).done();
    let said = run(
        &["verify", "out/plan.json"],
        &[&srdf[..], &["--visual-shapes", "--details"]].concat(),
    )
    .done()
    .stdout;
    for part in [
        "links are within the convex hulls of their meshes: \"link_6\"",
        "links are within their visuals, as they have no collision shapes: \"link_6\"",
    ] {
        assert!(said.contains(part), "no {part} in {said}");
    }
    run(&["verify", "out/plan.json"], &srdf).refused(2, &["the plan is for the arm"]);
    platewash(dir, &["plan", "--visual-shapes"]).refused(2, &["--urdf"]);
}

/// The IRB 120 with a hand of two fingers as its last link: without the key the gap between them is full. The verdict, `robot` and
/// `prove-motion` say which links are split; verify takes them from the scenario or by the option.
#[test]
fn links_are_split_by_name() {
    let folder = folder();
    let dir = folder.path();
    let mut fingers = String::new();
    for (k, y) in [-0.02, 0.012].into_iter().enumerate() {
        for corner in 0..8 {
            let at = |axis: usize, low: f64, size: f64| if corner >> axis & 1 == 1 { low + size } else { low };
            fingers += &format!("v {} {} {}\n", at(0, -0.01, 0.01), at(1, y, 0.008), at(2, -0.02, 0.04));
        }
        for [a, b, c, d] in [
            [1, 3, 4, 2],
            [5, 6, 8, 7],
            [1, 2, 6, 5],
            [3, 7, 8, 4],
            [1, 5, 7, 3],
            [2, 4, 8, 6],
        ] {
            fingers += &format!("f {} {} {} {}\n", a + 8 * k, b + 8 * k, c + 8 * k, d + 8 * k);
        }
    }
    std::fs::write(dir.join("hand.obj"), fingers).unwrap();
    let text = platewash::kinematics::irb120::IRB120_URDF;
    let (before, after) = text.split_at(text.find("<collision name=\"link_6_sphere_1\">").unwrap());
    let (_, after) = after.split_once("</collision>").unwrap();
    let mesh = "<collision><geometry><mesh filename=\"hand.obj\"/></geometry></collision>";
    std::fs::write(dir.join("arm.urdf"), format!("{before}{mesh}{after}")).unwrap();
    std::fs::write(dir.join("arm.srdf"), platewash::kinematics::irb120::IRB120_SRDF).unwrap();
    let arm = ["--urdf", "arm.urdf", "--srdf", "arm.srdf"];
    let run = |verb: &[&str], more: &[&str]| platewash(dir, &[verb, &arm[..], more].concat());
    let split = ["--split-links", "link_6"];
    assert!(run(&["robot"], &split).done().stdout.contains("split mesh: 2"));
    assert!(!run(&["robot"], &[]).done().stdout.contains("split"));
    run(&["robot"], &["--split-links", "link_6,link_9"]).refused(2, &["arm.urdf", "link_9", "no such link", "link_6"]);
    run(&["robot"], &["--split-links", "link_3"]).refused(2, &["link_3", "mesh", "robot.split_links"]);

    let kitchen = platewash(dir, &["scenario", "kitchen"]).done().stdout;
    let robot = "[robot]\nurdf = \"arm.urdf\"\nsrdf = \"arm.srdf\"\nsplit_links = [\"link_6\"]\n";
    std::fs::write(dir.join("own.toml"), kitchen.replacen("[robot]\n", robot, 1)).unwrap();
    platewash(dir, &["run", "--scenario", "own.toml", "--quiet", "--out", "out"]).done();
    platewash(dir, &["verify", "out/plan.json", "--against", "own.toml"]).done();
    let said = run(&["verify", "out/plan.json", "--details"], &split).done().stdout;
    let words = "links are within convex parts that enclose their meshes: \"link_6\"";
    assert!(
        said.contains(words) && !said.contains("convex hulls of their meshes"),
        "{said}"
    );
    run(&["verify", "out/plan.json"], &[]).refused(2, &["the plan is for the arm"]);

    let broken = kitchen.replacen("[robot]\n", "[robot]\nsplit_links = [\"link_6\"]\n", 1);
    std::fs::write(dir.join("own.toml"), broken).unwrap();
    platewash(dir, &["validate", "--scenario", "own.toml"]).refused(2, &["robot.split_links", "robot.urdf"]);
}
