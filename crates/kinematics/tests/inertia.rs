//! Inertias that no body of a link's mass and size has.

use crate::urdf::{edited, load};
use platewash_kinematics::RobotModel;
use platewash_kinematics::inertia::ImplausibleInertia;
use proptest::prelude::*;

const LAST: &str = "<inertia ixx=\"0.001\" ixy=\"0\" ixz=\"0\" iyy=\"0.001\" iyz=\"0\" izz=\"0.001\"/>";

fn found(arm: &RobotModel) -> Vec<ImplausibleInertia> {
    arm.implausible_inertias().collect()
}

fn with_inertia(moments: [f64; 3]) -> Vec<ImplausibleInertia> {
    let [xx, yy, zz] = moments;
    let text = format!("<inertia ixx=\"{xx}\" ixy=\"0\" ixz=\"0\" iyy=\"{yy}\" iyz=\"0\" izz=\"{zz}\"/>");
    found(&load(&edited(&[(LAST, &text)])).unwrap())
}

/// The last link: 0.137 kg within a ball of 25.5 mm about (-16, 0, 0) mm, its centre of mass at (-7.06, -0.17, 0) mm.
#[test]
fn moments_in_another_unit_are_found() {
    assert_eq!(found(&load(platewash_kinematics::irb120::IRB120_URDF).unwrap()), []);
    let radius_m = 0.0255 * 3.0_f64.sqrt() + (0.00894_f64.powi(2) + 0.00017_f64.powi(2)).sqrt();
    let most = 0.137 * radius_m * radius_m;
    for moments in [
        [150.0 * most; 3],
        [1e6 * most, 0.0, 0.0],
        [most / 1300.0; 3],
        [0.0, 1e-12, 0.0],
        [-most; 3],
    ] {
        let [one] = &with_inertia(moments)[..] else {
            panic!("{moments:?}")
        };
        assert_eq!((one.link.as_str(), one.mass_kg), ("link_6", 0.137));
        assert!((one.radius_m - radius_m).abs() < 1e-5, "{one:?}");
        assert!((one.possible_kg_m2[1] / most - 1.0).abs() < 1e-3, "{one:?}");
    }
    for moments in [[99.0 * most, most, 99.0 * most], [most / 1000.0; 3], [0.0, 0.0, most]] {
        assert_eq!(with_inertia(moments), [], "{moments:?}");
    }
}

/// A mass of 0 with an inertia is one that no body has; a link without shapes has no size.
#[test]
fn massless_links_and_links_without_size() {
    let massless = edited(&[("<mass value=\"0.137\"/>", "<mass value=\"0\"/>")]);
    assert_eq!(found(&load(&massless).unwrap()).len(), 1);
    let inertial = "<inertial><mass value=\"1\"/><inertia ixx=\"1e9\" ixy=\"0\" ixz=\"0\" iyy=\"1e9\" iyz=\"0\" izz=\"1e9\"/></inertial>";
    let bare = edited(&[(
        "<link name=\"flange\"/>",
        &format!("<link name=\"flange\">{inertial}</link>"),
    )]);
    assert_eq!(found(&load(&bare).unwrap()), []);
}

proptest! {
    /// Two masses anywhere in a link's box, however they are turned, are a body that it can hold.
    #[test]
    fn no_body_within_its_shape_is_reported(
        half in prop::array::uniform3(0.01..0.5f64),
        ends in prop::array::uniform6(-1.0..1.0f64),
        mass in 0.1..50.0f64,
        share in 0.2..0.8f64,
    ) {
        let at = |k: usize| nalgebra::Vector3::from_fn(|axis, _| ends[3 * k + axis] * half[axis]);
        let (a, b) = (at(0), at(1));
        let com = a * share + b * (1.0 - share);
        let apart = (a - b).norm();
        prop_assume!(apart > half.iter().copied().fold(0.0, f64::max));
        // About the common centre of mass.
        let across = (nalgebra::Matrix3::identity() * apart * apart - (a - b) * (a - b).transpose()) * (mass * share * (1.0 - share));
        let [x, y, z] = [0, 1, 2].map(|k| 2.0 * half[k]);
        let text = format!(
            "<origin xyz=\"{} {} {}\"/><mass value=\"{mass}\"/><inertia ixx=\"{}\" ixy=\"{}\" ixz=\"{}\" iyy=\"{}\" iyz=\"{}\" izz=\"{}\"/></inertial>\
             <collision><geometry><box size=\"{x} {y} {z}\"/></geometry></collision>",
            com.x, com.y, com.z, across[(0, 0)], across[(0, 1)], across[(0, 2)], across[(1, 1)], across[(1, 2)], across[(2, 2)],
        );
        let link = format!("<link name=\"flange\"><inertial>{text}</link>");
        let arm = load(&edited(&[("<link name=\"flange\"/>", &link)])).map_err(|error| TestCaseError::fail(error.to_string()))?;
        prop_assert_eq!(found(&arm), []);
    }
}
