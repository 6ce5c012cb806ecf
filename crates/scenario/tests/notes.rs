//! Notes of numbers that were probably meant in other units.

use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, RobotModel};
use platewash_scenario::{Note, SHIPPED, Scenario};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_6};

fn with_home(start_deg: [f64; AXES]) -> Scenario {
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.robot.start_deg = Some(start_deg);
    scenario
}

#[test]
fn a_home_in_radians_is_noted_with_its_degrees() {
    let scenario = with_home([0.0, -FRAC_PI_2, FRAC_PI_2, 0.0, FRAC_PI_6, 0.0]);
    let notes = scenario.notes();
    assert_eq!(notes.len(), 1, "{notes:?}");
    let message = notes[0].to_string();
    for part in [
        "robot.start_deg",
        "degrees",
        "radians",
        "[0.0, -90.0, 90.0, 0.0, 30.0, 0.0]",
    ] {
        assert!(message.contains(part), "no {part} in {message}");
    }
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.robot.home_deg = Some([0.0, 0.0, 0.0, 0.0, FRAC_PI_2, 0.0]);
    assert!(matches!(
        scenario.notes()[..],
        [Note::HomeInRadians {
            key: "robot.home_deg",
            ..
        }]
    ));
}

#[test]
fn homes_that_make_sense_in_degrees_are_not_noted() {
    for home in [
        [0.0; AXES],
        [0.0, 0.0, 0.0, 0.0, 5.0, -3.0],
        [0.0, 0.0, 0.0, 0.0, 90.0, 0.5],
        [6.5, 0.0, 0.0, 0.0, 0.0, 0.0],
    ] {
        assert_eq!(with_home(home).notes(), [], "{home:?}");
    }
    for shipped in SHIPPED {
        assert_eq!(Scenario::load(shipped.name).unwrap().notes(), []);
    }
}

/// An arm of which every length is a hundred times that of the IRB 120; one in millimetres is refused as it is.
#[test]
fn an_arm_that_reaches_tens_of_metres_is_noted() {
    let no_meshes = MeshSource::none();
    let text = hundredfold(IRB120_URDF);
    let robot = RobotModel::from_urdf(&text, &no_meshes).unwrap();
    let note = Note::of_arm(&robot)[0].to_string();
    assert!(
        note.contains("millimetres were probably meant") && note.contains(robot.name()),
        "{note}"
    );
    assert_eq!(Note::of_arm(&RobotModel::irb120().unwrap()), []);
}

/// The description with the origins of its joints a hundred times as far.
fn hundredfold(urdf: &str) -> String {
    let mut parts = urdf.split("xyz=\"");
    let mut text = parts.next().unwrap().to_owned();
    for part in parts {
        let (numbers, rest) = part.split_once('"').unwrap();
        let is_axis = text.trim_end().ends_with("<axis");
        let scaled: Vec<_> = numbers
            .split_whitespace()
            .map(|v| {
                if is_axis {
                    v.to_owned()
                } else {
                    (100.0 * v.parse::<f64>().unwrap()).to_string()
                }
            })
            .collect();
        text += &format!("xyz=\"{}\"{rest}", scaled.join(" "));
    }
    text
}
