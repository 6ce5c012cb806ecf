//! Mounts and touched places of arms whose controller does not count from the root link: refused with both readings, or as stated.

use nalgebra::{Isometry3, Vector3};
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_scenario::{Note, Scenario};
use tempfile::TempDir;

const BASE: &str = "<child link=\"base\"/>\n    <origin xyz=\"0 0 0\"/>";
const TURNED: &str = "rpy=\"0 0 3.141592653589793\"";
const RAISED: &str = "xyz=\"0 0 0.29\"";

/// A folder with an IRB 120 whose link `base` lies at an origin, two touched plates, and a scenario.
fn folder(origin: &str, robot: &str, layout: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let arm = IRB120_URDF.replace(BASE, &format!("<child link=\"base\"/>\n    <origin {origin}/>"));
    let plates = "name,touched_x_mm,touched_y_mm,touched_z_mm\none,-300,-350,30\ntwo,-300,350,30\n";
    let scenario = format!(
        "[robot]\nurdf = \"arm.urdf\"\nstart_deg = [0, 0, 0, 0, 90, 0]\n{robot}[tool]\nlength_m = 0.15\n[layout]\n{layout}[wash]\nheight_m = 0\n"
    );
    for (name, text) in [
        ("arm.urdf", arm.as_str()),
        ("plates.csv", plates),
        ("mine.toml", &scenario),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

const TOUCHED: &str = "plate_file = \"plates.csv\"\n";
const LISTED: &str = "positions_m = [[0.4, 0.2]]\nplate_height_m = 0.1\n";

fn load(folder: &TempDir) -> Scenario {
    Scenario::load(&folder.path().join("mine.toml").to_string_lossy()).unwrap()
}

/// Places of the plates, or why there are none.
fn places(folder: &TempDir) -> Result<Vec<Vector3<f64>>, String> {
    let scenario = load(folder);
    let read = scenario.plates_read().map_err(|error| error.to_string())?;
    let arm = read.arm().unwrap();
    let layout = read.layout(&arm).map_err(|error| error.to_string())?;
    Ok(layout
        .plates
        .iter()
        .map(|plate| plate.world(&Vector3::zeros()))
        .collect())
}

fn assert_places(folder: &TempDir, expected: [[f64; 3]; 2]) {
    let found = places(folder).unwrap();
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - Vector3::from(expected)).norm() < 1e-12, "{found} {expected:?}");
    }
}

fn assert_refused(folder: &TempDir, words: &[&str]) {
    let said = places(folder).unwrap_err();
    assert!(words.iter().all(|word| said.contains(word)), "{said}");
}

#[test]
fn touched_places_without_their_link_are_refused_with_both_readings() {
    assert_refused(
        &folder(TURNED, "", TOUCHED),
        &[
            "plates.csv: line 2, column 2 (touched_x_mm)",
            "layout.touched_from = \"root\" the plate is at (-0.3000, -0.3500, 0.0300) m",
            "with \"base\" at (0.3000, 0.3500, 0.0300) m",
        ],
    );
    assert_refused(
        &folder(RAISED, "", TOUCHED),
        &["at (-0.3000, -0.3500, 0.0300) m", "at (-0.3000, -0.3500, 0.3200) m"],
    );
}

#[test]
fn touched_places_count_from_the_stated_link() {
    let from = |link: &str| format!("{TOUCHED}touched_from = \"{link}\"\n");
    assert_places(
        &folder(TURNED, "", &from("base")),
        [[0.3, 0.35, 0.03], [0.3, -0.35, 0.03]],
    );
    assert_places(
        &folder(TURNED, "", &from("root")),
        [[-0.3, -0.35, 0.03], [-0.3, 0.35, 0.03]],
    );
    assert_places(
        &folder(RAISED, "", &from("base")),
        [[-0.3, -0.35, 0.32], [-0.3, 0.35, 0.32]],
    );
    // A mount of the base takes the touched places along: by hand, the base stands at the world's origin.
    let mount = "mount_m = [0, 0, 0.5]\nmount_link = \"base\"\n";
    assert_places(
        &folder(RAISED, mount, &from("base")),
        [[-0.3, -0.35, 0.53], [-0.3, 0.35, 0.53]],
    );
    assert_places(
        &folder(RAISED, mount, &from("root")),
        [[-0.3, -0.35, 0.24], [-0.3, 0.35, 0.24]],
    );
}

