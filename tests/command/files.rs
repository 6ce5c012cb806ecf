//! What is written, and where it cannot be.

use super::*;

#[test]
fn without_a_verb_the_default_scenario_runs_to_the_end() {
    let folder = folder();
    let ran = platewash(folder.path(), &[]).done();
    assert!(
        ran.stdout.starts_with("PROVED: 4 plates in 31.71 s, each pressed over at least 99.7 % (99.5 % required), clearance at least 19.1 mm (10 mm required)\n"),
        "{}",
        ran.stdout
    );
    let out = folder.path().join("out");
    assert_eq!(
        names(&out),
        [
            "certificate.json",
            "executed.csv",
            "plan.json",
            "report.json",
            "report.txt",
            "trajectory.csv"
        ]
    );
    let whole = platewash(folder.path(), &["run", "--details"]).done().stdout;
    assert_eq!(std::fs::read_to_string(out.join("report.txt")).unwrap(), whole);
}

#[test]
fn the_papers_scenario_runs_to_the_end_and_does_not_wash() {
    let folder = folder();
    let ran = platewash(folder.path(), &["run", "--scenario", "paper-appendix"]).done();
    assert!(ran.stdout.starts_with("NOT SWEPT: "), "{}", ran.stdout);
    let files = [
        "executed.csv",
        "plan.json",
        "report.json",
        "report.txt",
        "trajectory.csv",
    ];
    assert_eq!(names(&folder.path().join("out")), files);
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
    let run = |scenario: &str, seed: &str, threads: &str| {
        let arguments = [
            "run",
            "--scenario",
            scenario,
            "--seed",
            seed,
            "--out",
            "a",
            "--threads",
            threads,
        ];
        platewash(folder.path(), &arguments).done();
        let out = folder.path().join("a");
        let files = names(&out).into_iter().map(|f| std::fs::read(out.join(f)).unwrap());
        files.collect::<Vec<_>>()
    };
    for scenario in ["paper-appendix", "kitchen-rim"] {
        let first = run(scenario, "7", "1");
        assert_eq!(first.len(), if scenario == "kitchen-rim" { 6 } else { 5 });
        assert_eq!(first, run(scenario, "7", "2"));
        assert_eq!(first, run(scenario, "7", "8"));
        assert_ne!(first, run(scenario, "8", "1"));
        std::fs::remove_dir_all(folder.path().join("a")).unwrap();
    }
}

#[test]
fn the_plan_file_keeps_its_contract() {
    let folder = folder();
    platewash(folder.path(), &["plan", "--scenario", "paper-appendix", "--out", "."]).done();
    let text = std::fs::read_to_string(folder.path().join("plan.json")).unwrap();
    let plan: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(plan["format"], "platewash-plan/2");
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
        [
            "depart", "wash", "transit", "wash", "transit", "wash", "transit", "wash"
        ]
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
    for other in ["platewash-plan/1", "platewash-plan/3"] {
        assert!(platewash::Plan::from_json(&text.replace("platewash-plan/2", other)).is_err());
    }
}

#[test]
fn the_csv_has_its_columns_and_its_time_step() {
    let folder = folder();
    platewash(
        folder.path(),
        &[
            "plan",
            "--scenario",
            "paper-appendix",
            "--out",
            ".",
            "--csv",
            "deep/er/motion.csv",
            "--dt",
            "0.004",
        ],
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
    platewash(folder.path(), &["plan", "--dt", "0", "--out", "x"]).refused(2, &["--dt", "'0'", "positive"]);
    platewash(folder.path(), &["plan", "--dt", "1e-5", "--out", "x"]).refused(2, &["--dt", "1000000 rows"]);
    assert!(!folder.path().join("x").exists());
}

#[test]
fn unwritable_outputs_leave_nothing_behind() {
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
fn no_output_takes_the_place_of_another() {
    let folder = folder();
    let dir = folder.path();
    for csv in [
        "out/plan.json",
        "./out/plan.json",
        "new/../out/report.json",
        "out/../out/certificate.json",
    ] {
        let name = csv.rsplit('/').next().unwrap();
        platewash(dir, &["run", "--csv", csv]).refused(2, &["--csv", name]);
        assert!(names(dir).is_empty(), "nothing is written");
    }
    std::fs::create_dir(dir.join("out")).unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(dir.join("out"), dir.join("link")).unwrap();
        platewash(dir, &["plan", "--csv", "link/plan.json"]).refused(2, &["link/plan.json"]);
    }
    platewash(dir, &["plan", "--csv", "out/plan.csv"]).done();
}

#[cfg(target_os = "linux")]
#[test]
fn reports_a_full_standard_output() {
    let full = || std::fs::File::create("/dev/full").unwrap();
    for arguments in [&["robot"][..], &["--help"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_platewash"));
        let ran = command.args(arguments).stdout(full()).output().unwrap();
        assert_eq!(ran.status.code(), Some(2), "{arguments:?}");
        assert!(String::from_utf8(ran.stderr).unwrap().contains("error:"));
    }
}

#[cfg(unix)]
#[test]
fn files_respect_the_umask() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder();
    for (mask, mode) in [("077", 0o600), ("022", 0o644), ("002", 0o664)] {
        let ran = Command::new("sh")
            .args([
                "-c",
                "umask $0; exec $1 layout --out out",
                mask,
                env!("CARGO_BIN_EXE_platewash"),
            ])
            .current_dir(folder.path())
            .status();
        assert!(ran.unwrap().success());
        let found = std::fs::metadata(folder.path().join("out/layout.json"))
            .unwrap()
            .permissions();
        assert_eq!(found.mode() & 0o777, mode, "umask {mask}");
    }
}
