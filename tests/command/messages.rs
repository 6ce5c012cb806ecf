//! What a newcomer gets wrong: each message names the place, what was found, and what to do.

use super::*;

/// A line of the kitchen, what stands there in its place, and words of the message.
const IN_SCENARIOS: [(&str, &str, &[&str]); 24] = [
    (
        "clearance_m = 0.01",
        "clearance_m = 1e308",
        &["line 38", "wash.clearance_m", "from 0 to 1", "1e308"],
    ),
    (
        "clearance_m = 0.01",
        "clearance_m = nan",
        &["line 38", "wash.clearance_m", "nan"],
    ),
    (
        "clearance_m = 0.01",
        "clearance_m = 10",
        &["metres are expected; 0.01 if millimetres were meant"],
    ),
    (
        "speed_m_s = 0.25",
        "speed_m_s = 250",
        &["0.25 if millimetres per second were meant"],
    ),
    (
        "required_coverage = 0.995",
        "required_coverage = 99.5",
        &["a share of 1 is expected; 0.995 if per cent"],
    ),
    (
        "plate_radius_m = 0.145",
        "plate_diameter_m = 0.29",
        &["half of it, the radius, is stated: 'layout.plate_radius_m'"],
    ),
    (
        "[layout]\ncount = 4\nplate_radius_m = 0.145",
        "[[plate]]\ndiameter_m = 0.29\n[layout]",
        &["'plate[0].diameter_m'", "'plate[0].radius_m'"],
    ),
    ("[wash]", "[wasch]", &["line 36", "'wasch'", "did you mean 'wash'?"]),
    (
        "[wash]",
        "[cleaning]",
        &["'cleaning'", "sections: control, floor, ", "wash"],
    ),
    (
        "clearance_m = 0.01",
        "clearence_m = 0.01",
        &["did you mean 'wash.clearance_m'?"],
    ),
    (
        "clearance_m = 0.01",
        "clearance_mm = 10",
        &["did you mean 'wash.clearance_m'?"],
    ),
    (
        "clearance_m = 0.01",
        "softness = 3",
        &["'wash.softness'", "keys of [wash]: ", "clearance_m"],
    ),
    (
        "clearance_m = 0.01",
        "clearance_m = \"10 mm\"",
        &["a number from 0 to 1; found \"10 mm\""],
    ),
    (
        "clearance_m = 0.01",
        "clearance_m = 0,01",
        &["line 38", "a decimal point, not a comma", "clearance_m = 0,01"],
    ),
    (
        "clearance_m = 0.01",
        "clearance_m =",
        &["line 38", "a value is missing"],
    ),
    (
        "clearance_m = 0.01",
        "clearance_m = 0.01\nclearance_m = 0.02",
        &["line 39", "'clearance_m' is stated twice"],
    ),
    ("[control]", "[wash]\nturns = 3\n[control]", &["'wash' is stated twice"]),
    (
        "region = \"appendix\"",
        "region = \"Appendix\"",
        &["found \"Appendix\"; did you mean \"appendix\"?"],
    ),
    (
        "program = \"certified\"",
        "program = \"cerified\"",
        &["did you mean \"certified\"?"],
    ),
    (
        "model = \"irb120\"",
        "model = \"irb140\"",
        &["robot.model", "found \"irb140\""],
    ),
    (
        "start_deg = [0, 0, 0, 0, 90, 0]",
        "start_deg = [0, 0, 0, 0, 90]",
        &["robot.start_deg", "six numbers"],
    ),
    (
        "start_deg = [0, 0, 0, 0, 90, 0]",
        "start_deg = [0, 0, 0, 0, 200, 0]",
        &["joint 5 at 200", "limit of 120"],
    ),
    (
        "contact_force_n = [1, 40]",
        "contact_force_n = [40, 1]",
        &["[least, greatest]", "[40, 1]"],
    ),
    (
        "count = 4",
        "count = 4.5",
        &["line 27", "layout.count", "a whole number from 1 to 1000; found 4.5"],
    ),
];