#[test]
fn a_base_at_the_root_link_needs_no_statement() {
    let mount = "mount_m = [0, 0, 0.5]\n";
    let origin = "xyz=\"0 0 0\"";
    assert_places(
        &folder(origin, mount, TOUCHED),
        [[-0.3, -0.35, 0.53], [-0.3, 0.35, 0.53]],
    );
    let folder = folder(origin, "", TOUCHED);
    assert_eq!(Note::of_arm(&load(&folder).arm().unwrap()), []);
}

#[test]
fn a_mount_without_its_link_is_refused_with_both_readings() {
    let words = [
        "robot.mount_m, robot.mount_rpy_deg, robot.mount_link",
        "the root link 'base_link' and the controller's base, 'base',",
        "\"root\" link 'base_link' stands at (0.0000, 0.0000, 0.4500) m",
        "\"base\" at (0.0000, 0.0000, 0.1600) m",
    ];
    let mount = "mount_m = [0, 0, 0.45]\n";
    assert_refused(&folder(RAISED, mount, LISTED), &words);
    assert_refused(&folder(RAISED, mount, TOUCHED), &words);
    let folder = folder(RAISED, mount, LISTED);
    let refused = load(&folder).job().unwrap_err().to_string();
    assert!(refused.contains(words[3]), "{refused}");
}

#[test]
fn a_mount_is_that_of_the_stated_link() {
    let mounted = |link: &str| {
        let mount = format!("mount_m = [0.1, 0.2, 0.45]\nmount_rpy_deg = [0, 90, 0]\nmount_link = \"{link}\"\n");
        let folder = folder(RAISED, &mount, LISTED);
        let scenario = load(&folder);
        let arm = scenario.arm().unwrap();
        (scenario.workcell(&arm, 1).unwrap().mount, scenario.foot_m(&arm))
    };
    // By hand: z of the arm is x of the world.
    let turn = Isometry3::rotation(Vector3::y() * 90_f64.to_radians());
    for (link, x_m) in [("root", 0.1), ("base", 0.1 - 0.29)] {
        let (mount, foot_m) = mounted(link);
        let expected = Isometry3::translation(x_m, 0.2, 0.45) * turn;
        assert!(
            (mount.to_homogeneous() - expected.to_homogeneous()).amax() < 1e-12,
            "{mount}"
        );
        assert!((foot_m[0] - x_m).abs() < 1e-12 && foot_m[1] == 0.2);
    }
}

/// Nothing is refused where neither key is of any matter; a note tells where the controller counts from.
#[test]
fn an_arm_at_the_origin_is_noted() {
    let folder = folder(TURNED, "", LISTED);
    assert_eq!(places(&folder).unwrap().len(), 1);
    let notes = Note::of_arm(&load(&folder).arm().unwrap());
    let said = notes[0].to_string();
    assert!(
        said.contains("counts from link 'base', at the place of link 'base_link', turned by"),
        "{said}"
    );
}

/// A key of touched places or of a mesh is not dropped where there are none.
#[test]
fn keys_of_files_that_are_not_there_are_refused() {
    let load_text = |text: &str| Scenario::parse(text, "mine").map_err(|error| error.to_string());
    let plate =
        |keys: &str| format!("[tool]\nlength_m = 0.15\n[[plate]]\nat_m = [0.4, 0, 0.05]\n{keys}[wash]\nheight_m = 0\n");
    for (keys, words) in [
        ("unit = \"mm\"\n", "plate[0].unit"),
        ("face = \"-z\"\n", "plate[0].face"),
    ] {
        let found = load_text(&plate(keys)).unwrap_err();
        assert!(
            found.contains(words) && found.contains("of a mesh or of points"),
            "{found}"
        );
    }
    let listed = format!("[tool]\nlength_m = 0.15\n[layout]\n{LISTED}touched_from = \"base\"\n[wash]\nheight_m = 0\n");
    let found = load_text(&listed).unwrap_err();
    assert!(found.contains("layout.touched_from"), "{found}");
    let folder = folder(RAISED, "", &format!("{TOUCHED}touched_from = \"base\"\n"));
    std::fs::write(folder.path().join("plates.csv"), "name,x_m,y_m,z_m\none,0.3,0.3,0.03\n").unwrap();
    let found = places(&folder).unwrap_err();
    assert!(found.contains("touched_from") && found.contains("no column"), "{found}");
}
