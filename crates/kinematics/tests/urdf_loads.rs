//! Descriptions that load, and what they mean: the IRB 120 itself and the variants found in the wild.

use crate::urdf::{edited, joint, load, with_joint};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel, ToolFrame, ToolFrameError};
use std::f64::consts::FRAC_PI_2;

fn irb120() -> RobotModel {
    RobotModel::irb120().unwrap()
}

/// Asserts that two arms put their last link at the same place, at several configurations.
fn assert_same_kinematics(a: &RobotModel, b: &RobotModel) {
    for k in 0..20 {
        let q = JointVector::from_fn(|i, _| f64::from(k) * 0.17 - 1.0 + 0.3 * i as f64);
        let (a, b) = (a.pose(&q, &a.last_link_frame()), b.pose(&q, &b.last_link_frame()));
        assert!((a.to_homogeneous() - b.to_homogeneous()).amax() < 1e-14);
    }
}

// ---- the IRB 120 ----

#[test]
fn reads_names_and_limits_of_the_irb120() {
    let robot = irb120();
    assert_eq!(robot.name(), "irb120");
    for (i, joint) in robot.joints().iter().enumerate() {
        assert_eq!(joint.name, format!("joint_{}", i + 1));
        assert_eq!(joint.child, format!("link_{}", i + 1));
    }
    let limits = robot.limits();
    assert_eq!(
        limits.lower.as_slice(),
        [-2.87979, -1.91986, -1.91986, -2.79253, -2.094395, -6.98132]
    );
    assert_eq!(
        limits.upper.as_slice(),
        [2.87979, 1.91986, 1.22173, 2.79253, 2.094395, 6.98132]
    );
    assert_eq!(
        limits.velocity.as_slice(),
        [4.36332, 4.36332, 4.36332, 5.58505, 5.58505, 7.33038]
    );
    assert_eq!(limits.effort, [None; AXES], "an effort of 0 is unknown, not zero");
}

#[test]
fn orders_links_of_the_irb120_from_the_root() {
    let names: Vec<_> = irb120().links().iter().map(|l| l.name.clone()).collect();
    assert_eq!(names.len(), 10);
    assert_eq!(names[0], "base_link");
    let position = |name: &str| names.iter().position(|n| n == name).unwrap();
    for (parent, child) in [
        ("link_1", "link_2"),
        ("link_6", "flange"),
        ("flange", "tool0"),
        ("base_link", "base"),
    ] {
        assert!(position(parent) < position(child));
    }
}

/// Counts of boxes, cylinders, spheres and capsules.
fn shapes(robot: &RobotModel, link: &str) -> [usize; 4] {
    let link = robot.links().iter().find(|l| l.name == link).unwrap();
    let mut counts = [0; 4];
    for primitive in &link.collision {
        counts[match primitive.shape {
            Shape::Box { .. } => 0,
            Shape::Cylinder { .. } => 1,
            Shape::Sphere { .. } => 2,
            Shape::Capsule { .. } => 3,
            Shape::Hull { .. } => panic!("no meshes here"),
        }] += 1;
    }
    counts
}

#[test]
fn reads_collision_shapes_of_the_irb120() {
    let robot = irb120();
    let expected = [
        ("base_link", [3, 1, 0, 0]),
        ("link_1", [0, 0, 1, 1]),
        ("link_2", [0, 0, 0, 3]),
        ("link_3", [0, 0, 0, 3]),
        ("link_4", [0, 0, 0, 3]),
        ("link_5", [0, 0, 0, 1]),
        ("link_6", [0, 0, 1, 0]),
        ("base", [0; 4]),
        ("flange", [0; 4]),
        ("tool0", [0; 4]),
    ];
    for (link, counts) in expected {
        assert_eq!(shapes(&robot, link), counts, "{link}");
    }
    let capsules: usize = expected.iter().map(|(_, counts)| counts[3]).sum();
    assert_eq!(capsules, 11);
}