#[test]
fn errors_of_a_scenario_name_line_and_remedy() {
    let folder = folder();
    let dir = folder.path();
    let kitchen = platewash(dir, &["scenario", "kitchen"]).done().stdout;
    for (from, to, told) in IN_SCENARIOS {
        let text = kitchen.replacen(from, to, 1);
        assert_ne!(text, kitchen, "{from}");
        std::fs::write(dir.join("mine.toml"), text).unwrap();
        let ran = platewash(dir, &["validate", "--scenario", "mine.toml"]);
        ran.refused(2, &[&["mine.toml"], told].concat());
    }
}

#[test]
fn a_missing_or_invalid_scenario_gets_suggestions() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    for (name, told) in [
        (
            "kichen",
            &["neither a file nor a shipped scenario (did you mean 'kitchen'?); shipped: kitchen, "][..],
        ),
        ("kichen.toml", &["did you mean 'kitchen'?"]),
        (".", &["not a regular file, but a folder"]),
        ("out/plan.json", &["it begins as JSON; plan files are for verify"]),
    ] {
        platewash(dir, &["run", "--scenario", name]).refused(2, told);
    }
}

#[test]
fn invalid_arguments_get_a_helpful_tip() {
    let folder = folder();
    let dir = folder.path();
    for (arguments, tip) in [
        (&["run", "kitchen"][..], "a scenario is given as '--scenario kitchen'"),
        (&["kitchen"], "a scenario is given as '--scenario kitchen'"),
        (&["run", "mine.toml"], "'--scenario mine.toml'"),
        (
            &["run", "--speed", "0.2"],
            "keys are set in the scenario's file: 'wash.speed_m_s'",
        ),
        (&["run", "--clearance=0.02"], "'wash.clearance_m'"),
        (&["tune", "plan.json", "--frequency", "3"], "'--frequencies'"),
        (&["simulat", "plan.json"], "'simulate'"),
    ] {
        let ran = platewash(dir, arguments);
        assert!(
            ran.code == 2 && ran.stderr.contains(tip),
            "{arguments:?}: {}",
            ran.stderr
        );
        assert!(!ran.stderr.contains("'--seed'"), "{}", ran.stderr);
    }
}

#[test]
fn a_plan_file_is_refused_by_its_key_without_names_of_types() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--quiet"]).done();
    let plan = std::fs::read_to_string(dir.join("out/plan.json")).unwrap();
    let seed = "\"seed\":1,";
    let verify = |text: &str| {
        std::fs::write(dir.join("plan.json"), text).unwrap();
        platewash(dir, &["verify", "plan.json"])
    };
    assert_eq!(verify(&format!("\u{feff}{plan}")).code, 0, "a byte order mark");
    for (text, told) in [
        (
            plan.replacen(seed, "\"seed\":\"one\",", 1),
            "'job.seed' must be a whole number; found \"one\"",
        ),
        (plan.replacen(seed, "", 1), "'job.seed' is missing"),
        (
            plan.replacen(seed, "\"seed\":1,\"seed\":1,", 1),
            "'job.seed' is stated twice",
        ),
        (plan.replacen(seed, "\"seed\":1,\"sead\":1,", 1), "'job.sead'"),
        (
            plan[..plan.len() / 2].to_owned(),
            "it ends in the middle, at line 1, column ",
        ),
        (String::new(), "the file is empty or was cut off"),
        ("[1, 2, 3, 4, 5, 6, 7, 8, 9]".to_owned(), "not a plan file"),
        ("name = \"kitchen\"".to_owned(), "it is not valid JSON: "),
    ] {
        assert_ne!(text, plan);
        let ran = verify(&text);
        ran.refused(2, &["plan.json", told]);
        assert!(
            !["struct", "u64", "f64", "field `", "sequence"]
                .iter()
                .any(|word| ran.stderr.contains(word)),
            "{}",
            ran.stderr
        );
    }
    std::fs::write(dir.join("mine.toml"), "").unwrap();
    platewash(dir, &["verify", "mine.toml"]).refused(2, &["is not a plan file", "platewash plan --scenario mine.toml"]);
}

