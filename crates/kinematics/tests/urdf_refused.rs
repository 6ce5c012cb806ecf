//! Every malformation of a URDF is refused, under its own name, with a message that says where it is.

use crate::urdf::{edited, joint, load, with_joint};
use platewash_kinematics::UrdfError;
use platewash_kinematics::irb120::IRB120_URDF;
use proptest::prelude::*;
use std::time::{Duration, Instant};

/// Asserts that a text is refused with the given variant and that the message has all the given words.
macro_rules! assert_refused {
    ($text:expr, $variant:pat, $($word:expr),+) => {{
        let error = load(&$text).expect_err("must be refused");
        assert!(matches!(error, $variant), "another variant: {error:?}");
        let message = error.to_string();
        $(assert!(message.contains($word), "no '{}' in: {message}", $word);)+
    }};
}

const LIMIT_2: &str = r#"<limit lower="-1.91986" upper="1.91986" velocity="4.36332" effort="0"/>"#;

fn with_limit_2(limit: &str) -> String {
    with_joint("joint_2", LIMIT_2, limit)
}

// ---- limits ----

#[test]
fn rejects_a_missing_limit() {
    assert_refused!(with_limit_2(""), UrdfError::MissingLimit { .. }, "joint_2", "velocity");
    let zeros = r#"<limit lower="0" upper="0" velocity="0" effort="0"/>"#;
    assert_refused!(with_limit_2(zeros), UrdfError::MissingLimit { .. }, "joint_2");
}

#[test]
fn rejects_a_continuous_joint_without_speed_limit() {
    let text = edited(&[
        (LIMIT_2, ""),
        (
            "name=\"joint_2\" type=\"revolute\"",
            "name=\"joint_2\" type=\"continuous\"",
        ),
    ]);
    assert!(
        text.contains("<limit lower=\"-1.91986\" upper=\"1.22173\""),
        "joint 3 keeps its own"
    );
    assert_refused!(
        text,
        UrdfError::MissingVelocity { .. },
        "joint_2",
        "give velocity",
        "position needs none"
    );
}

#[test]
fn rejects_a_missing_velocity() {
    let limit = r#"<limit lower="-1.91986" upper="1.91986" effort="0"/>"#;
    assert_refused!(
        with_limit_2(limit),
        UrdfError::Velocity { .. },
        "joint 'joint_2'",
        "speed limit",
        "found none"
    );
}

#[test]
fn rejects_reversed_limits() {
    let limit = r#"<limit lower="1.5" upper="-1.25" velocity="4" effort="0"/>"#;
    assert_refused!(
        with_limit_2(limit),
        UrdfError::LimitOrder { .. },
        "joint_2",
        "1.5",
        "-1.25"
    );
}

#[test]
fn rejects_empty_limits() {
    let limit = r#"<limit lower="0.5" upper="0.5" velocity="4" effort="0"/>"#;
    assert_refused!(with_limit_2(limit), UrdfError::LimitOrder { .. }, "joint_2", "0.5");
    let without_positions = r#"<limit velocity="4" effort="0"/>"#;
    assert_refused!(with_limit_2(without_positions), UrdfError::LimitOrder { .. }, "joint_2");
}

#[test]
fn rejects_degrees_instead_of_radians() {
    let limit = r#"<limit lower="-110" upper="110" velocity="250" effort="0"/>"#;
    assert_refused!(
        with_limit_2(limit),
        UrdfError::LimitSize { .. },
        "joint_2",
        "110",
        "degrees"
    );
}