/// The capsule of link 5 lies along x: its ends are where the file puts the two spheres.
#[test]
fn a_capsule_is_the_hull_of_its_spheres() {
    let robot = irb120();
    let capsule = &robot.links().iter().find(|l| l.name == "link_5").unwrap().collision[0];
    let Shape::Capsule {
        radius_m,
        half_length_m,
    } = capsule.shape
    else {
        panic!("{capsule:?}")
    };
    assert_eq!((radius_m, half_length_m), (0.0515, 0.0265));
    for (z, x) in [(-half_length_m, -0.026), (half_length_m, 0.027)] {
        let end = capsule.pose * Point3::new(0.0, 0.0, z);
        assert!((end - Point3::new(x, 0.0, 0.0)).norm() < 1e-12, "{end}");
    }
}

#[test]
fn a_sphere_off_the_end_does_not_close_a_capsule() {
    for sphere in ["<origin xyz=\"-0.0261 0 0\"/>", "<origin xyz=\"-0.026 0.0001 0\"/>"] {
        let robot = load(&edited(&[("<origin xyz=\"-0.026 0 0\"/>", sphere)])).unwrap();
        assert_eq!(shapes(&robot, "link_5"), [0, 1, 2, 0]);
    }
}

#[test]
fn reads_masses_of_the_irb120() {
    let robot = irb120();
    let mass = |name: &str| {
        let link = robot.links().iter().find(|l| l.name == name).unwrap();
        link.inertial.as_ref().map(|i| i.mass_kg)
    };
    assert_eq!(mass("base_link"), Some(6.215));
    assert_eq!(mass("link_6"), Some(0.137));
    assert_eq!(mass("tool0"), None);
    let moving: f64 = (1..=6).map(|k| mass(&format!("link_{k}")).unwrap()).sum();
    assert!((moving - 11.931).abs() < 1e-12);
}

#[test]
fn reads_tool_frames_of_the_irb120() {
    let robot = irb120();
    let out_of_the_flange = |which, axis: Vector3<f64>| {
        let pose = robot.pose(&JointVector::zeros(), &robot.tool_frame(which).unwrap());
        assert!((pose.translation.vector - Vector3::new(0.374, 0.0, 0.630)).norm() < 1e-12);
        assert!((pose.rotation * axis - Vector3::x()).norm() < 1e-12, "{which:?}");
    };
    out_of_the_flange(ToolFrame::Flange, Vector3::x());
    out_of_the_flange(ToolFrame::Tool0, Vector3::z());
    out_of_the_flange(ToolFrame::MatlabTool0, Vector3::x());
    assert_eq!(robot.tool_mount(None), robot.tool_frame(ToolFrame::Tool0));
}

#[test]
fn checks_eight_pairs_of_the_irb120() {
    let robot = irb120();
    let disabled = robot.disabled_pairs().unwrap();
    let names: Vec<_> = robot
        .links()
        .iter()
        .filter(|l| !l.collision.is_empty())
        .map(|l| &l.name)
        .collect();
    let mut checked = Vec::new();
    for (i, a) in names.iter().enumerate() {
        checked.extend(
            names[i + 1..]
                .iter()
                .filter(|b| !disabled.contains(a, b))
                .map(|b| (*a, *b)),
        );
    }
    assert_eq!(checked.len(), 8);
    assert!(
        checked
            .iter()
            .all(|(a, b)| ["base_link", "link_1"].contains(&a.as_str()) && b.as_str() > "link_2")
    );
}

#[test]
fn the_hash_is_that_of_the_text() {
    use sha2::{Digest, Sha256};
    let text = with_joint("joint_2", "0 0 0.29", "0 0 0.2900");
    let changed = load(&text).unwrap();
    assert_ne!(changed.sha256(), irb120().sha256(), "the text decides, not its meaning");
    let expected: String = Sha256::digest(text.as_bytes())
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect();
    assert_eq!(changed.sha256(), expected);
}

// ---- joints ----

#[test]
fn a_continuous_joint_has_no_position_limits() {
    let continuous = "type=\"continuous\"";
    let text = with_joint("joint_6", "type=\"revolute\"", continuous);
    let without_positions = text.replacen("lower=\"-6.98132\" upper=\"6.98132\" ", "", 1);
    assert_ne!(without_positions, text);
    let with_infinities = text.replacen(
        "lower=\"-6.98132\" upper=\"6.98132\"",
        "lower=\"-inf\" upper=\"inf\"",
        1,
    );
    for text in [text, without_positions, with_infinities] {
        let robot = load(&text).unwrap();
        let limits = robot.limits();
        assert_eq!((limits.lower[5], limits.upper[5]), (f64::NEG_INFINITY, f64::INFINITY));
        assert_eq!(limits.velocity[5], 7.33038);
        assert!(limits.contain(&JointVector::new(0.0, 0.0, 0.0, 0.0, 0.0, 1e6)));
        assert_same_kinematics(&robot, &irb120());
    }
}

