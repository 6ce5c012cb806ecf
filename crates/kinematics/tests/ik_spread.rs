//! Many answers to one pose by a search, also against the closed form of the same arm.

use platewash_kinematics::ik::analytic::AnalyticArm;
use platewash_kinematics::ik::{IkError, IkSettings, IkSolver};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{Axes, JointVector, RobotModel, ToolFrame};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::{PI, TAU};

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

/// Joints of many turns on one side of 0: the same branches, near the configuration asked for.
#[test]
fn the_branches_do_not_depend_on_how_far_the_joints_turn() {
    let home = JointVector::from([0.0, -90.0, 90.0, -90.0, -90.0, 0.0]).map(f64::to_radians);
    let (robot, by) = (arm(), JointVector::new(2.4, 0.3, 0.2, -0.4, 0.2, 0.9));
    let target = robot.fk(&(home + by)).pose(solver(&robot).frame());
    for (limits, turns) in [
        ([-100.0, 100.0], 0.0),
        ([0.0, 100.0], 1.0),
        ([-100.0, -75.0], -14.0),
        ([-100.0, 100.0], 12.0),
    ] {
        let text = crate::wide::between(include_str!("fixtures/ur5_lengths.urdf"), limits);
        let robot = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
        let near = home.add_scalar(TAU * turns);
        let found = solver(&robot).spread(&target, &near, LISTED).unwrap();
        assert_eq!(found.len(), 8, "{limits:?}");
        assert!(
            found.iter().all(|q| (q - near).amax() <= PI + 1e-9),
            "{limits:?}: {found:?}"
        );
        // From the listed starts alone: `near` is on none of the branches.
        let anywhere = near.add_scalar(0.4);
        assert_eq!(
            solver(&robot).spread(&target, &anywhere, LISTED).unwrap().len(),
            8,
            "{limits:?}"
        );
    }
}

/// The closed form and a search from many starts agree on the branches of random poses. `PLATEWASH_POSES` sets how many are tried.
#[test]
fn the_closed_form_has_every_branch_that_a_search_finds() {
    let robot = arm();
    let solver = solver(&robot);
    let analytic = AnalyticArm::recognise(&robot).unwrap();
    let poses = std::env::var("PLATEWASH_POSES").map_or(2000, |count| count.parse().unwrap());
    let mut rng = Pcg64::seed_from_u64(71);
    let (mut regular, mut singular, mut same_number, mut branches) = (0, 0, 0, 0);
    for _ in 0..poses {
        let q = JointVector::from_fn(|_, _| PI * (2.0 * rng.random::<f64>() - 1.0));
        let fk = robot.fk(&q);
        let target = fk.pose(solver.frame());
        let body = AnalyticArm::body_target(solver.frame(), &fk.rigid(solver.frame())).unwrap();
        let closed: Vec<_> = analytic
            .branches(&body, &q)
            .unwrap()
            .iter()
            .flatten()
            .map(|branch| branch.q)
            .collect();
        for answer in &closed {
            let there = robot.fk(answer).pose(solver.frame());
            assert!(
                (there.translation.vector - target.translation.vector).norm() < 1e-9,
                "{q}"
            );
            assert!(there.rotation.angle_to(&target.rotation) < 1e-9, "{q}");
        }
        assert!(
            closed.iter().any(|answer| apart(answer, &q) < 1e-5),
            "{q} is not among {closed:?}"
        );
        let smallest = |q: &JointVector| robot.fk(q).jacobian(solver.frame(), Axes::Base).singular_values().min();
        if closed.iter().any(|q| smallest(q) < 0.01) {
            singular += 1;
            continue;
        }
        regular += 1;
        let found = solver.spread(&target, &q, LISTED).unwrap();
        for answer in &found {
            let near = |other: &JointVector| apart(answer, other) < 1e-6;
            assert!(closed.iter().any(near), "{answer} is not among {closed:?}");
        }
        same_number += usize::from(found.len() == closed.len());
        branches += closed.len();
    }
    println!(
        "{regular} regular poses with {branches} branches: {same_number} times all found; {singular} poses near singularities"
    );
    assert!(same_number * 100 >= regular * 99, "{same_number} of {regular}");
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
