//! `platewash robot --suggest`: what it suggests can be used.

use super::*;
use serde_json::Value;

#[test]
fn suggested_cells_are_proved() {
    let folder = folder();
    let dir = folder.path();
    let ran = platewash(dir, &["robot", "--suggest", "--json", "--out", "found"]);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    let answer: Value = serde_json::from_str(&ran.stdout).unwrap();
    let found = dir.join("found");
    assert!(
        std::fs::read_to_string(found.join("region.svg"))
            .unwrap()
            .contains("Where plates can be washed")
    );
    let srdf = std::fs::read_to_string(found.join("touching.srdf")).unwrap();
    assert!(srdf.contains("<!-- adjacent: the links share a joint -->"), "{srdf}");
    // Two plates in the sector, from the home, with the list.
    let urdf = concat!(env!("CARGO_MANIFEST_DIR"), "/urdf/irb120.urdf");
    let text = include_str!("../../scenarios/kitchen-spiral.toml")
        .replace(
            "start_deg = [0, 0, 0, 0, 90, 0]",
            &format!("start_deg = {}", answer["start_deg"]),
        )
        .replace(
            "model = \"irb120\"",
            &format!("urdf = {urdf:?}\nsrdf = \"found/touching.srdf\"\npayload_kg = 3"),
        )
        .replace(
            "region = \"appendix\"",
            &format!("rho_m = {}\nazimuth_deg = {}", answer["rho_m"], answer["azimuth_deg"]),
        )
        .replace("count = 4", "count = 2");
    std::fs::write(dir.join("cell.toml"), text).unwrap();
    let ran = platewash(dir, &["run", "--scenario", "cell.toml"]);
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.starts_with("PROVED: 2 plates"), "{}", ran.stdout);
    let said = platewash(dir, &["robot", "--suggest"]).stdout;
    assert!(
        said.contains("start_deg = [") && said.contains("wrote suggested/region.svg"),
        "{said}"
    );
}

#[test]
fn a_cell_without_a_home_is_run_from_one_that_is_found() {
    let folder = folder();
    let dir = folder.path();
    let text = include_str!("../../scenarios/kitchen-spiral.toml").replace("start_deg = [0, 0, 0, 0, 90, 0]", "");
    std::fs::write(dir.join("cell.toml"), text).unwrap();
    let ran = platewash(dir, &["plan", "--scenario", "cell.toml"]);
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
    assert!(
        ran.stderr
            .contains("robot.start_deg is not stated for this arm: a clear home is looked for"),
        "{}",
        ran.stderr
    );
    // The same again: what is verified is the job of the scenario.
    let ran = platewash(dir, &["verify", "out/plan.json", "--against", "cell.toml"]);
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
}

/// An arm twice as large as the IRB 120, and nothing else: the plates lie where it can wash them. The lines that are printed, in a
/// scenario, give the same plan.
#[test]
fn another_arm_alone_is_enough_for_a_proved_wash() {
    let folder = folder();
    let dir = folder.path();
    let urdf = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/crates/kinematics/tests/fixtures/kr5_lengths.urdf"
    );
    let ran = platewash(dir, &["run", "--urdf", urdf]);
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
    assert!(ran.stdout.starts_with("PROVED: 4 plates"), "{}", ran.stdout);
    let (_, lines) = ran.stderr.split_once("[robot]\n").expect("lines to keep");
    let (start, layout) = lines.split_once("\n[layout]\n").unwrap();
    let own: Value = serde_json::from_str(&std::fs::read_to_string(dir.join("out/plan.json")).unwrap()).unwrap();
    // Only these keys of the layout are other ones.
    let layout = layout.lines().take(5).collect::<Vec<_>>().join("\n");
    let file = kitchen(
        dir,
        &[
            ("start_deg = [0, 0, 0, 0, 90, 0]", start),
            ("region = \"appendix\"", &layout),
            ("count = 4", ""),
            ("base_radius_m = 0.28", ""),
        ],
    );
    let file = file.to_str().unwrap();
    let ran = platewash(dir, &["plan", "--urdf", urdf, "--scenario", file, "--out", "again"]);
    assert_eq!(ran.code, 0, "{}{}", ran.stdout, ran.stderr);
    let again: Value = serde_json::from_str(&std::fs::read_to_string(dir.join("again/plan.json")).unwrap()).unwrap();
    assert_eq!(own["hash"], again["hash"]);
}

#[test]
fn a_home_of_joints_without_limits_names_none() {
    let folder = folder();
    let dir = folder.path();
    let endless = include_str!("../../urdf/irb120.urdf").replace("type=\"revolute\"", "type=\"continuous\"");
    std::fs::write(dir.join("endless.urdf"), endless).unwrap();
    let line = ["robot", "--suggest", "--urdf", "endless.urdf", "--tool-mount", "tool0"];
    let ran = platewash(dir, &line);
    assert_eq!(ran.code, 0, "{}", ran.stderr);
    assert!(ran.stdout.contains("; no joint has a limit; "), "{}", ran.stdout);
}
