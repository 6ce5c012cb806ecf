//! Arms and tools that cannot exist are refused by name.

use nalgebra::Vector3;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{RobotModel, UrdfError};
use platewash_simulator::dynamics::MassPropertiesError;
use platewash_simulator::{DynamicsError, DynamicsModel};
use platewash_workcell::tool::StraightTool;

fn edited(old: &str, new: &str) -> Result<RobotModel, UrdfError> {
    assert_eq!(IRB120_URDF.matches(old).count(), 1, "{old}");
    RobotModel::from_urdf(&IRB120_URDF.replace(old, new), &MeshSource::none())
}

fn refusal(old: &str, new: &str) -> DynamicsError {
    DynamicsModel::new(&edited(old, new).unwrap(), None).unwrap_err()
}

/// The `<inertial>` element of a link, as the file has it.
fn inertial(link: &str) -> &'static str {
    let from = IRB120_URDF.find(&format!("<link name=\"{link}\">")).unwrap();
    let start = from + IRB120_URDF[from..].find("<inertial>").unwrap();
    let end = start + IRB120_URDF[start..].find("</inertial>").unwrap() + "</inertial>".len();
    &IRB120_URDF[start..end]
}

#[test]
fn a_link_without_mass_is_named() {
    for link in ["link_1", "link_4", "link_6"] {
        let error = refusal(inertial(link), "");
        assert_eq!(error, DynamicsError::Missing { link: link.to_owned() });
        assert!(error.to_string().contains(link), "{error}");
    }
}

#[test]
fn the_base_needs_no_mass() {
    let robot = edited(inertial("base_link"), "").unwrap();
    assert!(DynamicsModel::new(&robot, None).is_ok());
}

#[test]
fn a_violated_triangle_inequality_is_named() {
    let error = refusal("ixx=\"0.0603111\"", "ixx=\"0.0703111\"");
    assert!(
        matches!(&error, DynamicsError::Link { link, cause: MassPropertiesError::Inertia(_) } if link == "link_2"),
        "{error}"
    );
    let message = error.to_string();
    assert!(
        message.contains("'link_2'") && message.contains("triangle") && message.contains("0.0703111"),
        "{message}"
    );
}

#[test]
fn negative_inertia_and_no_mass_are_named() {
    let error = refusal("ixx=\"0.000404891\"", "ixx=\"-0.000404891\"");
    assert!(
        matches!(&error, DynamicsError::Link { link, .. } if link == "link_5"),
        "{error}"
    );
    let error = refusal("<mass value=\"1.328\"/>", "<mass value=\"0\"/>");
    assert!(
        matches!(&error, DynamicsError::Link { link, cause: MassPropertiesError::Mass(_) } if link == "link_4"),
        "{error}"
    );
    let negative = edited("<mass value=\"1.328\"/>", "<mass value=\"-1.328\"/>").unwrap_err();
    assert!(
        matches!(&negative, UrdfError::Mass { link, .. } if link == "link_4"),
        "{negative}"
    );
}

#[test]
fn a_point_on_the_last_axis_resists_nothing() {
    let text = inertial("link_6");
    let point = "<inertial><origin xyz=\"0.1 0 0\"/><mass value=\"1\"/>\
        <inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial>";
    let error = refusal(text, point);
    assert!(
        matches!(&error, DynamicsError::NoInertia { joint, link } if joint == "joint_6" && link == "link_6"),
        "{error}"
    );
}

#[test]
fn tools_have_their_stated_mass() {
    let robot = RobotModel::irb120().unwrap();
    let bare = DynamicsModel::new(&robot, None).unwrap();
    let tool = StraightTool {
        length_m: 0.15,
        mass_kg: 0.3,
        ..StraightTool::default()
    };
    let held = DynamicsModel::new(&robot, Some(&tool.into())).unwrap();
    assert!((held.moving_mass_kg() - bare.moving_mass_kg() - 0.3).abs() < 1e-12);
    let weightless = [
        StraightTool { length_m: 0.0, ..tool },
        StraightTool { mass_kg: 0.0, ..tool },
    ];
    for tool in weightless {
        let held = DynamicsModel::new(&robot, Some(&tool.into())).unwrap();
        assert_eq!(held.moving_mass_kg(), bare.moving_mass_kg());
    }
    let odd = StraightTool {
        inertia_kg_m2: Some([1.0, 0.0, 0.0, 0.1, 0.0, 0.1]),
        ..tool
    };
    let error = DynamicsModel::new(&robot, Some(&odd.into())).unwrap_err();
    assert!(
        matches!(
            error,
            DynamicsError::Tool {
                cause: MassPropertiesError::Inertia(_)
            }
        ) && error.to_string().starts_with("tool: ")
    );
    let nothing = StraightTool {
        mass_kg: f64::NAN,
        ..tool
    };
    assert!(DynamicsModel::new(&robot, Some(&nothing.into())).is_err());
    assert!(bare.with_gravity(Vector3::new(0.0, f64::NAN, 0.0)).is_err());
}
