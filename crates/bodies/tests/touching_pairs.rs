//! Pairs of links that always touch, and the SRDF that lists them.

use platewash_bodies::clearance::{TouchingPairs, exclusions};
use platewash_fixtures::kitchen_tool;
use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{DisabledPairs, RobotModel};
use platewash_workcell::Obstacle;

#[test]
fn an_arm_without_a_link_for_tools_has_the_same_pairs() {
    let robot = RobotModel::irb120().unwrap();
    let renamed = IRB120_URDF.replace("\"tool0\"", "\"hand\"");
    let other = RobotModel::from_urdf(&renamed, &MeshSource::none()).unwrap();
    assert_eq!(
        TouchingPairs::find(&robot).unwrap(),
        TouchingPairs::find(&other).unwrap()
    );
}

/// An SRDF that is read back excludes the pairs that were found.
#[test]
fn the_written_srdf_excludes_the_found_pairs() {
    let robot = RobotModel::irb120().unwrap();
    let found = TouchingPairs::find(&robot).unwrap();
    assert_eq!(found.neighbours.len(), 6);
    assert!(
        found
            .always_touching
            .contains(&["link_4".to_owned(), "link_6".to_owned()]),
        "{found:?}"
    );
    let text = found.srdf();
    assert!(
        text.contains("<!-- adjacent") && text.contains("in each of 64 configurations"),
        "{text}"
    );
    let listed = robot
        .clone()
        .with_disabled_pairs(DisabledPairs::parse(&text).unwrap())
        .unwrap();
    let floor = [Obstacle::floor()];
    let pairs = |robot: &RobotModel| -> Vec<_> {
        let left_out = exclusions(robot, &kitchen_tool(), &floor).unwrap();
        left_out.into_iter().map(|e| e.pair).collect()
    };
    assert_eq!(pairs(&listed), pairs(&robot.without_disabled_pairs()));
}

/// Links that share no joint are no neighbours, also where the bodies that carry them share one.
#[test]
fn links_beside_a_joint_are_no_neighbours() {
    let beside = r#"<link name="fence"><collision><origin xyz="0.5 0 0.5"/><geometry><box size="0.05 0.05 1"/></geometry></collision></link>
      <joint name="fence_joint" type="fixed"><parent link="base_link"/><child link="fence"/></joint>
      <link name="bar"><collision><origin xyz="0.3 0 0.1"/><geometry><box size="0.6 0.02 0.02"/></geometry></collision></link>
      <joint name="bar_joint" type="fixed"><parent link="link_1"/><child link="bar"/></joint></robot>"#;
    let text = IRB120_URDF.replace("</robot>", beside);
    let arm = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let found = TouchingPairs::find(&arm).unwrap();
    let are = |a: &str, b: &str| {
        found.neighbours.contains(&[a.to_owned(), b.to_owned()])
            || found.neighbours.contains(&[b.to_owned(), a.to_owned()])
    };
    assert!(are("base_link", "link_1") && are("link_1", "link_2"), "{found:?}");
    for (a, b) in [
        ("fence", "bar"),
        ("fence", "link_1"),
        ("base_link", "bar"),
        ("bar", "link_2"),
    ] {
        assert!(!are(a, b), "{a} {b}");
    }
    // A link without a shape is stood for by what is fixed to it.
    let bare = IRB120_URDF.replace("</robot>", beside).replace(r#"<link name="link_1">"#, r#"<link name="shell">"#).replace(
        "</robot>",
        r#"<link name="link_1"/><joint name="shell_joint" type="fixed"><parent link="link_1"/><child link="shell"/></joint></robot>"#,
    );
    let arm = RobotModel::from_urdf(&bare, &MeshSource::none()).unwrap();
    assert!(arm.share_a_joint("shell", "link_2") && arm.share_a_joint("base_link", "shell"));
    assert!(!arm.share_a_joint("fence", "shell"));
}