#[test]
fn rejects_position_limits_that_are_not_finite() {
    for (lower, upper) in [("NaN", "1"), ("-1", "nan"), ("-inf", "1"), ("-1", "Infinity")] {
        let limit = format!(r#"<limit lower="{lower}" upper="{upper}" velocity="4" effort="0"/>"#);
        assert_refused!(
            with_limit_2(&limit),
            UrdfError::NotFinite { .. },
            "joint_2",
            "limit",
            "finite"
        );
    }
}

#[test]
fn rejects_invalid_speed_limits() {
    for velocity in ["NaN", "inf", "-inf", "0", "-4"] {
        let limit = format!(r#"<limit lower="-1" upper="1" velocity="{velocity}" effort="1"/>"#);
        assert_refused!(
            with_limit_2(&limit),
            UrdfError::Velocity { .. },
            "joint_2",
            &velocity[..1]
        );
    }
}

#[test]
fn rejects_negative_or_nan_effort() {
    for effort in ["-5", "NaN", "-inf"] {
        let limit = format!(r#"<limit lower="-1" upper="1" velocity="4" effort="{effort}"/>"#);
        assert_refused!(with_limit_2(&limit), UrdfError::Effort { .. }, "joint_2", &effort[..1]);
    }
}

#[test]
fn rejects_words_in_place_of_numbers() {
    let limit = r#"<limit lower="minus one" upper="1" velocity="4" effort="0"/>"#;
    assert_refused!(
        with_limit_2(limit),
        UrdfError::Syntax { .. },
        "joint 'joint_2'",
        "line 431"
    );
    for origin in ["0 0 zero", "0 0 0,29", "0 0 oops 0.29"] {
        let text = with_joint("joint_2", "0 0 0.29", origin);
        assert_refused!(text, UrdfError::Syntax { .. }, "<origin>", "line 434", "xyz");
    }
    let text = with_joint("joint_2", "0 0 0.29", "0 0.29");
    assert_refused!(text, UrdfError::Syntax { .. }, "joint 'joint_2'", "expected 3 found 2");
}

// ---- vectors and lengths ----

#[test]
fn rejects_origins_that_are_not_finite() {
    for name in ["joint_2", "flange-tool0"] {
        for origin in [
            r#"xyz="0 0 NaN""#,
            r#"xyz="0 inf 0""#,
            r#"rpy="NaN 0 0""#,
            r#"rpy="0 0 -inf""#,
        ] {
            let before = joint(name);
            let start = before.find("<origin").unwrap();
            let old = &before[start..start + before[start..].find("/>").unwrap()];
            let text = with_joint(name, old, &format!("<origin {origin}"));
            assert_refused!(text, UrdfError::NotFinite { .. }, name, "origin", &origin[..3]);
        }
    }
}

#[test]
fn rejects_axes_without_direction() {
    for axis in ["0 0 0", "1e-12 0 0", "0 NaN 1", "0 1 inf", "1e300 1e300 0"] {
        let text = with_joint("joint_2", "0 1 0", axis);
        assert_refused!(text, UrdfError::Axis { .. }, "joint_2", "axis");
    }
}

#[test]
fn rejects_millimetres_instead_of_metres() {
    let text = with_joint("joint_2", "0 0 0.29", "0 0 290");
    assert_refused!(text, UrdfError::TooLong { .. }, "joint_2", "290", "metres");
    let text = edited(&[("size=\"0.1825 0.181 0.017\"", "size=\"182.5 181 17\"")]);
    assert_refused!(text, UrdfError::TooLong { .. }, "link 'base_link'", "box", "metres");
}

#[test]
fn rejects_collision_shapes_without_size() {
    let cases = [
        (
            "<sphere radius=\"0.0255\"/>",
            "<sphere radius=\"0\"/>",
            "link_6",
            "sphere",
        ),
        (
            "<sphere radius=\"0.0255\"/>",
            "<sphere radius=\"-1\"/>",
            "link_6",
            "sphere",
        ),
        (
            "<sphere radius=\"0.0255\"/>",
            "<capsule radius=\"0.1\" length=\"0\"/>",
            "link_6",
            "capsule",
        ),
        (
            "size=\"0.1825 0.181 0.017\"",
            "size=\"0.1825 -0.181 0.017\"",
            "base_link",
            "box",
        ),
        ("length=\"0.1665\"", "length=\"0\"", "base_link", "cylinder"),
    ];
    for (old, new, link, shape) in cases {
        assert_refused!(edited(&[(old, new)]), UrdfError::ShapeSize { .. }, link, shape);
    }
}

#[test]
fn rejects_collision_shapes_that_are_not_finite() {
    let cases = [
        (
            "<sphere radius=\"0.0255\"/>",
            "<sphere radius=\"NaN\"/>",
            "link_6",
            "sphere",
        ),
        (
            "size=\"0.1825 0.181 0.017\"",
            "size=\"inf 0.181 0.017\"",
            "base_link",
            "box",
        ),
        (
            "<origin xyz=\"-0.016 0 0\"/>",
            "<origin xyz=\"nan 0 0\"/>",
            "link_6",
            "origin",
        ),
    ];
    for (old, new, link, what) in cases {
        assert_refused!(edited(&[(old, new)]), UrdfError::NotFinite { .. }, link, what);
    }
}

#[test]
fn rejects_invalid_masses() {
    let with_mass = |mass: &str| edited(&[("<mass value=\"0.137\"/>", &format!("<mass value=\"{mass}\"/>"))]);
    assert_refused!(with_mass("-0.137"), UrdfError::Mass { .. }, "link_6", "-0.137");
    assert_refused!(with_mass("NaN"), UrdfError::NotFinite { .. }, "link_6", "mass");
    let text = edited(&[("ixx=\"0.001\"", "ixx=\"inf\"")]);
    assert_refused!(text, UrdfError::NotFinite { .. }, "link_6", "inertia");
}

// ---- structure ----

#[test]
fn rejects_unknown_parent_and_child() {
    let text = with_joint("joint_4", "<parent link=\"link_3\"/>", "<parent link=\"elbow\"/>");
    assert_refused!(text, UrdfError::UnknownLink { .. }, "joint_4", "parent", "elbow");
    let text = with_joint("joint_4", "<child link=\"link_4\"/>", "<child link=\"forearm\"/>");
    assert_refused!(text, UrdfError::UnknownLink { .. }, "joint_4", "child", "forearm");
}

#[test]
fn rejects_duplicate_links_and_joints() {
    let text = edited(&[("<link name=\"base\"/>", "<link name=\"base\"/><link name=\"link_3\"/>")]);
    assert_refused!(text, UrdfError::Duplicate { kind: "link", .. }, "links", "link_3");
    let text = with_joint("joint_5", "name=\"joint_5\"", "name=\"joint_4\"");
    assert_refused!(text, UrdfError::Duplicate { kind: "joint", .. }, "joints", "joint_4");
}

#[test]
fn rejects_a_link_with_two_parents() {
    let second =
        r#"<joint name="short_cut" type="fixed"><parent link="link_1"/><child link="link_4"/></joint></robot>"#;
    let text = edited(&[("</robot>", second)]);
    assert_refused!(text, UrdfError::TwoParents { .. }, "link_4", "joint_4", "short_cut");
}

#[test]
fn rejects_a_ring_of_all_links() {
    let back = r#"<joint name="back" type="fixed"><parent link="tool0"/><child link="base_link"/></joint></robot>"#;
    assert_refused!(
        edited(&[("</robot>", back)]),
        UrdfError::Cycle { .. },
        "cycle",
        "link '"
    );
}

#[test]
fn rejects_a_ring_apart_from_the_arm() {
    let text = with_joint("link_6-flange", "<parent link=\"link_6\"/>", "<parent link=\"tool0\"/>");
    let error = load(&text).unwrap_err();
    assert!(
        matches!(&error, UrdfError::Cycle { link } if link == "flange" || link == "tool0"),
        "{error}"
    );
    // What hangs below the ring comes first by name, and is not part of it.
    let below = r#"<link name="a"/><joint name="j_a" type="fixed"><parent link="aa"/><child link="a"/></joint>
        <link name="aa"/><joint name="j_aa" type="fixed"><parent link="flange"/><child link="aa"/></joint></robot>"#;
    let error = load(&text.replace("</robot>", below)).unwrap_err();
    assert!(
        matches!(&error, UrdfError::Cycle { link } if link == "flange" || link == "tool0"),
        "{error}"
    );
    let text = with_joint("flange-tool0", "<parent link=\"flange\"/>", "<parent link=\"tool0\"/>");
    assert_refused!(text, UrdfError::Cycle { .. }, "tool0");
}

#[test]
fn rejects_two_roots_and_no_root() {
    let text = edited(&[(joint("flange-tool0"), "")]);
    assert_refused!(text, UrdfError::Roots { .. }, "one root", "base_link, tool0");
    assert_refused!("<robot name=\"void\"/>", UrdfError::Roots { .. }, "one root", "none");
}

#[test]
fn rejects_five_and_seven_axes() {
    let five = with_joint("joint_6", "type=\"revolute\"", "type=\"fixed\"");
    assert_refused!(five, UrdfError::AxisCount { .. }, "found 5", "joint_1", "joint_5");
    let seven = with_joint(
        "link_6-flange",
        "type=\"fixed\">",
        &format!("type=\"revolute\">{LIMIT_2}"),
    );
    assert_refused!(
        seven,
        UrdfError::AxisCount { .. },
        "found 7",
        "joint_6",
        "link_6-flange"
    );
}

#[test]
fn rejects_axes_that_are_not_in_series() {
    let text = with_joint("joint_6", "<parent link=\"link_5\"/>", "<parent link=\"link_3\"/>");
    assert_refused!(text, UrdfError::Branch { .. }, "joint_6", "joint_4");
}

#[test]
fn rejects_other_kinds_of_joint() {
    for kind in ["prismatic", "floating", "planar", "spherical"] {
        let text = with_joint("joint_3", "type=\"revolute\"", &format!("type=\"{kind}\""));
        assert_refused!(text, UrdfError::JointKind { .. }, "joint_3", kind);
    }
    let text = with_joint("joint_3", "type=\"revolute\"", "type=\"rotary\"");
    assert_refused!(text, UrdfError::Syntax { .. }, "joint 'joint_3'", "rotary");
}

#[test]
fn rejects_axes_that_move_each_other() {
    let text = with_joint("joint_3", "<axis", "<mimic joint=\"joint_2\" multiplier=\"-1\"/><axis");
    assert_refused!(text, UrdfError::Coupled { .. }, "'joint_3'", "'joint_2'", "'joint_4'");
    for leader in ["joint_3", "nowhere", "joint_6-flange"] {
        let text = with_joint("joint_3", "<axis", &format!("<mimic joint=\"{leader}\"/><axis"));
        assert_refused!(text, UrdfError::NoLeader { .. }, "'joint_3'", leader);
    }
}

#[test]
fn rejects_elements_without_required_parts() {
    let cases = [
        (
            with_joint("joint_5", "<parent link=\"link_4\"/>", ""),
            "joint 'joint_5'",
            "parent",
        ),
        (
            with_joint("joint_5", " type=\"revolute\"", ""),
            "joint 'joint_5'",
            "type",
        ),
        (
            with_joint("joint_5", "name=\"joint_5\" ", ""),
            "<joint> without a name",
            "name",
        ),
        (
            edited(&[("<sphere radius=\"0.0255\"/>", "<sphere/>")]),
            "link 'link_6'",
            "radius",
        ),
        (
            edited(&[("<sphere radius=\"0.0255\"/>", "<ball/>")]),
            "link 'link_6'",
            "ball",
        ),
    ];
    for (text, element, what) in cases {
        assert_refused!(text, UrdfError::Syntax { .. }, element, what);
    }
}

// ---- the file itself ----

#[test]
fn rejects_xacro() {
    let text = edited(&[(
        "<link name=\"base\"/>",
        "<xacro:property name=\"pi\" value=\"3.14\"/><link name=\"base\"/>",
    )]);
    assert_refused!(text, UrdfError::Xacro { .. }, "xacro:property", "line 477", "expand");
}

#[test]
fn rejects_another_root_element() {
    assert_refused!(
        "<sdf version=\"1.9\"></sdf>",
        UrdfError::NotARobot { .. },
        "<robot>",
        "<sdf>"
    );
    assert_refused!(
        "<!DOCTYPE html><html><body/></html>",
        UrdfError::NotARobot { .. },
        "<html>"
    );
    for empty in ["", " \n\t", "<?xml version=\"1.0\"?>", "<!-- nothing -->"] {
        assert_refused!(empty, UrdfError::NotARobot { .. }, "no element at all");
    }
}

#[test]
fn rejects_text_and_elements_outside_the_root() {
    for (after, what) in [
        ("garbage", "outside the root"),
        ("<robot name=\"second\"/>", "<robot> stands after"),
        ("<link name=\"lost\"/>", "<link> stands after"),
        ("&amp;", "outside the root"),
    ] {
        assert_refused!(format!("{IRB120_URDF}{after}"), UrdfError::Xml { .. }, "line 498", what);
    }
    assert_refused!(
        format!("{{}}{IRB120_URDF}"),
        UrdfError::Xml { .. },
        "line 1",
        "outside the root"
    );
}

#[test]
fn rejects_broken_markup() {
    let cases = [
        ("</link>", "</lnk>"),
        ("<link name=\"link_1\">", "<link name=\"link_1\" name=\"again\">"),
        ("<link name=\"link_1\">", "<link name=link_1>"),
        ("<link name=\"base\"/>", "<!link name=\"base\">"),
    ];
    for edit in cases {
        assert_refused!(edited(&[edit]), UrdfError::Xml { .. }, "line ");
    }
    assert_refused!(
        edited(&[("<link name=\"base\"/>", "&nbsp;")]),
        UrdfError::Syntax { .. },
        "entity"
    );
}

/// The head of the file never loads (but for the white space at its end), the tail never does either.
#[test]
fn rejects_a_description_cut_anywhere() {
    let (root, end) = (IRB120_URDF.find("<robot").unwrap(), IRB120_URDF.trim_end().len());
    let last = (end - 250)..=IRB120_URDF.len();
    for at in (0..end).step_by(41).chain(last) {
        let (head, tail) = IRB120_URDF.split_at(at);
        match load(head) {
            Ok(_) => assert!(at >= end, "half a file loads: {at} bytes"),
            Err(UrdfError::Truncated { element, .. }) => assert!(at > root && IRB120_URDF.contains(&element)),
            Err(UrdfError::Xml { .. } | UrdfError::NotARobot { .. }) => {
                assert!(at < root + "<robot".len() + 15, "cut at {at} of {end}")
            }
            Err(other) => panic!("cut at {at}: {other}"),
        }
        assert!(load(tail).is_err() || at <= root, "the tail from {at} loads");
    }
}

#[test]
fn names_the_open_element_of_a_cut_description() {
    let head = &IRB120_URDF[..IRB120_URDF.find("<mass").unwrap()];
    assert_refused!(head, UrdfError::Truncated { .. }, "<inertial>", "line 35", "cut off");
}

/// On the test's own thread, whose stack is small: a recursive parser would overflow it.
#[test]
fn rejects_elements_nested_twenty_thousand_deep() {
    let deep = format!(
        "<robot name=\"deep\">{}{}</robot>",
        "<link>\n".repeat(20_000),
        "</link>".repeat(20_000)
    );
    assert_refused!(deep, UrdfError::TooDeep { .. }, "65 deep", "line 64");
    let never_closed = "<robot>".repeat(20_000);
    assert_refused!(never_closed, UrdfError::TooDeep { .. }, "at most 64");
}

#[test]
fn rejects_descriptions_over_sixteen_mebibytes() {
    let filler = |bytes: usize| " ".repeat(bytes - IRB120_URDF.len());
    let most = 16 << 20;
    assert_refused!(
        IRB120_URDF.to_owned() + &filler(most + 1),
        UrdfError::TooLarge { .. },
        "16777217",
        "16777216"
    );
    assert!(load(&(IRB120_URDF.to_owned() + &filler(most))).is_ok());
}

/// Reading time grows with the length, not with its square (which would take minutes here).
#[test]
fn two_hundred_thousand_links_are_refused_soon() {
    let links: String = (0..200_000).map(|k| format!("<link name=\"stray_{k}\"/>\n")).collect();
    let start = Instant::now();
    let text = format!("<robot name=\"many\">{links}</robot>");
    assert_refused!(text, UrdfError::TooMany { kind: "link", .. }, "200000", "at most 1000");
    assert!(start.elapsed() < Duration::from_secs(120), "{:?}", start.elapsed());
}

#[test]
fn lists_only_some_of_many_roots() {
    let links: String = (0..200).map(|k| format!("<link name=\"stray_{k}\"/>\n")).collect();
    let text = format!("<robot name=\"many\">{links}</robot>");
    assert_refused!(text, UrdfError::Roots { .. }, "stray_0", "and 180 more");
}

#[test]
fn rejects_too_many_collision_elements() {
    let ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";
    let text = edited(&[(
        "</robot>",
        &format!("<link name=\"balls\">{}</link></robot>", ball.repeat(501)),
    )]);
    assert_refused!(
        text,
        UrdfError::TooMany { kind: "collision", .. },
        "<collision>",
        "at most 500"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Whatever is deleted, doubled or moved: an answer, never a panic; and what still loads is an arm.
    #[test]
    fn random_damage_never_panics(damage in prop::collection::vec((0.0..1.0f64, 1..400usize, 0..3u8, 0.0..1.0f64), 1..5)) {
        let mut bytes = IRB120_URDF.as_bytes().to_vec();
        for (at, length, kind, to) in damage {
            let at = (at * bytes.len() as f64) as usize;
            let piece: Vec<u8> = bytes[at..bytes.len().min(at + length)].to_vec();
            if kind != 1 {
                bytes.drain(at..at + piece.len());
            }
            if kind != 0 {
                let to = (to * bytes.len() as f64) as usize;
                bytes.splice(to..to, piece);
            }
        }
        if let Ok(robot) = load(&String::from_utf8_lossy(&bytes)) {
            let limits = robot.limits();
            prop_assert!((0..6).all(|i| limits.lower[i] < limits.upper[i] && limits.velocity[i] > 0.0));
            let tip = robot.pose(&platewash_kinematics::JointVector::repeat(0.3), &robot.last_link_frame());
            prop_assert!(tip.translation.vector.iter().all(|v| v.is_finite()));
        }
    }

    /// The same for single characters, which leave most of the structure alone.
    #[test]
    fn random_characters_never_panic(edits in prop::collection::vec((0.0..1.0f64, any::<char>()), 1..12)) {
        let mut characters: Vec<char> = IRB120_URDF.chars().collect();
        for (at, character) in edits {
            let at = (at * characters.len() as f64) as usize;
            characters[at] = character;
        }
        let _ = load(&characters.into_iter().collect::<String>());
    }
}