/// URDF 1.2: a limit that is left out is none, so it reads as infinite.
#[test]
fn urdf_1_2_may_leave_limits_out() {
    let text = with_joint("joint_6", "type=\"revolute\"", "type=\"continuous\"")
        .replacen(
            "lower=\"-6.98132\" upper=\"6.98132\" velocity=\"7.33038\" effort=\"0\"",
            "velocity=\"7\"",
            1,
        )
        .replacen("<robot ", "<robot version=\"1.2\" ", 1);
    let robot = load(&text).unwrap();
    assert_eq!(robot.limits().velocity[5], 7.0);
    assert_eq!(robot.limits().effort, [None; AXES]);
}

#[test]
fn a_stated_effort_is_a_limit() {
    let robot = load(&with_joint("joint_3", "effort=\"0\"", "effort=\"56.7\"")).unwrap();
    assert_eq!(robot.limits().effort, [None, None, Some(56.7), None, None, None]);
}

/// URDF's defaults: the axis is x, the origin the identity. An axis of any length is a direction.
#[test]
fn joints_without_axis_or_origin_have_defaults() {
    for text in [
        with_joint("joint_4", "<axis xyz=\"1 0 0\"/>", ""),
        with_joint("joint_1", "<origin xyz=\"0 0 0\"/>", ""),
        with_joint("joint_1", " xyz=\"0 0 0\"", ""),
        with_joint("joint_1", "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 20\"/>"),
        with_joint(
            "joint_2",
            "<origin xyz=\"0 0 0.29\"/>",
            "<origin rpy=\"0 0 0\" xyz=\" 0\t0\n 2.9e-1 \"/>",
        ),
    ] {
        assert_same_kinematics(&load(&text).unwrap(), &irb120());
    }
}

#[test]
fn a_reversed_axis_turns_the_other_way() {
    let (robot, reversed) = (irb120(), load(&with_joint("joint_2", "0 1 0", "0 -1 0")).unwrap());
    let q = JointVector::new(0.1, 0.4, -0.2, 0.5, 0.6, -0.7);
    let mut mirrored = q;
    mirrored[1] = -q[1];
    let (a, b) = (
        robot.pose(&q, &robot.last_link_frame()),
        reversed.pose(&mirrored, &reversed.last_link_frame()),
    );
    assert!((a.to_homogeneous() - b.to_homogeneous()).amax() < 1e-14);
}

