//! The link that carries the tool: stated, or found in the description.

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
fn without_tool0_the_flange_of_the_description_carries_the_tool() {
    let folder = folder();
    let dir = folder.path();
    let urdf = without_tool0(dir);
    let urdf = urdf.to_str().unwrap();
    let plan = |more: &[&str]| platewash(dir, &[&["plan", "--quiet", "--urdf", urdf], more].concat());
    plan(&["--tool-mount", "link_3"]).refused(2, &["no link 'link_3' behind joint 6"]);
    assert!(!dir.join("out").exists());
    let robot = |more: &[&str]| platewash(dir, &[&["robot", "--urdf", urdf], more].concat());
    let said = robot(&[]).done().stdout;
    assert!(
        said.contains(
            "tool mounted on link 'flange', along its x axis, out along axis 6; found by names, axis 6 and shapes"
        ),
        "{said}"
    );
    let said = robot(&["--tool-mount", "flange"]).done().stdout;
    assert!(
        said.contains("tool mounted on link 'flange', along its z axis, 90.0° from the axis of joint 6"),
        "{said}"
    );

    // The tool is where tool0 has it: the same motion.
    plan(&[]).done();
    let read =
        |path: &str| -> Value { serde_json::from_str(&std::fs::read_to_string(dir.join(path)).unwrap()).unwrap() };
    let found = read("out/plan.json");
    assert_eq!(found["job"]["workcell"]["tool"]["mounted_on"], "flange:x");
    plan(&["--tool-mount", "flange:x", "--out", "stated"]).done();
    assert_eq!(found, read("stated/plan.json"));
    platewash(dir, &["plan", "--quiet", "--out", "usual"]).done();
    let usual = read("usual/plan.json");
    assert!(usual["job"]["workcell"]["tool"].get("mounted_on").is_none());
    let joints = |plan: &Value| -> Vec<Vec<f64>> { serde_json::from_value(plan["knots"]["q_rad"].clone()).unwrap() };
    let (found, usual) = (joints(&found), joints(&usual));
    assert_eq!(found.len(), usual.len());
    for (a, b) in found.iter().flatten().zip(usual.iter().flatten()) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
    let said = platewash(dir, &["verify", "out/plan.json", "--urdf", urdf, "--details"])
        .done()
        .stdout;
    assert!(said.contains("tool mount    on link \"flange\" along its x"), "{said}");
    platewash(
        dir,
        &["verify", "out/plan.json", "--urdf", urdf, "--tool-mount", "flange:x"],
    )
    .refused(2, &["--tool-mount", "leave it out"]);
    // The plan states its link: an arm without it is no arm for the plan.
    let text = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    std::fs::write(
        dir.join("other.json"),
        text.replace("\"mounted_on\":\"flange:x\"", "\"mounted_on\":\"hand\""),
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

#[test]
fn asks_for_the_tool_mount_where_two_links_could_carry_it() {
    let folder = folder();
    let dir = folder.path();
    let text = std::fs::read_to_string(without_tool0(dir)).unwrap();
    let tcp = |name: &str, x_m: f64| {
        format!(
            "<link name=\"{name}\"/><joint name=\"to_{name}\" type=\"fixed\"><parent link=\"link_6\"/><child link=\"{name}\"/>\
             <origin xyz=\"{x_m} 0 0\"/></joint>"
        )
    };
    let two = text.replace("\"flange\"", "\"wrist_plate\"").replace(
        "</robot>",
        &format!("{}{}</robot>", tcp("ee_link", 0.0), tcp("tcp", 0.1)),
    );
    std::fs::write(dir.join("arm.urdf"), two).unwrap();
    platewash(dir, &["plan", "--quiet", "--urdf", "arm.urdf"]).refused(
        2,
        &[
            "tool.mounted_on",
            "'ee_link' and 'tcp' at different places",
            "--tool-mount LINK:AXIS",
            "'tcp' (x leads out)",
        ],
    );
    assert!(!dir.join("out").exists());
    let said = platewash(dir, &["robot", "--urdf", "arm.urdf"]).done().stdout;
    assert!(
        said.contains("tool mounted nowhere: robot 'irb120' has the links"),
        "{said}"
    );
}

/// The home of a shipped scenario is the IRB 120's: another arm gets its own, a copy of the IRB 120 keeps it.
#[test]
fn another_arm_gets_its_own_home() {
    let folder = folder();
    let dir = folder.path();
    let own = |urdf: &str| {
        let ran = platewash(dir, &["robot", "--json", "--urdf", urdf]).done();
        let is_open = ran.stderr.contains("robot.start_deg is not stated for this arm");
        (ran.json()["start_deg"].is_null(), is_open)
    };
    let copy = without_tool0(dir);
    assert_eq!(own(copy.to_str().unwrap()), (false, false));
    assert_eq!(own(other_arms::UR5), (true, true));
}
