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
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
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
