//! Verb by verb: results and usage.

use super::*;

#[test]
fn fk_prints_both_units_and_the_published_pose() {
    let folder = folder();
    let text = platewash(folder.path(), &["fk", "--deg", "0", "0", "0", "0", "0", "0"])
        .done()
        .stdout;
    assert!(
        text.contains("q, deg") && text.contains("q, rad") && text.contains("374.000"),
        "{text}"
    );
    let radians = [
        "fk", "--json", "--rad", "-1.4278", "-1.5406", "-0.6641", "1.4553", "1.6553", "0.6290",
    ];
    let value = platewash(folder.path(), &radians).done().json();
    let pose = &value["configurations"][0]["frames"]["matlab_tool0"];
    for (axis, expected) in [0.0, 0.5, 0.5].iter().enumerate() {
        assert!((pose["position_m"][axis].as_f64().unwrap() - expected).abs() < 1e-4);
    }
    assert_eq!(value["configurations"][0]["within_limits"], true);
    platewash(folder.path(), &["fk", "--deg", "1", "2"]).refused(2, &["six numbers", "found 2"]);
    platewash(folder.path(), &["fk", "--deg", "nan", "0", "0", "0", "0", "0"]).refused(2, &["joint 1", "NaN"]);
    platewash(folder.path(), &["fk"]).refused(2, &["--deg"]);
    std::fs::write(
        folder.path().join("many.txt"),
        "# two\n0 0 0 0 0 0\n0,10,20,0 ,30, 0\n\n",
    )
    .unwrap();
    let many = platewash(folder.path(), &["fk", "--deg", "--file", "many.txt", "--json"])
        .done()
        .json();
    assert_eq!(many["configurations"].as_array().unwrap().len(), 2);
    std::fs::write(folder.path().join("many.txt"), "0 0 0 0 0 0\n0 0 0 0 0\n").unwrap();
    platewash(folder.path(), &["fk", "--deg", "--file", "many.txt"]).refused(2, &["many.txt, line 2", "found 5"]);
}

/// Every branch meets the pose; the others say why they do not.
#[test]
fn ik_shows_all_branches_and_the_reasons_of_the_others() {
    let folder = folder();
    let ask = |frame: &str, y: &str, more: &[&str]| {
        let pose = [
            "ik",
            "--all",
            "--frame",
            frame,
            "--position",
            "0",
            y,
            "0.5",
            "--rpy-deg",
            "0",
            "0",
            "0",
        ];
        platewash(folder.path(), &[&pose[..], more].concat())
    };
    let found = ask("matlab_tool0", "0.5", &["--json"]).done().json();
    let branches = found["branches"].as_array().unwrap();
    let rejections = found["rejections"].as_array().unwrap();
    assert!(branches.len() >= 3 && branches.len() + rejections.len() == 8);
    for row in branches {
        assert!(
            row["turns"][5].as_u64().unwrap() >= 2,
            "joint 6 turns by 400° either way"
        );
        let q: Vec<String> = row["q_deg"].as_array().unwrap().iter().map(|v| v.to_string()).collect();
        let mut back = vec!["fk", "--json", "--deg"];
        back.extend(q.iter().map(String::as_str));
        let value = platewash(folder.path(), &back).done().json();
        let position = &value["configurations"][0]["frames"]["matlab_tool0"]["position_m"];
        assert!((position[1].as_f64().unwrap() - 0.5).abs() < 1e-9);
    }
    let far = ask("tool0", "2", &[]);
    assert_eq!(far.code, 3);
    let line = "front up plain     none: out of reach: the wrist centre is";
    assert!(
        far.stdout.starts_with("0 branches") && far.stdout.contains(line),
        "{}",
        far.stdout
    );
    ask("base_link", "0.5", &[]).refused(2, &["joint 6"]);
}

#[test]
fn ik_inverts_fk_and_states_the_cause_of_failure() {
    let folder = folder();
    let pose = [
        "ik",
        "--json",
        "--frame",
        "matlab_tool0",
        "--position",
        "0",
        "0.5",
        "0.5",
        "--rpy-deg",
        "0",
        "0",
        "0",
    ];
    let value = platewash(folder.path(), &pose).done().json();
    assert_eq!(value["solved"], true);
    let q: Vec<String> = value["q_rad"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.to_string())
        .collect();
    let mut back = vec!["fk", "--json", "--rad"];
    back.extend(q.iter().map(String::as_str));
    let value = platewash(folder.path(), &back).done().json();
    let found = &value["configurations"][0]["frames"]["matlab_tool0"]["position_m"];
    assert!((found[1].as_f64().unwrap() - 0.5).abs() < 1e-6);

    let far = platewash(
        folder.path(),
        &["ik", "--position", "2", "0", "0.3", "--quaternion", "1", "0", "0", "0"],
    );
    assert_eq!(far.code, 3);
    assert!(
        far.stdout.contains("NOT solved") && far.stdout.contains("unreachable"),
        "{}",
        far.stdout
    );
    let nothing = [
        "ik",
        "--position",
        "0.3",
        "0",
        "0.3",
        "--quaternion",
        "0",
        "0",
        "0",
        "0",
    ];
    platewash(folder.path(), &nothing).refused(2, &["--quaternion", "zero"]);
    let nan = ["ik", "--position", "NaN", "0", "0.3", "--rpy-rad", "0", "0", "0"];
    platewash(folder.path(), &nan).refused(2, &["--position", "NaN"]);
    let frame = [
        "ik",
        "--frame",
        "hand",
        "--position",
        "0.3",
        "0",
        "0.3",
        "--rpy-rad",
        "0",
        "0",
        "0",
    ];
    platewash(folder.path(), &frame).refused(2, &["hand", "tool0"]);
}

