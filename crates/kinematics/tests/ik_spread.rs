//! Many answers to one pose, on an arm without a closed form.

use platewash_kinematics::ik::{IkError, IkSettings, IkSolver};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{Axes, JointVector, RobotModel, ToolFrame};
use proptest::prelude::*;
use std::f64::consts::TAU;

/// How many of the listed starts are tried.
const LISTED: usize = 96;

fn arm() -> RobotModel {
    RobotModel::from_urdf(include_str!("fixtures/ur5_lengths.urdf"), &MeshSource::none()).unwrap()
}

fn solver(robot: &RobotModel) -> IkSolver<'_> {
    let settings = IkSettings {
        position_tolerance_m: 1e-9,
        orientation_tolerance_rad: 1e-9,
        ..IkSettings::default()
    };
    IkSolver::new(robot, robot.tool_frame(ToolFrame::Tool0).unwrap(), settings).unwrap()
}

/// The largest difference of two configurations, whole turns apart.
fn apart(a: &JointVector, b: &JointVector) -> f64 {
    (a - b).map(|d| (d - TAU * (d / TAU).round()).abs()).amax()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Whichever branch a pose was made on is among the answers, and the answers are answers.
    #[test]
    fn the_branch_that_made_a_pose_is_found(q in prop::array::uniform6(-3.0..3.0f64), near in prop::array::uniform6(-1.5..1.5f64)) {
        let robot = arm();
        let solver = solver(&robot);
        let (q, near) = (JointVector::from(q), JointVector::from(near));
        let poses = robot.fk(&q);
        // Branches meet where the arm is singular.
        prop_assume!(poses.jacobian(solver.frame(), Axes::Base).singular_values().min() > 0.03);
        let target = poses.pose(solver.frame());
        let found = solver.spread(&target, &near, LISTED).unwrap();
        prop_assert!(found.iter().any(|other| apart(other, &q) < 1e-5), "{q} is not among {found:?}");
        for (k, answer) in found.iter().enumerate() {
            let there = robot.fk(answer).pose(solver.frame());
            prop_assert!((there.translation.vector - target.translation.vector).norm() < 2e-9);
            prop_assert!(there.rotation.angle_to(&target.rotation) < 2e-9);
            prop_assert!(robot.limits().contain(answer));
            prop_assert!(found[..k].iter().all(|other| apart(other, answer) > 1e-4));
            prop_assert!(k == 0 || (found[k - 1] - near).norm() <= (answer - near).norm());
        }
    }
}

/// In front of the arm, tool down: shoulder left or right, elbow up or down, wrist plain or flipped.
#[test]
fn all_eight_branches_of_a_pose_in_front_are_found() {
    let robot = arm();
    let solver = solver(&robot);
    let home = JointVector::from([0.0, -90.0, 90.0, -90.0, -90.0, 0.0]).map(f64::to_radians);
    let target = robot
        .fk(&(home + JointVector::new(2.4, 0.3, 0.2, -0.4, 0.2, 0.9)))
        .pose(solver.frame());
    assert_eq!(solver.spread(&target, &home, LISTED).unwrap().len(), 8);
}

#[test]
fn distinguishes_targets_out_of_reach_from_nan() {
    let robot = arm();
    let solver = solver(&robot);
    let mut target = robot.fk(&JointVector::zeros()).pose(solver.frame());
    target.translation.vector.x += 3.0;
    assert_eq!(solver.spread(&target, &JointVector::zeros(), LISTED), Ok(Vec::new()));
    let seed = JointVector::repeat(f64::NAN);
    assert!(matches!(
        solver.spread(&target, &seed, LISTED),
        Err(IkError::Seed { joint: 0, .. })
    ));
    target.translation.vector.x = f64::NAN;
    assert!(matches!(
        solver.spread(&target, &JointVector::zeros(), LISTED),
        Err(IkError::Target { .. })
    ));
}