#[test]
fn order_and_unknown_elements_do_not_matter() {
    let last = joint("joint_1");
    let text = edited(&[
        (
            last,
            "<gazebo reference=\"link_1\"><selfCollide>true</selfCollide></gazebo>",
        ),
        (
            "</robot>",
            &format!("{last}<transmission name=\"t\"><type>simple</type></transmission></robot>\n<!-- end -->\n"),
        ),
        ("<robot ", "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" "),
    ]);
    let robot = load(&text).unwrap();
    assert_same_kinematics(&robot, &irb120());
    assert_eq!(robot.joints()[0].name, "joint_1");
}

#[test]
fn accepts_a_byte_order_mark() {
    assert!(load(&format!("\u{feff}{}", edited(&[]))).is_ok());
}

// ---- tool frames ----

/// The IRB 120 with other links than `flange` and `tool0` behind joint 6: each a name and a fixed joint's origin on link 6.
fn with_links(links: &[(&str, &str)]) -> RobotModel {
    let text = edited(&[
        (joint("link_6-flange"), ""),
        (joint("flange-tool0"), ""),
        ("<link name=\"flange\"/>", ""),
        ("<link name=\"tool0\"/>", ""),
    ]);
    let more = links.iter().map(|(name, origin)| {
        format!(
            "<link name=\"{name}\"/><joint name=\"to {name}\" type=\"fixed\"><parent link=\"link_6\"/><child link=\"{name}\"/>\
             <origin {origin}/></joint>"
        )
    });
    load(&text.replace("</robot>", &format!("{}</robot>", more.collect::<String>()))).unwrap()
}

/// Origin with z along x of link 6, which leads out of the arm.
const Z_OUT: &str = "xyz=\"0 0 0\" rpy=\"0 1.5707963267948966 0\"";
const X_OUT: &str = "xyz=\"0 0 0\" rpy=\"0 0 0\"";

#[test]
fn finds_the_tool_mount_of_each_naming_scheme() {
    let (q, whole) = (JointVector::new(0.3, -0.2, 0.5, 1.0, -0.8, 2.0), irb120());
    assert_eq!(whole.find_tool_mount().unwrap().to_string(), "tool0");
    let expected = whole.pose(&q, &whole.tool_mount(None).unwrap());
    for (links, found) in [
        (&[("flange", X_OUT)][..], "flange:x"),
        (
            &[("left_tool0", Z_OUT), ("flange", X_OUT), ("tcp", "xyz=\"0.1 0 0\"")],
            "left_tool0",
        ),
        (&[("arm_flange", X_OUT), ("ee_link", X_OUT)], "arm_flange:x"),
        (&[("ee_link", X_OUT)], "ee_link:x"),
        (&[("link_eef", Z_OUT)], "link_eef"),
        (
            &[("end_effector_link", Z_OUT), ("tool_frame", Z_OUT)],
            "end_effector_link",
        ),
        (&[("tcp", "rpy=\"0 -1.5707963267948966 0\"")], "tcp:-z"),
        (&[("tcp", "rpy=\"0 0 1.5707963267948966\"")], "tcp:-y"),
    ] {
        let robot = with_links(links);
        let mount = robot.find_tool_mount().unwrap().to_string();
        assert_eq!(mount, found, "{links:?}");
        // z of the mounting frame leads out, as that of the tool0 that was taken away.
        let pose = robot.pose(&q, &robot.tool_mount(Some(&mount)).unwrap());
        assert!(
            (pose.translation.vector - expected.translation.vector).norm() < 1e-14,
            "{links:?}"
        );
        let z = |pose: &Pose| pose.rotation * Vector3::z();
        assert!((z(&pose) - z(&expected)).norm() < 1e-14, "{links:?}");
    }
    // By REP-199, x of the flange is z of tool0 turned about y.
    let robot = with_links(&[("flange", X_OUT)]);
    let pose = robot.pose(&q, &robot.tool_mount(Some("flange:x")).unwrap());
    assert!((pose.to_homogeneous() - expected.to_homogeneous()).amax() < 1e-14);
}

#[test]
fn asks_where_the_description_does_not_tell_the_tool_mount() {
    for (links, reason) in [
        (
            &[("ee_link", X_OUT), ("tcp", "xyz=\"0.1 0 0\"")][..],
            "has the links 'ee_link' and 'tcp' at different places, and either could carry the tool",
        ),
        (
            &[("flange", "rpy=\"0 0 3.141592653589793\"")],
            "has a link 'flange' whose x axis should leave the arm by its name, but -x leads away from axis 5",
        ),
        (
            &[("tool", "rpy=\"0 0.7 0\"")],
            "has a link 'tool' without an axis that leads out along axis 6",
        ),
    ] {
        let said = with_links(links).find_tool_mount().unwrap_err().to_string();
        for part in [
            reason,
            "tool.mounted_on",
            "--tool-mount LINK:AXIS",
            "'link_6' (x leads out)",
        ] {
            assert!(said.contains(part), "no {part} in {said}");
        }
    }
    // The last link alone counts if its origin is where its shape ends.
    let last = |shape: &str| {
        let text = edited(&[
            (joint("link_6-flange"), ""),
            (joint("flange-tool0"), ""),
            ("<link name=\"flange\"/>", ""),
            ("<link name=\"tool0\"/>", ""),
        ]);
        let (before, after) = text.split_at(text.find("<link name=\"link_6\">").unwrap());
        let (from, end) = (after.find("<collision").unwrap(), after.find("</link>").unwrap());
        load(&format!("{before}{}{shape}{}", &after[..from], &after[end..])).unwrap()
    };
    let of_length = |length_m: f64, x_m: f64| {
        format!(
            "<collision><origin xyz=\"{x_m} 0 0\"/><geometry><box size=\"{length_m} 0.04 0.04\"/></geometry></collision>"
        )
    };
    assert_eq!(
        last(&of_length(0.02, -0.01)).find_tool_mount().unwrap().to_string(),
        "link_6:x"
    );
    let said = last(&of_length(0.04, 0.0)).find_tool_mount().unwrap_err().to_string();
    assert!(
        said.contains("the shape of link 'link_6' ends 20.0 mm from its origin"),
        "{said}"
    );
    let bare = last("");
    let said = bare.find_tool_mount().unwrap_err().to_string();
    assert!(said.contains("no shape that tells where link 'link_6' ends"), "{said}");
    let said = bare.tool_mount(Some("link_3")).unwrap_err().to_string();
    assert!(said.contains("has no link 'link_3' behind joint 6"), "{said}");
    let said = bare.tool_mount(None).unwrap_err().to_string();
    assert!(said.contains("has no link 'tool0' behind joint 6"), "{said}");
}

/// Older ROS-Industrial descriptions have no flange: the last link stands in for it.
#[test]
fn without_a_flange_the_last_link_stands_in() {
    let text = edited(&[
        (joint("link_6-flange"), ""),
        ("<link name=\"flange\"/>", ""),
        ("<parent link=\"flange\"/>", "<parent link=\"link_6\"/>"),
    ]);
    let robot = load(&text).unwrap();
    assert_eq!(robot.tool_frame(ToolFrame::Flange).unwrap(), robot.last_link_frame());
    let tool0 = robot.pose(&JointVector::zeros(), &robot.tool_frame(ToolFrame::Tool0).unwrap());
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), FRAC_PI_2);
    assert!(tool0.rotation.angle_to(&turn) < 1e-12);
}

