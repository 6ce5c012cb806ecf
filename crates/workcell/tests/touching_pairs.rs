//! Pairs of links that always touch, and the SRDF that lists them.

use platewash_kinematics::irb120::IRB120_URDF;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{DisabledPairs, RobotModel};
use platewash_workcell::clearance::{TouchingPairs, exclusions};
use platewash_workcell::fixtures::kitchen_tool;
use platewash_workcell::workcell::Obstacle;

#[test]
fn an_arm_without_a_link_for_tools_has_the_same_pairs() {
    let robot = RobotModel::irb120().unwrap();
    let renamed = IRB120_URDF.replace("\"tool0\"", "\"hand\"");
    let other = RobotModel::from_urdf(&renamed, &MeshSource::none()).unwrap();
    assert_eq!(TouchingPairs::of(&robot).unwrap(), TouchingPairs::of(&other).unwrap());
}

/// An SRDF that is read back excludes the pairs that were found.
#[test]
fn the_written_srdf_excludes_the_found_pairs() {
    let robot = RobotModel::irb120().unwrap();
    let found = TouchingPairs::of(&robot).unwrap();
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