#[test]
fn robot_shows_limits_frames_and_pairs() {
    let folder = folder();
    let text = platewash(folder.path(), &["robot"]).done().stdout;
    for expected in [
        "joint_6",
        "-400.0001 … 400.0001",
        "-2.09439 … 2.09439",
        "tool0",
        "base_link – link_3",
    ] {
        assert!(text.contains(expected), "no {expected} in {text}");
    }
    let value = platewash(folder.path(), &["robot", "--json"]).done().json();
    assert_eq!(value["joints"].as_array().unwrap().len(), 6);
}

#[test]
fn validate_and_layout_do_not_run() {
    let folder = folder();
    let answer = platewash(folder.path(), &["validate", "--json"]).done().json();
    assert_eq!(answer["valid"], true);
    assert_eq!(answer["sampling"]["layout_found"], true);
    assert_eq!(answer["sampling"]["seed"], 1);
    let given = scenario(
        folder.path(),
        "region = \"appendix\"",
        "region = \"appendix\"\npositions_m = [[0.1, 0.0], [0.2, 0.1], [0.5, 0.0]]",
    );
    let file = given.to_str().unwrap();
    let text = platewash(folder.path(), &["validate", "--scenario", file])
        .done()
        .stdout;
    let layout = platewash(folder.path(), &["layout", "--json", "--scenario", file])
        .done()
        .json();
    let kinds: Vec<_> = layout["findings"]
        .as_array()
        .unwrap()
        .iter()
        .map(|f| f["kind"].as_str().unwrap())
        .collect();
    for kind in [
        "spacing_broken",
        "plates_overlap",
        "overlaps_base",
        "leaves_region",
        "too_close_to_base",
    ] {
        assert!(kinds.contains(&kind), "{kind} in {kinds:?}");
    }
    assert!(text.contains("plate 1") && text.contains("plate 3"), "{text}");
    assert!(!text.contains("seed"), "nothing is sampled: {text}");
    assert_eq!(names(folder.path()), ["case.toml"], "nothing is written");
    scenario(folder.path(), "count = 4", "count = 7");
    let text = platewash(folder.path(), &["validate", "--scenario", file])
        .done()
        .stdout;
    assert!(
        text.contains("valid") && text.contains("no layout of 7 plates found"),
        "{text}"
    );
    scenario(folder.path(), "count = 4", "count = 9");
    platewash(folder.path(), &["validate", "--scenario", file])
        .refused(3, &["9 plates cannot fit", "best of 100 random layouts", "more than 8"]);
}

#[test]
fn bad_usage_is_exit_code_2_and_help_is_0() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["fly"]).refused(2, &["fly"]);
    for seed in ["-1", "9223372036854775808", "99999999999999999999", "one"] {
        let range = "from 0 to 9007199254740991";
        platewash(dir, &["run", "--seed", seed]).refused(2, &["--seed", seed, range]);
    }
    platewash(dir, &["run", "--threads", "0"]).refused(2, &["--threads"]);
    platewash(dir, &["reproduce", "--layouts", "0"]).refused(2, &["--layouts"]);
    platewash(dir, &["reproduce", "--scenario", "paper-text"]).refused(2, &["--scenario"]);
    let help = platewash(dir, &["--help"]).done();
    assert!(help.stdout.contains("reproduce") && help.stdout.contains("Exit codes"));
    platewash(dir, &["--version"]).done();
    assert!(names(dir).is_empty());
}

#[test]
fn reproduce_prints_a_table_and_the_same_as_data() {
    let folder = folder();
    let small = ["reproduce", "--layouts", "8", "--draws", "500", "--out", "r", "--json"];
    let value = platewash(folder.path(), &small).done().json();
    let rows = value["rows"].as_array().unwrap();
    let documented = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/reproduce.md")).unwrap();
    for row in rows {
        let key = row["key"].as_str().unwrap();
        // Keys end with a region, a number of plates or a sponge radius, which the page writes as placeholders.
        let stem = key.split('.').next().unwrap();
        assert!(
            documented.contains(&format!("`{stem}")),
            "{key} is not in docs/reproduce.md"
        );
        assert!(row["measured"].is_number() && row["unit"].is_string());
    }
    assert_eq!(names(&folder.path().join("r")), ["reproduce.json", "reproduce.txt"]);
}
