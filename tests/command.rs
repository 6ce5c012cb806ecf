//! The command as a person or a script meets it: results, exit codes, messages, files.
#![allow(clippy::unwrap_used, clippy::panic, missing_docs)]

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

struct Ran {
    code: i32,
    stdout: String,
    stderr: String,
}

impl Ran {
    fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|e| panic!("{e}: {}", self.stdout))
    }

    /// One clear message: the exit code, `error:` once, every fragment in it, and nothing on standard output.
    #[track_caller]
    fn refused(&self, code: i32, fragments: &[&str]) {
        assert_eq!(self.code, code, "stderr: {}", self.stderr);
        assert_eq!(self.stderr.matches("error:").count(), 1, "{}", self.stderr);
        assert!(self.stdout.is_empty(), "{}", self.stdout);
        for fragment in fragments {
            assert!(self.stderr.contains(fragment), "no '{fragment}' in: {}", self.stderr);
        }
    }

    #[track_caller]
    fn done(self) -> Self {
        assert_eq!(self.code, 0, "stderr: {}", self.stderr);
        self
    }
}

fn platewash(folder: &Path, arguments: &[&str]) -> Ran {
    let Output { status, stdout, stderr } = Command::new(env!("CARGO_BIN_EXE_platewash"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    Ran {
        code: status.code().unwrap(),
        stdout: String::from_utf8(stdout).unwrap(),
        stderr: String::from_utf8(stderr).unwrap(),
    }
}

fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The shipped scenario with one line replaced (the replacement must take effect).
fn scenario(folder: &Path, from: &str, to: &str) -> PathBuf {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/paper-appendix.toml")).unwrap();
    assert!(text.contains(from), "no '{from}' in the shipped scenario");
    let path = folder.join("case.toml");
    std::fs::write(&path, text.replacen(from, to, 1)).unwrap();
    path
}

#[test]
fn without_a_verb_the_default_scenario_runs_to_the_end() {
    let folder = folder();
    let ran = platewash(folder.path(), &[]).done();
    assert!(ran.stdout.starts_with("NOT WASHED: "), "{}", ran.stdout);
    let out = folder.path().join("out");
    assert_eq!(
        names(&out),
        [
            "executed.csv",
            "plan.json",
            "report.json",
            "report.txt",
            "trajectory.csv"
        ]
    );
    assert_eq!(std::fs::read_to_string(out.join("report.txt")).unwrap(), ran.stdout);
}

#[test]
fn json_is_the_report_and_nothing_else() {
    let folder = folder();
    let report = platewash(
        folder.path(),
        &["run", "--json", "--quiet", "--scenario", "paper-text", "--out", "here"],
    )
    .done();
    assert!(report.stderr.is_empty(), "{}", report.stderr);
    let value = report.json();
    assert_eq!(value["scenario"], "paper-text");
    assert_eq!(value["plates"].as_array().unwrap().len(), 4);
    assert_eq!(value["plates"][0]["waypoints"], 55);
    let written: Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("here/report.json")).unwrap()).unwrap();
    assert_eq!(value, written);
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_seed_another_layout() {
    let folder = folder();
    let run = |seed: &str, out: &str, threads: &str| {
        platewash(
            folder.path(),
            &["run", "--seed", seed, "--out", out, "--threads", threads],
        )
        .done();
        ["plan.json", "trajectory.csv", "executed.csv", "report.json"]
            .map(|f| std::fs::read(folder.path().join(out).join(f)).unwrap())
    };
    let first = run("7", "a", "1");
    assert_eq!(first, run("7", "b", "2"));
    assert_ne!(first, run("8", "c", "1"));
}

#[test]
fn the_plan_file_keeps_its_contract() {
    let folder = folder();
    platewash(folder.path(), &["plan", "--out", "."]).done();
    let text = std::fs::read_to_string(folder.path().join("plan.json")).unwrap();
    let plan: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(plan["format"], "platewash-plan/1");
    let n = 4 * 55 + 3 * 50 + 1;
    for key in ["t_s", "q_rad", "qd_rad_s"] {
        assert_eq!(plan["knots"][key].as_array().unwrap().len(), n, "{key}");
    }
    let kinds: Vec<_> = plan["segments"]
        .as_array()
        .unwrap()
        .iter()
        .map(|s| s["kind"].as_str().unwrap())
        .collect();
    assert_eq!(
        kinds,
        ["wash", "transition", "wash", "transition", "wash", "transition", "wash"]
    );
    let mut end = 0.0;
    for segment in plan["segments"].as_array().unwrap() {
        assert_eq!(
            segment["t_start_s"].as_f64().unwrap(),
            end,
            "segments follow each other"
        );
        end = segment["t_end_s"].as_f64().unwrap();
    }
    assert_eq!(end, plan["knots"]["t_s"][n - 1].as_f64().unwrap());
    let read = platewash::Plan::from_json(&text).unwrap();
    assert!(read.is_sealed());
    let mut moved = read.clone();
    moved.knots.q_rad[5][0] += 1e-9;
    assert!(!moved.is_sealed(), "an edit breaks the seal");
    assert!(platewash::Plan::from_json(&text.replace("platewash-plan/1", "platewash-plan/2")).is_err());
}

#[test]
fn the_csv_has_its_columns_and_its_time_step() {
    let folder = folder();
    platewash(
        folder.path(),
        &["plan", "--out", ".", "--csv", "deep/er/motion.csv", "--dt", "0.004"],
    )
    .done();
    assert_eq!(names(folder.path()), ["deep", "plan.json"]);
    let text = std::fs::read_to_string(folder.path().join("deep/er/motion.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|l| l.split(',').collect()).collect();
    let header = "t_s segment plate q1_rad q2_rad q3_rad q4_rad q5_rad q6_rad qd1_rad_s qd2_rad_s qd3_rad_s qd4_rad_s \
        qd5_rad_s qd6_rad_s qdd1_rad_s2 qdd2_rad_s2 qdd3_rad_s2 qdd4_rad_s2 qdd5_rad_s2 qdd6_rad_s2 tip_x_m tip_y_m tip_z_m";
    assert_eq!(rows[0], header.split_whitespace().collect::<Vec<_>>());
    assert_eq!(rows.len(), 1 + 925 + 1, "3.7 s at 4 ms, both ends");
    assert!(rows.iter().all(|r| r.len() == 24));
    let t = |r: &Vec<&str>| r[0].parse::<f64>().unwrap();
    assert!(rows[1..].windows(2).all(|w| t(&w[1]) > t(&w[0])));
    platewash(folder.path(), &["plan", "--dt", "0", "--out", "x"]).refused(2, &["time step", "0 s"]);
    platewash(folder.path(), &["plan", "--dt", "1e-12", "--out", "x"]).refused(2, &["time step"]);
    assert!(!folder.path().join("x").exists());
}

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

#[test]
fn ik_inverts_fk_and_says_why_when_it_cannot() {
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
    for expected in ["joint_6", "-400.00 … 400.00", "tool0", "base_link – link_3"] {
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
    assert!(text.contains("plate 0") && text.contains("plate 2"), "{text}");
    assert_eq!(names(folder.path()), ["case.toml"], "nothing is written");
}

#[test]
fn a_job_that_does_not_wash_fails_when_asked_to() {
    let folder = folder();
    let file = scenario(folder.path(), "on_failure = \"report\"", "on_failure = \"fail\"");
    let ran = platewash(folder.path(), &["run", "--scenario", file.to_str().unwrap()]);
    assert_eq!(ran.code, 3, "seed 1 has waypoints out of reach");
    assert!(ran.stdout.starts_with("NOT WASHED"));
    // One plate within reach and free of contact, but the paper's law covers too little of it: verification fails.
    let text = std::fs::read_to_string(&file)
        .unwrap()
        .replace("region = \"appendix\"", "positions_m = [[0.36, 0.0]]");
    std::fs::write(
        &file,
        text.replace("start_deg = [0, 0, 0, 0, 0, 0]", "start_deg = [0, 30, 10, 0, 50, 0]"),
    )
    .unwrap();
    let ran = platewash(folder.path(), &["run", "--scenario", file.to_str().unwrap()]);
    assert_eq!(ran.code, 4, "{}", ran.stdout);
}

#[test]
fn bad_scenarios_are_refused_with_line_key_expected_and_found() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["run", "--scenario", "nowhere.toml"]).refused(2, &["nowhere.toml", "paper-text"]);
    platewash(dir, &["run", "--scenario", "."]).refused(2, &["."]);
    let cases: &[(&str, &str, &[&str])] = &[
        ("seed = 1", "seed = ", &["line 5", "TOML"]),
        ("seed = 1", "seed = 1\nseed = 2", &["line 6", "TOML"]),
        (
            "points = 55",
            "pionts = 55",
            &["unknown key 'wash.pionts'", "wash.points", "line"],
        ),
        ("seed = 1", "colour = 1", &["unknown key 'colour'"]),
        ("[control]", "[kontrol]", &["unknown key 'kontrol'"]),
        ("kp = 20", "kp = nan", &["control.kp", "nan", "from 0"]),
        ("kp = 20", "kp = inf", &["control.kp", "inf"]),
        ("kp = 20", "kp = -1", &["control.kp", "-1"]),
        ("kp = 20", "kp = \"20\"", &["control.kp", "\"20\""]),
        ("dt_s = 0.01", "dt_s = 0", &["control.dt_s", "above 0"]),
        (
            "plate_radius_m = 0.145",
            "plate_radius_m = -0.145",
            &["layout.plate_radius_m", "-0.145", "above 0"],
        ),
        (
            "plate_radius_m = 0.145",
            "plate_radius_m = 0",
            &["layout.plate_radius_m", "found 0"],
        ),
        (
            "path_radius_m = 0.145",
            "path_radius_m = 1e300",
            &["wash.path_radius_m", "1e300"],
        ),
        ("count = 4", "count = 0", &["layout.count", "from 1 to 1000", "found 0"]),
        ("count = 4", "count = 4.5", &["layout.count", "4.5"]),
        ("count = 4", "count = 99999999999999999999", &["line"]),
        ("points = 55", "points = 1", &["wash.points", "from 2"]),
        (
            "region = \"appendix\"",
            "region = \"kitchen\"",
            &["layout.region", "\"text\" or \"appendix\"", "kitchen"],
        ),
        (
            "region = \"appendix\"",
            "x_m = [0.3, 0.0]\ny_m = [-0.3, 0.3]",
            &["layout.x_m", "least < greatest", "[0.3, 0.0]"],
        ),
        (
            "region = \"appendix\"",
            "x_m = [0.0, nan]\ny_m = [-0.3, 0.3]",
            &["layout.x_m", "nan"],
        ),
        ("region = \"appendix\"", "x_m = [0.0, 0.3]", &["region"]),
        ("region = \"appendix\"", "", &["region"]),
        (
            "region = \"appendix\"",
            "region = \"text\"\nx_m = [0.0, 0.3]",
            &["layout.region"],
        ),
        (
            "region = \"appendix\"",
            "positions_m = []",
            &["layout.positions_m", "1 to 1000"],
        ),
        (
            "region = \"appendix\"",
            "positions_m = [[0.3, nan]]",
            &["layout.positions_m", "nan"],
        ),
        (
            "start_deg = [0, 0, 0, 0, 0, 0]",
            "start_deg = [0, 0, 0, 0, 0]",
            &["robot.start_deg", "six"],
        ),
        (
            "start_deg = [0, 0, 0, 0, 0, 0]",
            "start_deg = [0, 0, 90, 0, 0, 0]",
            &["joint 3", "90", "70"],
        ),
        ("length_m = 0 ", "length_m = 0.02 ", &["tool.sponge_height_m", "0.02"]),
        ("model = \"irb120\"", "urdf = \"nowhere.urdf\"", &["nowhere.urdf"]),
        ("model = \"irb120\"", "package_path = [\"a\"]", &["robot.urdf"]),
    ];
    for (from, to, fragments) in cases {
        let file = scenario(dir, from, to);
        let name = file.to_str().unwrap();
        for verb in ["validate", "run"] {
            let mut all = vec!["case.toml"];
            all.extend(fragments.iter().filter(|f| !f.is_empty()));
            let ran = platewash(dir, &[verb, "--scenario", name]);
            // Faults of the arm or the layout are named by their own file or key.
            let fragments: &[&str] = if ran.stderr.contains("case.toml") {
                &all
            } else {
                fragments
            };
            ran.refused(2, fragments);
        }
        assert_eq!(names(dir), ["case.toml"], "nothing is written for {to}");
    }
}

#[test]
fn layouts_that_cannot_be_end_soon_with_a_bound() {
    let folder = folder();
    let dir = folder.path();
    let case = |from: &str, to: &str| {
        let file = scenario(dir, from, to);
        platewash(dir, &["run", "--scenario", file.to_str().unwrap()])
    };
    case("count = 4", "count = 1000").refused(3, &["1000 plates cannot fit", "8"]);
    case("count = 4", "count = 7").refused(3, &["7 plates", "at most 5", "8"]);
    let under = "x_m = [0.0, 0.1]\ny_m = [-0.1, 0.1]";
    case("region = \"appendix\"", under).refused(3, &["base_radius_m"]);
    assert_eq!(names(dir), ["case.toml"]);
}

#[test]
fn places_that_cannot_be_written_leave_nothing_behind() {
    let folder = folder();
    let dir = folder.path();
    std::fs::write(dir.join("taken"), "a file").unwrap();
    platewash(dir, &["run", "--out", "taken"]).refused(2, &["taken"]);
    platewash(dir, &["run", "--out", "taken/below"]).refused(2, &["taken"]);
    platewash(dir, &["run", "--out", "/proc/platewash"]).refused(2, &["/proc/platewash"]);
    std::fs::create_dir_all(dir.join("here/report.txt")).unwrap();
    platewash(dir, &["run", "--out", "here"]).refused(2, &["report.txt", "folder"]);
    assert_eq!(names(&dir.join("here")), ["report.txt"], "no partial set of files");
    assert_eq!(names(dir), ["here", "taken"]);
}

#[test]
fn broken_arms_are_refused_by_name() {
    let folder = folder();
    let dir = folder.path();
    let urdf = platewash::kinematics::model::IRB120_URDF;
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
fn bad_usage_is_exit_code_2_and_help_is_0() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["fly"]).refused(2, &["fly"]);
    platewash(dir, &["run", "--seed", "-1"]).refused(2, &["-1"]);
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
