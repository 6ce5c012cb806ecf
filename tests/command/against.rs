//! `platewash verify --against`: whether a plan's job is the one that a scenario asks for.

use super::*;

#[test]
fn a_plan_agrees_with_its_own_scenario_and_with_no_other() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--seed", "3", "--quiet"]).done();
    // Its seed is the plan's where none is given.
    let ran = platewash(dir, &["verify", "out/plan.json", "--against", "kitchen"]).done();
    assert!(ran.stdout.starts_with("PROVED: 4 plates in "), "{}", ran.stdout);
    assert!(
        ran.stdout
            .ends_with("\nagainst \"kitchen\", seed 3: no field differs\n\nmore: --details\n"),
        "{}",
        ran.stdout
    );
    let ran = platewash(
        dir,
        &[
            "verify",
            "out/plan.json",
            "--against",
            "kitchen",
            "--seed",
            "1",
            "--json",
        ],
    );
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    let answer = ran.json();
    assert_eq!(answer["verdict"], "pass", "the plan does its own job");
    assert_eq!(
        (&answer["against"]["scenario"], &answer["against"]["seed"]),
        (&"kitchen".into(), &1.into())
    );
    let differences = answer["against"]["differences"].as_array().unwrap();
    let keys: Vec<_> = differences.iter().map(|d| d["key"].as_str().unwrap()).collect();
    assert_eq!(keys.len(), 9, "two numbers of each plate, and the seed: {keys:?}");
    assert!(
        keys.contains(&"seed") && keys.contains(&"plates[3].pose.position_m[1]"),
        "{keys:?}"
    );
}

/// A requirement that somebody lowered is kept, and certified, but it is not what was asked for.
#[test]
fn a_requirement_that_was_lowered_is_named() {
    let folder = folder();
    let dir = folder.path();
    let low = kitchen(dir, &[("clearance_m = 0.01", "clearance_m = 0.001")]);
    let low = low.to_str().unwrap();
    platewash(dir, &["plan", "--scenario", low, "--quiet"]).done();
    platewash(dir, &["verify", "out/plan.json"]).done();
    platewash(dir, &["verify", "out/plan.json", "--against", low]).done();
    let ran = platewash(dir, &["verify", "out/plan.json", "--against", "kitchen"]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    let first = "OTHER JOB than that of \"kitchen\", seed 1: 1 field differs; PROVED: ";
    assert!(ran.stdout.starts_with(first), "{}", ran.stdout);
    let told = "  requirements.clearance_m: the plan says 0.001, the scenario 0.01\n\nmore: --details\n";
    assert!(ran.stdout.ends_with(told), "{}", ran.stdout);
}

#[test]
fn a_run_of_the_papers_program_is_compared_too() {
    let folder = folder();
    let dir = folder.path();
    platewash(dir, &["plan", "--scenario", "paper-text", "--quiet"]).done();
    let against = |scenario: &str| {
        let ran = platewash(dir, &["verify", "out/plan.json", "--against", scenario]);
        assert_eq!(ran.code, 4, "there is no certificate: {}", ran.stderr);
        ran.stdout
    };
    let same = against("paper-text");
    assert!(
        same.starts_with("NOT PROVED: a run of the paper's program") && same.ends_with("seed 1: no field differs\n"),
        "{same}"
    );
    let other = against("kitchen");
    assert!(
        other.starts_with("OTHER JOB than that of \"kitchen\", seed 1: ") && other.contains("planner.paper"),
        "{other}"
    );
}

/// The scenario's own description is looked at where the plan is for it, so that it need not be given twice.
#[test]
fn the_arm_of_the_scenario_is_taken_where_the_plan_is_for_it() {
    let folder = folder();
    let dir = folder.path();
    let urdf = platewash::kinematics::irb120::IRB120_URDF.replacen("<robot name=\"", "<robot name=\"my_", 1);
    std::fs::write(dir.join("mine.urdf"), urdf).unwrap();
    let mine = kitchen(dir, &[("model = \"irb120\"", "urdf = \"mine.urdf\"")]);
    let mine = mine.to_str().unwrap();
    platewash(dir, &["plan", "--scenario", mine, "--quiet"]).done();
    platewash(dir, &["verify", "out/plan.json"]).refused(2, &["\"my_", "as --urdf FILE"]);
    platewash(dir, &["verify", "out/plan.json", "--against", mine]).done();
    platewash(dir, &["plan", "--quiet"]).done();
    let ran = platewash(dir, &["verify", "out/plan.json", "--against", mine]);
    assert_eq!(ran.code, 4, "{}", ran.stderr);
    for key in ["workcell.arm.name", "workcell.arm.urdf_sha256"] {
        assert!(ran.stdout.contains(&format!("\n  {key}: ")), "{}", ran.stdout);
    }
}
