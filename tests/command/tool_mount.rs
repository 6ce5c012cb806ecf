//! The link that carries the tool: stated, or refused where the description has no `tool0`.

use super::*;

/// The IRB 120 without its `tool0`.
fn without_tool0(dir: &Path) -> PathBuf {
    let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/urdf/irb120.urdf");
    let text = std::fs::read_to_string(urdf).unwrap();
    let from = text.find("<joint name=\"flange-tool0\"").unwrap();
    let to = from + text[from..].find("</joint>").unwrap() + "</joint>".len();
    let text = format!("{}{}", &text[..from], &text[to..]).replace("<link name=\"tool0\"/>", "");
    let path = dir.join("arm.urdf");
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn without_tool0_nothing_is_planned_until_the_link_is_stated() {
    let folder = folder();
    let dir = folder.path();
    let urdf = without_tool0(dir);
    let urdf = urdf.to_str().unwrap();
    let plan = |more: &[&str]| platewash(dir, &[&["plan", "--quiet", "--urdf", urdf], more].concat());
    plan(&[]).refused(
        2,
        &[
            "tool.mounted_on",
            "no link 'tool0'",
            "--tool-mount",
            "'flange'",
            "[0, 90, 0]",
        ],
    );
    plan(&["--tool-mount", "link_3"]).refused(2, &["no link 'link_3' behind joint 6"]);
    assert!(!dir.join("out").exists());
    let robot = |more: &[&str]| platewash(dir, &[&["robot", "--urdf", urdf], more].concat());
    let said = robot(&[]).done().stdout;
    assert!(
        said.contains("tool mounted nowhere: ") && said.contains("tool.mounted_on"),
        "{said}"
    );
    let said = robot(&["--tool-mount", "flange"]).done().stdout;
    assert!(
        said.contains("tool mounted on link 'flange', along its z axis, 90.0° from the axis of joint 6"),
        "{said}"
    );

    // Turned as the message says, the tool is where tool0 has it: the same motion.
    let turned = kitchen(
        dir,
        &[(
            "[tool]\n",
            "[tool]\nmounted_on = \"flange\"\nmount_rpy_deg = [0, 90, 0]\n",
        )],
    );
    plan(&["--scenario", turned.to_str().unwrap()]).done();
    let read =
        |path: &str| -> Value { serde_json::from_str(&std::fs::read_to_string(dir.join(path)).unwrap()).unwrap() };
    let stated = read("out/plan.json");
    assert_eq!(stated["job"]["workcell"]["tool"]["mounted_on"], "flange");
    platewash(dir, &["plan", "--quiet", "--out", "usual"]).done();
    let usual = read("usual/plan.json");
    assert!(usual["job"]["workcell"]["tool"].get("mounted_on").is_none());
    let joints = |plan: &Value| -> Vec<Vec<f64>> { serde_json::from_value(plan["knots"]["q_rad"].clone()).unwrap() };
    let (stated, usual) = (joints(&stated), joints(&usual));
    assert_eq!(stated.len(), usual.len());
    for (a, b) in stated.iter().flatten().zip(usual.iter().flatten()) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    let said = platewash(dir, &["verify", "out/plan.json", "--urdf", urdf, "--details"])
        .done()
        .stdout;
    assert!(said.contains("tool mount    on link \"flange\" along its z"), "{said}");
    platewash(
        dir,
        &["verify", "out/plan.json", "--urdf", urdf, "--tool-mount", "flange"],
    )
    .refused(2, &["--tool-mount", "leave it out"]);
    // The plan states its link: an arm without it is no arm for the plan.
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    std::fs::write(
        dir.join("other.json"),
        text.replace("\"mounted_on\":\"flange\"", "\"mounted_on\":\"hand\""),
    )
    .unwrap();
    platewash(dir, &["verify", "other.json", "--urdf", urdf]).refused(2, &["no link 'hand' behind joint 6"]);
}

#[test]
fn tool0_may_be_stated_and_a_plan_with_it_has_the_same_bytes() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    platewash(dir, &["plan", "--quiet", "--tool-mount", "tool0", "--out", "stated"]).done();
    let read = |path: &str| std::fs::read(dir.join(path)).unwrap();
    assert_eq!(read("out/plan.json"), read("stated/plan.json"));
}