#[test]
fn a_urdf_is_refused_by_one_line_and_without_names_of_types() {
    let folder = folder();
    let dir = folder.path();
    let joint = |inside: &str| {
        format!("<robot name=\"x\"><link name=\"a\"/><link name=\"b\"/>\n<joint name=\"j\"{inside}</joint></robot>")
    };
    let ends = "<parent link=\"a\"/><child link=\"b\"/>";
    for (text, told) in [
        (joint(&format!(">{ends}")), "joint 'j' (line 2): 'type' is missing"),
        (
            joint(&format!(" type=\"hinge\">{ends}")),
            "'hinge' is none of 'revolute', ",
        ),
        (joint(" type=\"fixed\"><child link=\"b\"/>"), "'parent' is missing"),
        (
            joint(&format!(" type=\"revolute\">{ends}<limit lower=\"x\" upper=\"1\"/>")),
            "joint 'j' (line 2): a value is not a number",
        ),
        (joint(" type=\"a & b\">"), "line 2"),
        (
            "<robot name=\"x\"\n<link name=\"a\"/></robot>".to_owned(),
            "line 2: attribute key must be directly followed by `=` or space",
        ),
        (
            "<robot name=\"x\"><link name='a/></robot>".to_owned(),
            "or a quotation mark is missing",
        ),
    ] {
        std::fs::write(dir.join("arm.urdf"), text).unwrap();
        let ran = platewash(dir, &["robot", "--urdf", "arm.urdf"]);
        ran.refused(2, &["arm.urdf", told]);
        let lines = ran.stderr.to_lowercase().matches("line").count();
        assert!(lines <= 1 && !ran.stderr.contains("position"), "{}", ran.stderr);
    }
}

#[test]
fn a_study_is_refused_without_names_of_types() {
    let folder = folder();
    let dir = folder.path();
    for (text, told) in [
        ("name = \"a\"\nscenario = \"kitchen\"\n", "'format' is missing"),
        (
            "format = \"platewash-study/1\"\nname = \"a\"\nscenario = \"kitchen\"\nseed = 3\n",
            "line 4: unknown key 'seed'",
        ),
        (
            "format = \"platewash-study/1\"\nname = 3\nscenario = \"kitchen\"\n",
            "line 2: 'name' must be a text; found 3",
        ),
    ] {
        std::fs::write(dir.join("study.toml"), text).unwrap();
        platewash(dir, &["study", "run", "study.toml", "--out", "rows"]).refused(2, &["study.toml", told]);
    }
}

#[test]
fn joint_positions_and_poses_that_no_arm_has_are_refused_and_ik_tells_its_clearance() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["fk", "--deg", "1e308", "0", "0", "0", "0", "0"])
        .refused(2, &["joint 1", "from -36000 to 36000 degrees"]);
    platewash(dir, &["fk", "--rad", "0", "inf", "0", "0", "0", "0"]).refused(2, &["joint 2", "found inf rad"]);
    let pose = |x: &'static str| ["ik", "--position", x, "0", "0.3", "--rpy-deg", "180", "0", "0"];
    platewash(dir, &pose("1e308")).refused(2, &["--position", "-36000 to 36000"]);
    let solved = platewash(dir, &pose("0.4")).done();
    let line = solved
        .stdout
        .lines()
        .find(|line| line.starts_with("smallest clearance: "))
        .unwrap();
    let answer = platewash(dir, &[&pose("0.4")[..], &["--json"]].concat()).done().json();
    let q: Vec<String> = answer["q_deg"]
        .as_array()
        .unwrap()
        .iter()
        .map(Value::to_string)
        .collect();
    let q: Vec<&str> = q.iter().map(String::as_str).collect();
    let told = platewash(dir, &[&["fk", "--deg"], &q[..]].concat()).done().stdout;
    assert!(told.contains(line), "{line}\n{told}");
    assert!(answer["clearance"].as_array().unwrap().len() > 5);
}
