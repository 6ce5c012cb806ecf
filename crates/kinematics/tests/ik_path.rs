//! Paths: solved everywhere, no jumps, and an error that says where and why when there is none.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::ik::{IkPathError, IkSettings, IkSolver, PathBreak};
use platewash_kinematics::rotation::from_rpy;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel, ToolFrame};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

fn down(p: Vector3<f64>) -> Pose {
    Pose::from_parts(p.into(), UnitQuaternion::from_matrix(&from_rpy([0.0, PI, 0.0])))
}

fn spiral(centre: [f64; 2], count: usize) -> Vec<Pose> {
    let at = |k: usize| {
        let share = k as f64 / (count - 1) as f64;
        let (r, a) = (0.145 * share, 3.0 * TAU * share);
        down(Vector3::new(centre[0] + r * a.cos(), centre[1] + r * a.sin(), 0.08))
    };
    (0..count).map(at).collect()
}

fn irb120() -> RobotModel {
    RobotModel::irb120().unwrap()
}

fn solver(robot: &RobotModel) -> IkSolver<'_> {
    IkSolver::new(
        robot,
        robot.tool_frame(ToolFrame::Tool0).unwrap(),
        IkSettings::default(),
    )
    .unwrap()
}

#[track_caller]
fn check(robot: &RobotModel, targets: &[Pose], q: &[JointVector], largest: f64) {
    assert_eq!(q.len(), targets.len());
    let tool0 = robot.tool_frame(ToolFrame::Tool0).unwrap();
    for (k, (q, target)) in q.iter().zip(targets).enumerate() {
        assert!(robot.limits().contain(q), "waypoint {k}");
        let found = robot.pose(q, &tool0);
        assert!(
            (found.translation.vector - target.translation.vector).norm() <= 1.001e-6,
            "waypoint {k}"
        );
        assert!(found.rotation.angle_to(&target.rotation) <= 1.1e-6, "waypoint {k}");
    }
    for (k, pair) in q.windows(2).enumerate() {
        let moved = (pair[1] - pair[0]).amax();
        assert!(moved <= largest, "{moved} rad after waypoint {k}");
    }
}

/// The first spiral crosses the wrist singularity twice, the second stays away from it.
#[test]
fn dense_spirals_through_and_away_from_the_wrist_singularity_do_not_jump() {
    let robot = irb120();
    for centre in [[0.25, -0.25], [0.36, 0.10]] {
        let targets = spiral(centre, 1000);
        let path = solver(&robot)
            .solve_path(&targets, &JointVector::new(0.0, 0.2, 0.2, 0.0, 1.0, 0.0))
            .unwrap();
        check(&robot, &targets, &path.q, 0.02);
        assert!(
            path.iterations <= 1400,
            "the prediction pays: {} systems for 1000 waypoints",
            path.iterations
        );
    }
    let crossing = spiral([0.25, -0.25], 1000);
    let path = solver(&robot)
        .solve_path(&crossing, &JointVector::new(0.0, 0.2, 0.2, 0.0, 1.0, 0.0))
        .unwrap();
    let signs: Vec<bool> = path.q.iter().map(|q| q[4] > 0.0).collect();
    assert!(
        signs.windows(2).any(|w| w[0] != w[1]),
        "joint 5 must cross zero for this to be a test"
    );
}

/// A sparse path is followed between its waypoints.
#[test]
fn long_ways_between_waypoints_are_followed() {
    let robot = irb120();
    let targets: Vec<Pose> = [[0.35, -0.3], [0.35, 0.0], [0.35, 0.3], [0.0, 0.45]]
        .map(|[x, y]| down(Vector3::new(x, y, 0.15)))
        .to_vec();
    let path = solver(&robot)
        .solve_path(&targets, &JointVector::new(-0.6, 0.3, 0.2, 0.0, 1.0, 0.0))
        .unwrap();
    check(&robot, &targets, &path.q, 1.2);
}

#[test]
fn a_path_out_of_reach_fails_at_its_first_unreachable_waypoint() {
    let robot = irb120();
    let targets: Vec<Pose> = (0..60)
        .map(|k| down(Vector3::new(0.3 + 0.01 * f64::from(k), 0.0, 0.1)))
        .collect();
    let seed = JointVector::new(0.0, 0.2, 0.2, 0.0, 1.0, 0.0);
    let Err(IkPathError::Broken {
        waypoint,
        reason,
        solved,
    }) = solver(&robot).solve_path(&targets, &seed)
    else {
        panic!("0.89 m is out of reach");
    };
    assert!(
        matches!(reason, PathBreak::BranchEnd { .. } | PathBreak::Limit { .. }),
        "{reason:?}"
    );
    assert_eq!(solved.len(), waypoint);
    check(&robot, &targets[..waypoint], &solved, 0.2);
    // One waypoint later nothing near solves it: the wrist would have to be beyond 0.580 m from the shoulder.
    let reach = |k: usize| {
        let p = targets[k].translation.vector;
        (p + Vector3::new(0.0, 0.0, 0.072 - 0.290)).norm()
    };
    assert!(reach(waypoint - 1) <= 0.5801 && reach(waypoint) >= 0.5799, "{waypoint}");
}

