//! The link from which the controller counts, in descriptions of several shapes.

use crate::urdf::{edited, load};
use nalgebra::Vector3;
use platewash_kinematics::{Pose, RobotModel};
use std::f64::consts::PI;

const PARENT: &str = "<parent link=\"base_link\"/>\n    <child link=\"base\"/>\n    <origin xyz=\"0 0 0\"/>";

/// The IRB 120 with its link `base` at an origin below a link, and more elements.
fn arm(parent: &str, origin: &str, more: &str) -> RobotModel {
    let joint = format!("<parent link=\"{parent}\"/>\n    <child link=\"base\"/>\n    <origin {origin}/>");
    load(&edited(&[(PARENT, &joint), ("</robot>", &format!("{more}\n</robot>"))])).unwrap()
}

/// A fixed joint, and its child.
fn fixed(parent: &str, child: &str, origin: &str) -> String {
    format!(
        "<link name=\"{child}\"/><joint name=\"{parent}-{child}\" type=\"fixed\"><parent link=\"{parent}\"/><child link=\"{child}\"/>\
         <origin {origin}/></joint>"
    )
}

/// Asserts the link, the root link and T_root_base, and returns the words.
fn assert_base(arm: &RobotModel, [link, root]: [&str; 2], pose: &Pose) -> String {
    let base = arm.controller_base().unwrap();
    assert_eq!([base.link, base.root], [link, root]);
    assert!(
        (base.pose.to_homogeneous() - pose.to_homogeneous()).amax() < 1e-12,
        "{}",
        base.pose
    );
    base.to_string()
}

fn turned(yaw: f64) -> Pose {
    Pose::rotation(Vector3::z() * yaw)
}

#[test]
fn a_base_at_the_root_link_is_not_apart() {
    assert_eq!(RobotModel::irb120().unwrap().controller_base(), None);
    assert_eq!(arm("base_link", "xyz=\"0 0 5e-10\"", "").controller_base(), None);
    let other = edited(&[
        ("<link name=\"base\"/>", "<link name=\"other\"/>"),
        ("child link=\"base\"", "child link=\"other\""),
    ]);
    assert_eq!(load(&other).unwrap().controller_base(), None);
}

#[test]
fn a_base_may_be_raised_or_turned() {
    let raised = arm("base_link", "xyz=\"0 0 0.33\"", "");
    let words = assert_base(&raised, ["base", "base_link"], &Pose::translation(0.0, 0.0, 0.33));
    assert_eq!(words, "link 'base', 330.0 mm above link 'base_link'");
    let half = arm("base_link", "rpy=\"0 0 3.141592653589793\"", "");
    let words = assert_base(&half, ["base", "base_link"], &turned(PI));
    assert_eq!(
        words,
        "link 'base', at the place of link 'base_link', turned by roll, pitch, yaw = (0, 0, 180.0)°"
    );
    let aside = arm("base_link", "xyz=\"0.1 0 -0.2\"", "")
        .controller_base()
        .unwrap()
        .to_string();
    assert_eq!(aside, "link 'base', at (100.0, 0, -200.0) mm of link 'base_link'");
}

/// The turn of the first joint comes before the shift of the second one.
#[test]
fn a_base_may_hang_on_two_fixed_joints() {
    let more = fixed("base_link", "plinth", "xyz=\"0.1 0 0\" rpy=\"0 0 1.5707963267948966\"");
    let arm = arm("plinth", "xyz=\"0.2 0 0.3\"", &more);
    let expected = Pose::translation(0.1, 0.2, 0.3) * turned(0.5 * PI);
    assert_base(&arm, ["base", "base_link"], &expected);
}

#[test]
fn a_base_counts_below_a_root_link_world() {
    let world = "<link name=\"world\"/><joint name=\"stand\" type=\"fixed\"><parent link=\"world\"/><child link=\"base_link\"/>\
                 <origin xyz=\"0 0 0.7\"/></joint>";
    let both = arm("base_link", "xyz=\"0 0 0.29\"", world);
    assert_base(&both, ["base", "world"], &Pose::translation(0.0, 0.0, 0.99));
    // Without a link `base` the arm's first link stands for it.
    let text = edited(&[
        ("<link name=\"base\"/>", "<link name=\"other\"/>"),
        ("child link=\"base\"", "child link=\"other\""),
        ("</robot>", &format!("{world}</robot>")),
    ]);
    assert_base(
        &load(&text).unwrap(),
        ["base_link", "world"],
        &Pose::translation(0.0, 0.0, 0.7),
    );
}

#[test]
fn names_may_have_a_prefix() {
    let text = edited(&[(PARENT, &PARENT.replace("0 0 0", "0 0 0.4"))]);
    let text = text
        .replace("\"base_link\"", "\"left_base_link\"")
        .replace("\"base\"", "\"left_base\"");
    assert_base(
        &load(&text).unwrap(),
        ["left_base", "left_base_link"],
        &Pose::translation(0.0, 0.0, 0.4),
    );
}

/// A link `base` that a joint moves, such as that of a gripper, is none of the arm's.
#[test]
fn a_moving_link_is_no_base() {
    assert_eq!(arm("link_6", "xyz=\"0 0 0.1\"", "").controller_base(), None);
}