/// A frame called `tool0` that hangs on another link is not the tool.
#[test]
fn tool0_must_be_behind_joint_6() {
    let robot = load(&with_joint(
        "flange-tool0",
        "<parent link=\"flange\"/>",
        "<parent link=\"base\"/>",
    ))
    .unwrap();
    assert!(robot.tool_frame(ToolFrame::Tool0).is_err());
    assert!(robot.frame("tool0").is_ok());
    assert!(matches!(robot.frame("tool1"), Err(ToolFrameError::Missing { .. })));
}

#[test]
fn meshes_are_looked_for_only_where_they_count() {
    // A visual mesh takes no part in anything, so it may be missing.
    let visual = "<geometry><mesh filename=\"package://nowhere/visual.dae\"/></geometry>";
    let robot = RobotModel::from_urdf(
        &edited(&[("<geometry><box size=\"0.18 0.18 0.015\"/></geometry>", visual)]),
        &MeshSource::none(),
    );
    assert!(robot.is_ok());
}

/// Soft limits of a safety controller are inside of the hard ones, where it states some.
#[test]
fn soft_limits_count() {
    let limit = r#"<limit lower="-1.91986" upper="1.91986""#;
    assert!(IRB120_URDF.contains(limit), "joint 2");
    let with = |safety: &str| {
        let start = IRB120_URDF.find(limit).unwrap();
        let end = start + IRB120_URDF[start..].find("/>").unwrap() + 2;
        let text = format!("{}{safety}{}", &IRB120_URDF[..end], &IRB120_URDF[end..]);
        RobotModel::from_urdf(&text, &MeshSource::none()).map(|arm| [arm.limits().lower[1], arm.limits().upper[1]])
    };
    let soft = |words: &str| with(&format!(r#"<safety_controller {words} k_velocity="10"/>"#)).unwrap();
    assert_eq!(soft(r#"soft_lower_limit="-1" soft_upper_limit="1.5""#), [-1.0, 1.5]);
    assert_eq!(soft(r#"soft_lower_limit="-3" soft_upper_limit="1""#), [-1.91986, 1.0]);
    assert_eq!(
        soft(r#"soft_lower_limit="-1""#),
        [-1.0, 0.0],
        "one that is left out is 0"
    );
    assert_eq!(soft(""), [-1.91986, 1.91986], "none");
    assert!(with(r#"<safety_controller soft_lower_limit="2" soft_upper_limit="3" k_velocity="1"/>"#).is_err());
}
