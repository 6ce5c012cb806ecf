//! Elements that are not complete: an arm loads without them where they do not matter, and names them.

use crate::urdf::{edited, load, with_joint};
use platewash_kinematics::RobotModel;
use platewash_kinematics::irb120::IRB120_URDF;

/// Statements of a text that are not used or not complete.
fn named(text: &str) -> Vec<String> {
    let model = load(text).unwrap();
    model.unused_statements().iter().map(ToString::to_string).collect()
}

/// The end of the last link's collision shape, which stands in the text once.
const LAST: &str = "<geometry><sphere radius=\"0.0255\"/></geometry>\n    </collision>";

/// The arm with a visual more on its last link, and another one behind it.
fn with_visual(visual: &str) -> String {
    let good = "<visual name=\"good\"><geometry><sphere radius=\"0.01\"/></geometry></visual>";
    let at = IRB120_URDF.find("<link name=\"link_6\">").unwrap() + "<link name=\"link_6\">".len();
    format!("{}{visual}{good}{}", &IRB120_URDF[..at], &IRB120_URDF[at..])
}

fn visuals(text: &str) -> usize {
    let model: RobotModel = load(text).unwrap();
    model
        .links()
        .iter()
        .find(|link| link.name == "link_6")
        .unwrap()
        .visuals
        .len()
}

#[test]
fn visuals_that_are_not_complete_are_left_out_by_name() {
    let sound = visuals(&with_visual(""));
    for (visual, words) in [
        ("<visual/>", "link 'link_6': <visual> without geometry (line "),
        (
            "<visual><geometry/></visual>",
            "link 'link_6', visual: <geometry> without a shape (line ",
        ),
        (
            "<visual>\n<geometry>\n</geometry></visual>",
            "link 'link_6', visual: <geometry> without a shape",
        ),
        (
            "<visual><geometry><plane/></geometry></visual>",
            "link 'link_6', visual, geometry: <plane> (line ",
        ),
        (
            "<visual><geometry><box/></geometry></visual>",
            "link 'link_6', visual, geometry: <box> without size",
        ),
        (
            "<visual><geometry><box size=\"1 2\"/></geometry></visual>",
            "visual, geometry: size=\"1 2\", not as many numbers",
        ),
        (
            "<visual><geometry><sphere radius=\"big\"/></geometry></visual>",
            "visual, geometry: radius=\"big\", not",
        ),
        (
            "<visual><geometry><mesh/></geometry></visual>",
            "link 'link_6', visual, geometry: <mesh> without filename",
        ),
        (
            "<visual><origin xyz=\"0 1\"/><geometry><sphere radius=\"1\"/></geometry></visual>",
            "link 'link_6', visual: xyz=\"0 1\", not",
        ),
    ] {
        let text = with_visual(visual);
        let all = named(&text);
        assert!(all.len() == 1 && all[0].contains(words), "{visual}: {all:?}");
        assert_eq!(visuals(&text), sound, "{visual}");
    }
}

#[test]
fn looks_that_are_not_complete_do_not_stop_the_arm() {
    let with = |material: &str| {
        with_visual(&format!(
            "<visual><geometry><sphere radius=\"1\"/></geometry>{material}</visual>"
        ))
    };
    let colour = |text: &str| {
        let model = load(text).unwrap();
        model.links().iter().find(|link| link.name == "link_6").unwrap().visuals[0].rgba
    };
    for (material, words, rgba) in [
        (
            "<material><color rgba=\"0.5 0.25 1 1\"/></material>",
            Some("link 'link_6', visual: <material> without name (line "),
            Some([0.5, 0.25, 1.0, 1.0]),
        ),
        (
            "<material name=\"m\"><color rgba=\"0.5 0.5 0.5\"/></material>",
            Some("link 'link_6', visual, material: rgba=\"0.5 0.5 0.5\", not four numbers"),
            None,
        ),
        (
            "<material name=\"m\"><color/></material>",
            Some("link 'link_6', visual, material: <color> without rgba"),
            None,
        ),
        (
            "<material name=\"m\"><color rgba=\"red\"/></material>",
            Some("rgba=\"red\""),
            None,
        ),
        ("<material name=\"m\"><texture/></material>", None, None),
        ("<material name=\"\"><texture file=\"a.png\"/></material>", None, None),
    ] {
        let text = with(material);
        let all = named(&text);
        let is_named = |words: &str| all.len() == 1 && all[0].contains(words);
        assert!(words.map_or(all.is_empty(), is_named), "{material}: {all:?}");
        assert_eq!(colour(&text), rgba, "{material}");
    }
    let global = edited(&[(
        "<link name=\"base_link\">",
        "<material><color rgba=\"1 1\"/></material><link name=\"base_link\">",
    )]);
    assert_eq!(named(&global).len(), 2, "{:?}", named(&global));
}

