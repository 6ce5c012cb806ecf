//! Certified jobs of other arms: washed, or what is known of why not.

use super::*;

pub const UR5: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/crates/kinematics/tests/fixtures/ur5_lengths.urdf"
);
const KR5: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/crates/kinematics/tests/fixtures/kr5_lengths.urdf"
);

/// A cell with plates of 220 mm.
pub fn cell(dir: &Path, start_deg: &str, positions_m: &str, plate_height_m: f64) -> PathBuf {
    cell_of(dir, start_deg, positions_m, plate_height_m, 0.11)
}

fn cell_of(dir: &Path, start_deg: &str, positions_m: &str, plate_height_m: f64, plate_radius_m: f64) -> PathBuf {
    let path_radius_m = plate_radius_m - 0.02;
    let text = format!(
        r#"
name = "cell"
seed = 1
[job]
program = "certified"
on_failure = "fail"
[robot]
start_deg = {start_deg}
[tool]
length_m = 0.15
[layout]
positions_m = {positions_m}
plate_radius_m = {plate_radius_m}
plate_height_m = {plate_height_m}
[wash]
turns = 3
path_radius_m = {path_radius_m}
height_m = 0
closing_ring = true
clearance_m = 0.01
"#
    );
    let path = dir.join("cell.toml");
    std::fs::write(&path, text).unwrap();
    path
}

pub const UR5_START: &str = "[0, -90, 90, -90, -90, 0]";

pub fn run(dir: &Path, verb: &str, file: &Path, urdf: &str) -> CommandOutput {
    let file = file.to_str().unwrap();
    platewash(dir, &[verb, "--scenario", file, "--urdf", urdf, "--out", "o", "--json"])
}

/// The tilt search of the first plate goes up to the limit; the motion between its points went 0.0026° beyond.
#[test]
fn the_largest_tilt_is_kept_by_an_arm_that_needs_all_of_it() {
    let folder = folder();
    let dir = folder.path();
    for positions in ["[[0.55, 0.0]]", "[[0.55, 0.0], [0.1, 0.55], [0.1, -0.55]]"] {
        let file = cell(dir, "[0, -90, 90, 0, 90, 0]", positions, 0.2);
        let report = run(dir, "run", &file, KR5).done().json();
        assert_eq!(report["verdict"], "swept", "{}", report["headline"]);
    }
}

/// The same place, seen from axis 1: it was washed at −150° and denied at 180°.
#[test]
fn plates_behind_the_start_are_not_refused() {
    let folder = folder();
    let dir = folder.path();
    for positions in ["[[-0.4408, -0.2545]]", "[[-0.509, 0.0]]"] {
        let file = cell(dir, UR5_START, positions, 0.1);
        let report = run(dir, "run", &file, UR5).done().json();
        assert_eq!(report["verdict"], "swept", "{}", report["headline"]);
    }
}

#[test]
fn searches_without_result_are_not_called_impossible() {
    let folder = folder();
    let dir = folder.path();
    // With axis 6 beside axis 5 there is no closed form.
    let text = std::fs::read_to_string(UR5).unwrap();
    let moved = text.replace("xyz=\"0 0 0.09465\"", "xyz=\"0.01 0 0.09465\"");
    assert_ne!(moved, text);
    std::fs::write(dir.join("searched.urdf"), moved).unwrap();
    let file = cell_of(dir, UR5_START, "[[0.92, 0.0]]", 0.1, 0.06);
    for arm in [UR5, "searched.urdf"] {
        let ran = run(dir, "plan", &file, arm);
        assert_eq!(ran.code, 3, "{}", ran.stderr);
        let report = ran.json();
        assert_eq!(report["verdict"], "not_found");
        assert_eq!(report["plates"][0]["conclusion"], "not_found");
        let headline = report["headline"].as_str().unwrap();
        assert!(
            headline.starts_with("NOT FOUND: no way to wash plate 1 at (0.920, 0.000) m whole was found"),
            "{headline}"
        );
        assert!(!headline.contains("cannot"), "{headline}");
    }
    // Farther away than the links are long together, it is known.
    let file = cell_of(dir, UR5_START, "[[2.0, 0.0]]", 0.1, 0.06);
    let ran = run(dir, "plan", &file, UR5);
    assert_eq!(ran.code, 3, "{}", ran.stderr);
    let report = ran.json();
    assert_eq!(
        (&report["verdict"], &report["plates"][0]["conclusion"]),
        (&"infeasible".into(), &"beyond_reach".into())
    );
    assert!(
        report["headline"]
            .as_str()
            .unwrap()
            .contains("cannot be washed: at least 100"),
        "{}",
        report["headline"]
    );
}
