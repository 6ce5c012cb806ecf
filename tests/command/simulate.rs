//! `platewash simulate` and `tune`, and the simulation that is part of `run`.

use super::{folder, names, platewash};
use serde_json::Value;
use std::path::Path;

/// A folder with the plan of `kitchen` in `out/plan.json`.
fn planned(dir: &Path) {
    platewash(dir, &["plan", "--quiet"]).done();
}

#[test]
fn the_kitchen_survives_computed_torque_and_not_pd() {
    let folder = folder();
    let dir = folder.path();
    planned(dir);
    let ran = platewash(dir, &["simulate", "out/plan.json", "--out", "ct", "--details"]).done();
    assert!(
        ran.stdout
            .starts_with("WASHED: 4 of 4 plates washed under computed_torque"),
        "{}",
        ran.stdout
    );
    assert_eq!(
        names(&dir.join("ct")),
        ["simulated.csv", "simulation.json", "simulation.txt"]
    );
    assert_eq!(
        std::fs::read_to_string(dir.join("ct/simulation.txt")).unwrap(),
        ran.stdout
    );
    let line = [
        "simulate",
        "out/plan.json",
        "--law",
        "pd",
        "--frequency",
        "15",
        "--json",
        "--out",
        "pd",
    ];
    let ran = platewash(dir, &line);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    let report = ran.json();
    assert_eq!(report["verdict"], "not_washed");
    for plate in report["plates"].as_array().unwrap() {
        assert_eq!(plate["verdict"], "not_washed");
        assert!(plate["executed"]["upper"].as_f64().unwrap() < 0.9, "{plate}");
        let causes = plate["causes"].as_array().unwrap();
        assert!(causes.iter().any(|cause| cause["cause"] == "strayed"), "{plate}");
    }
}

#[test]
fn the_executed_motion_has_the_plans_columns_and_torques() {
    let folder = folder();
    let dir = folder.path();
    planned(dir);
    let plan: Value = serde_json::from_str(&std::fs::read_to_string(dir.join("out/plan.json")).unwrap()).unwrap();
    let duration_s = plan["knots"]["t_s"]
        .as_array()
        .unwrap()
        .last()
        .unwrap()
        .as_f64()
        .unwrap();
    platewash(dir, &["simulate", "out/plan.json", "--quiet", "--dt", "0.1"]).done();
    let header = |file: &str| {
        let text = std::fs::read_to_string(dir.join("out").join(file)).unwrap();
        (text.lines().next().unwrap().to_owned(), text.lines().count())
    };
    let (planned, _) = header("trajectory.csv");
    let (executed, lines) = header("simulated.csv");
    assert!(executed.starts_with(&planned), "{executed}");
    assert_eq!(executed.split(',').count(), planned.split(',').count() + 7);
    // Steps of a tenth of a second, the end and the header.
    let steps = (10.0 * duration_s) as usize;
    assert!((steps + 2..=steps + 4).contains(&lines), "{lines} for {duration_s} s");
}

#[test]
fn run_simulates_the_proved_plan() {
    let folder = folder();
    let dir = folder.path();
    let report = platewash(dir, &["run", "--json", "--quiet"]).done().json();
    assert_eq!(report["verdict"], "washed");
    assert_eq!(report["simulation"]["verdict"], "washed");
    assert_eq!(report["simulation"]["law"], "computed_torque");
    // A law that the arm does not survive is no success of the job.
    let shipped =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/kitchen-spiral.toml")).unwrap();
    let text = shipped.replacen("[job]", "[control]\nlaw = \"pd\"\nfrequency_rad_s = 15\n[job]", 1);
    assert_ne!(text, shipped);
    std::fs::write(dir.join("pd.toml"), text).unwrap();
    let ran = platewash(
        dir,
        &["run", "--scenario", "pd.toml", "--out", "pd", "--json", "--quiet"],
    );
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    let report = ran.json();
    assert_eq!(report["verdict"], "swept", "the plan is proved all the same");
    assert_eq!(report["simulation"]["verdict"], "not_swept");
}

#[test]
fn a_plan_of_the_papers_program_is_simulated_under_its_law() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--scenario", "paper-appendix", "--quiet"]).done();
    let ran = platewash(dir, &["simulate", "out/plan.json", "--json"]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    let report = ran.json();
    assert_eq!(report["verdict"], "not_swept");
    assert_eq!((&report["law"], &report["effort"]), (&"paper".into(), &().into()));
}

#[test]
fn refuses_plans_that_cannot_be_simulated() {
    let folder = folder();
    let dir = folder.path();
    planned(dir);
    let refused = |line: &[&str], fragments: &[&str]| {
        let line: Vec<_> = ["simulate", "out/plan.json"].iter().chain(line).copied().collect();
        platewash(dir, &line).refused(2, fragments);
    };
    refused(&["--law", "magic"], &["magic", "computed_torque"]);
    refused(&["--frequency", "5000"], &["not stable", "1000 Hz", "at most"]);
    refused(&["--frequency", "-1"], &["above 0"]);
    refused(&["--damping", "NaN"], &["finite"]);
    refused(&["--rate", "1e12"], &["too much work", "control.rate_hz"]);
    refused(&["--dt", "1e-9"], &["--dt", "from 0.000001 to 10"]);
    refused(&["--dt", "1e-5"], &["time step", "rows", "at least 0.0000318 s"]);
    assert_eq!(
        names(&dir.join("out")),
        ["plan.json", "trajectory.csv"],
        "nothing half-written"
    );
    platewash(dir, &["simulate", "none.json"]).refused(2, &["none.json"]);
}

#[test]
fn tune_shows_the_effect_of_frequency_and_damping() {
    let folder = folder();
    let dir = folder.path();
    planned(dir);
    let line = [
        "tune",
        "out/plan.json",
        "--law",
        "pd_gravity",
        "--frequencies",
        "10,60,5000",
        "--dampings",
        "1",
        "--json",
        "--out",
        "tuned",
    ];
    let rows = platewash(dir, &line).done().json();
    let rows = rows.as_array().unwrap();
    let error = |k: usize| rows[k]["simulated"]["tip_rms_m"].as_f64().unwrap();
    assert!(error(1) < 0.5 * error(0));
    assert!(rows[2]["refused"].as_str().unwrap().contains("not stable"));
    let csv = std::fs::read_to_string(dir.join("tuned/tune.csv")).unwrap();
    assert_eq!(csv.lines().count(), 4);
    assert!(csv.lines().all(|line| line.split(',').count() == 8), "{csv}");
    let table = platewash(dir, &["tune", "out/plan.json", "--frequencies", "20,30"])
        .done()
        .stdout;
    assert_eq!(table.matches("washed").count(), 4, "{table}");
    platewash(dir, &["tune", "out/plan.json", "--law", "paper"]).refused(2, &["no frequency to tune", "--law pd"]);
    platewash(dir, &["tune", "out/plan.json", "--frequencies", "1,x"]).refused(2, &["finite number above 0"]);
}