#[test]
fn a_link_with_half_of_its_mass_properties_has_none() {
    for (part, words) in [
        (
            "<mass value=\"0.137\"/>",
            "link 'link_6': <inertial> without mass (line ",
        ),
        ("ixx=\"0.001\" ", "link 'link_6', inertial: <inertia> without ixx"),
    ] {
        let text = edited(&[(part, "")]);
        let all = named(&text);
        assert!(all.len() == 1 && all[0].contains(words), "{all:?}");
        let model = load(&text).unwrap();
        let last = model.links().iter().find(|link| link.name == "link_6").unwrap();
        assert_eq!(last.inertial, None);
    }
}

#[test]
fn soft_limits_hold_without_the_gains_of_their_controller() {
    for (gains, words) in [
        (
            "k_position=\"10\"",
            Some("joint 'joint_2': <safety_controller> without k_velocity (line "),
        ),
        ("k_position=\"a\" k_velocity='b'", None),
        ("", Some("<safety_controller> without k_velocity")),
    ] {
        let soft =
            format!("effort=\"0\"/><safety_controller {gains} soft_lower_limit=\"-1\" soft_upper_limit=\"0.5\"/>");
        let text = with_joint("joint_2", "effort=\"0\"/>", &soft);
        let limits = load(&text).unwrap().limits().clone();
        assert_eq!([limits.lower[1], limits.upper[1]], [-1.0, 0.5], "{gains}");
        let all = named(&text);
        assert!(
            words.map_or(all.is_empty(), |words| all.len() == 1 && all[0].contains(words)),
            "{all:?}"
        );
    }
}

/// What a collision shape encloses must not count as free.
#[test]
fn a_collision_shape_is_left_out_only_where_nothing_is_stated() {
    for collision in [
        "<collision/>",
        "<collision name=\"c\"><geometry/></collision>",
        "<collision><origin xyz=\"0 0 1\"/></collision>",
    ] {
        let text = edited(&[(LAST, &format!("{LAST}{collision}"))]);
        let all = named(&text);
        assert!(
            all.len() == 1 && all[0].contains("link 'link_6'") && all[0].contains("without"),
            "{all:?}"
        );
        assert_eq!(load(&text).unwrap().links(), load(IRB120_URDF).unwrap().links());
    }
    for shape in [
        "<plane/>",
        "<box/>",
        "<mesh/>",
        "<cylinder radius=\"1\"/>",
        "<sphere radius=\"\"/>",
    ] {
        let text = edited(&[(
            LAST,
            &format!("{LAST}<collision><geometry>{shape}</geometry></collision>"),
        )]);
        let error = load(&text).unwrap_err().to_string();
        let tag = shape.trim_start_matches('<').split([' ', '/']).next().unwrap();
        assert!(
            error.contains("link 'link_6'") && error.contains(&format!("<{tag}> is unknown or not complete")),
            "{error}"
        );
    }
}

/// Statements that cannot matter may be anything.
#[test]
fn statements_that_cannot_matter_are_not_read() {
    let more = "<transmission><type/><joint/></transmission><gazebo><sensor/></gazebo><ros2_control><hardware/></ros2_control>";
    let text = edited(&[("</robot>", &format!("{more}</robot>"))]);
    let calibrated = text.replacen(
        "<axis xyz=\"0 0 1\"/>",
        "<axis xyz=\"0 0 1\"/><calibration rising=\"soon\"/>",
        1,
    );
    for text in [text, calibrated] {
        assert_eq!(named(&text), [""; 0]);
        assert_eq!(load(&text).unwrap().limits(), load(IRB120_URDF).unwrap().limits());
    }
}

/// `urdf-rs` refuses shapes without size from version 1.1 on, also where nothing depends on them.
#[test]
fn visuals_without_size_do_not_stop_arms_of_newer_versions() {
    let text = with_visual(
        "<visual><geometry><sphere radius=\"0\"/></geometry></visual><visual><geometry><box size=\"1 -1 1\"/></geometry></visual>",
    );
    for version in ["1.0", "1.1", "1.2"] {
        let text = text.replacen(
            "<robot name=\"irb120\"",
            &format!("<robot name=\"irb120\" version=\"{version}\""),
            1,
        );
        let model = load(&text).unwrap();
        assert_eq!(
            model.visual_findings().len() + model.unused_statements().len(),
            2,
            "{version}"
        );
        assert_eq!(visuals(&text), visuals(&with_visual("")), "{version}");
    }
}

/// A stray reference to a character is text, too.
#[test]
fn references_to_characters_are_named() {
    let all = named(&with_visual("&amp;"));
    assert!(
        all.len() == 1 && all[0].starts_with("link 'link_6': the text \"&amp;\""),
        "{all:?}"
    );
}