#[test]
fn a_limit_is_named() {
    let text = platewash_kinematics::irb120::IRB120_URDF
        .replace("lower=\"-2.87979\" upper=\"2.87979\"", "lower=\"-0.5\" upper=\"0.5\"");
    let robot = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    assert_eq!(robot.limits().upper[0], 0.5);
    let arc = |k: i32| {
        let angle = 0.02 * f64::from(k);
        down(Vector3::new(0.38 * angle.cos(), 0.38 * angle.sin(), 0.1))
    };
    let targets: Vec<Pose> = (0..60).map(arc).collect();
    let seed = JointVector::new(0.0, 0.2, 0.2, 0.0, 1.0, 0.0);
    let Err(IkPathError::Broken { waypoint, reason, .. }) = solver(&robot).solve_path(&targets, &seed) else {
        panic!("joint 1 ends at 0.5 rad");
    };
    assert_eq!((waypoint, reason), (26, PathBreak::Limit { joint: 0 }));
}

/// Through the wrist singularity in a direction that the wrist does not have there: joint 4 would have to turn by a
/// quarter on the spot.
#[test]
fn a_jump_at_a_singularity_is_an_error_and_never_an_answer() {
    let robot = irb120();
    let tool0 = robot.tool_frame(ToolFrame::Tool0).unwrap();
    // At joint 5 = 0 the flange can turn about z of link_4 only after joint 4 has turned by 90°.
    let middle = robot.pose(&JointVector::new(0.0, 0.3, 0.2, 0.0, 0.0, 0.0), &tool0);
    let sideways = |angle: f64| {
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle);
        Pose::from_parts(middle.translation, turn * middle.rotation)
    };
    // Tilted in the plane of the arm first, then turned across it, exactly through the singular pose.
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), 0.3);
    let tilted = |share: f64| {
        Pose::from_parts(
            middle.translation,
            UnitQuaternion::identity().slerp(&tilt, share) * middle.rotation,
        )
    };
    let mut targets: Vec<Pose> = (0..=20).rev().map(|k| tilted(f64::from(k) / 20.0)).collect();
    targets.extend((1..=20).map(|k| sideways(0.015 * f64::from(k))));
    let seed = JointVector::new(0.0, 0.3, 0.2, 0.0, 0.3, 0.0);
    match solver(&robot).solve_path(&targets, &seed) {
        Err(IkPathError::Broken {
            waypoint,
            reason: PathBreak::Singularity { jump_rad },
            ..
        }) => {
            assert_eq!(waypoint, 21, "the first waypoint off the plane");
            assert!(jump_rad > 0.1);
        }
        Err(IkPathError::Broken {
            waypoint,
            reason: PathBreak::BranchEnd { .. },
            ..
        }) => assert_eq!(waypoint, 21),
        other => panic!("{other:?}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Poses along any smooth joint motion: solved back without a jump, or refused; never wrong.
    #[test]
    fn smooth_joint_motions_give_paths_that_are_solved_without_jumps(
        from in prop::array::uniform6(-1.0..1.0f64), to in prop::array::uniform6(-1.0..1.0f64),
    ) {
        let robot = irb120();
        let tool0 = robot.tool_frame(ToolFrame::Tool0).unwrap();
        let (from, to) = (JointVector::from(from), JointVector::from(to));
        let along: Vec<JointVector> = (0..=200).map(|k| from + (to - from) * (f64::from(k) / 200.0)).collect();
        let targets: Vec<Pose> = along.iter().map(|q| robot.pose(q, &tool0)).collect();
        match solver(&robot).solve_path(&targets, &along[0]) {
            Ok(path) => check(&robot, &targets, &path.q, 0.1001),
            Err(IkPathError::Broken { waypoint, solved, .. }) => {
                check(&robot, &targets[..waypoint], &solved, 0.1001);
                // A motion with joint 5 well away from zero must not break off.
                let away = along.iter().all(|q| q[4].abs() > 0.15);
                prop_assert!(!away, "broke off at {waypoint} away from the wrist singularity");
            }
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}

#[test]
fn handles_empty_paths_and_rejects_bad_waypoints() {
    let robot = irb120();
    assert!(
        solver(&robot)
            .solve_path(&[], &JointVector::zeros())
            .unwrap()
            .q
            .is_empty()
    );
    let mut bad = spiral([0.3, 0.0], 5);
    bad[3].translation.x = f64::NAN;
    let Err(IkPathError::Waypoint { waypoint: 3, .. }) = solver(&robot).solve_path(&bad, &JointVector::zeros()) else {
        panic!("NaN at waypoint 3");
    };
    assert_eq!(AXES, 6);
}
