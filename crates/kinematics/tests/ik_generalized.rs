//! Freedom in the task, against a brute-force search over tilts; bounds and clearance rows against their definitions.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::ik::{
    ClearanceRow, GeneralizedError, GeneralizedTask, IkError, IkSettings, IkSolver, TaskFreedom, Yaw,
};
use platewash_kinematics::{Axes, JointVector, Pose, RobotModel, ToolFrame};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::PI;

const CONE: f64 = 15.0 / 180.0 * PI;
const SPARE: f64 = 0.2 / 180.0 * PI;

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

fn down_at(rho: f64, azimuth: f64, z: f64) -> Pose {
    let half_turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), PI);
    Pose::from_parts(
        Vector3::new(rho * azimuth.cos(), rho * azimuth.sin(), z).into(),
        half_turn,
    )
}

/// The target leaning by `tilt` towards `azimuth` of its own xy plane.
fn leaning(target: &Pose, tilt: f64, azimuth: f64) -> Pose {
    let axis = nalgebra::Unit::new_normalize(Vector3::new(-azimuth.sin(), azimuth.cos(), 0.0));
    target * UnitQuaternion::from_axis_angle(&axis, tilt)
}

fn seed() -> JointVector {
    JointVector::new(0.0, 0.3, 0.2, 0.0, 1.0, 0.0)
}

/// Whether some tilt within the cone less the spare angle is solved with every joint that far from its limits. The grid is
/// `degrees` wide.
fn brute_force(robot: &RobotModel, solver: &IkSolver<'_>, target: &Pose, degrees: f64) -> bool {
    let step = degrees.to_radians();
    let tilts = ((CONE - SPARE) / step) as usize;
    let azimuths = (2.0 * PI / step) as usize;
    let spare = |q: &JointVector| robot.limits().margins(q).min() >= SPARE;
    (0..=tilts).rev().any(|i| {
        (0..azimuths).any(|k| {
            let pose = leaning(target, i as f64 * step, k as f64 * step);
            solver
                .solve_all(&pose, &seed())
                .unwrap()
                .configurations()
                .any(|(_, q)| spare(&q))
        })
    })
}

/// Tool-down reach at height z: the smallest and largest distance from the axis, by bisection.
fn reach(solver: &IkSolver<'_>, z: f64) -> [f64; 2] {
    let solved = |rho: f64| solver.solve(&down_at(rho, 0.0, z), &seed()).is_ok();
    let edge = |mut inside: f64, mut outside: f64| {
        assert!(solved(inside) && !solved(outside));
        for _ in 0..40 {
            let middle = 0.5 * (inside + outside);
            if solved(middle) {
                inside = middle
            } else {
                outside = middle
            }
        }
        inside
    };
    [edge(0.35, 0.0), edge(0.35, 0.8)]
}

/// Poses just outside the tool-down reach.
const CASES: usize = 80;

#[test]
fn poses_just_outside_the_tool_down_reach_are_solved_where_a_tilt_allows() {
    let robot = irb120();
    let solver = solver(&robot);
    let mut rng = Pcg64::seed_from_u64(4);
    let (mut possible, mut solved) = (0, 0);
    for case in 0..CASES {
        let z = 0.05 + 0.25 * rng.random::<f64>();
        let [inner, outer] = reach(&solver, z);
        let beyond = 0.02 * rng.random::<f64>();
        let rho = if case % 2 == 0 { outer + beyond } else { inner - beyond };
        let target = down_at(rho, 2.6 * (2.0 * rng.random::<f64>() - 1.0), z);
        assert!(solver.solve(&target, &seed()).is_err(), "outside the tool-down reach");
        let asked = GeneralizedTask {
            freedom: TaskFreedom::cone(CONE),
            motion_rad: None,
            clearance: None,
        };
        let answer = solver.solve_generalized(&target, &seed(), &asked);
        if let Ok(answer) = &answer {
            check(&robot, &target, &answer.q);
            assert!(answer.tilt_rad <= CONE);
            solved += 1;
        }
        if brute_force(&robot, &solver, &target, 1.0) {
            possible += 1;
            assert!(answer.is_ok(), "case {case}: {answer:?} at {rho} {z}");
        }
    }
    println!("{possible} possible by the grid, {solved} solved");
    assert!(4 * possible > 3 * CASES && solved >= possible);
}

/// The position is met, and the tool axis leans by no more than the cone.
fn check(robot: &RobotModel, target: &Pose, q: &JointVector) {
    assert!(robot.limits().contain(q));
    let found = robot.pose(q, &robot.tool_frame(ToolFrame::Tool0).unwrap());
    assert!((found.translation.vector - target.translation.vector).norm() <= 1.001e-6);
    let lean = (found.rotation * Vector3::z()).angle(&(target.rotation * Vector3::z()));
    assert!(lean <= CONE + 1.1e-6, "{}", lean.to_degrees());
}

#[test]
fn position_freedom_is_taken_up_per_axis_and_no_further() {
    let robot = irb120();
    let solver = solver(&robot);
    let [_, outer] = reach(&solver, 0.1);
    // 8 mm too far out along base x, which is −x of the target.
    let target = down_at(outer + 0.008, 0.0, 0.1);
    let with = |position_m| {
        let freedom = TaskFreedom {
            position_m,
            ..TaskFreedom::none()
        };
        let asked = GeneralizedTask {
            freedom,
            motion_rad: None,
            clearance: None,
        };
        solver.solve_generalized(&target, &seed(), &asked)
    };
    let answer = with([0.01, 0.0, 0.0]).unwrap();
    assert!(answer.position_m[0].abs() <= 0.01 && answer.position_m[0].abs() >= 0.0079);
    assert_eq!(
        (answer.position_m[1], answer.position_m[2], answer.tilt_rad),
        (0.0, 0.0, 0.0)
    );
    let found = robot.pose(&answer.q, &robot.tool_frame(ToolFrame::Tool0).unwrap());
    assert!(
        found.rotation.angle_to(&target.rotation) < 1.1e-6,
        "the attitude is exact"
    );
    let Err(GeneralizedError::NotSolved(failure)) = with([0.0, 0.05, 0.0]) else {
        panic!("sideways freedom does not help")
    };
    assert!(
        failure.position_error_m > 0.004 && failure.position_error_m < 0.012,
        "{failure:?}"
    );
}

#[test]
fn free_yaw_is_used_and_fixed_yaw_is_kept() {
    let robot = irb120();
    let solver = solver(&robot);
    let q = JointVector::new(0.2, 0.4, 0.1, 0.0, 1.0, 0.0);
    let tool0 = robot.tool_frame(ToolFrame::Tool0).unwrap();
    let turned = robot.pose(&q, &tool0) * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 1.0);
    let with = |yaw| {
        let freedom = TaskFreedom {
            yaw,
            ..TaskFreedom::none()
        };
        let asked = GeneralizedTask {
            freedom,
            motion_rad: None,
            clearance: None,
        };
        solver.solve_generalized(&turned, &q, &asked).unwrap()
    };
    assert!((with(Yaw::Free).q - q).amax() < 1e-5, "nothing need move");
    assert!((with(Yaw::Fixed).q[5] - q[5]).abs() > 0.9);
}

#[test]
fn the_motion_stays_within_its_bounds() {
    let robot = irb120();
    let solver = solver(&robot);
    let q = seed();
    let tool0 = robot.tool_frame(ToolFrame::Tool0).unwrap();
    let ahead = robot.pose(&(q + JointVector::repeat(0.05)), &tool0);
    let with = |bound: f64| {
        let asked = GeneralizedTask {
            freedom: TaskFreedom::none(),
            motion_rad: Some(JointVector::repeat(bound)),
            clearance: None,
        };
        solver.solve_generalized(&ahead, &q, &asked)
    };
    assert!((with(0.06).unwrap().q - q).amax() <= 0.06);
    let Err(GeneralizedError::NotSolved(failure)) = with(0.03) else {
        panic!("0.05 rad are needed")
    };
    assert!((failure.q - q).amax() <= 0.03 + 1e-12);
    assert!(matches!(with(f64::NAN), Err(GeneralizedError::Motion { joint: 0, .. })));
    assert!(matches!(with(-1.0), Err(GeneralizedError::Motion { .. })));
}

/// A wall at z = 0.2 m for the wrist centre's height: kept by leaning.
#[test]
fn clearance_rows_are_kept() {
    let robot = irb120();
    let solver = solver(&robot);
    let link_4 = robot.frame("link_4").unwrap();
    let wrist = robot.frame("link_5").unwrap();
    assert_eq!(link_4.body(), 4);
    let target = down_at(0.40, 0.3, 0.10);
    let height = |q: &JointVector| robot.fk(q).rigid(&wrist).translation.z;
    let exact = solver.solve(&target, &seed()).unwrap().q;
    let upright = height(&exact);
    // At full lean the wrist centre is 0.072 (1 − cos 15°) = 2.5 mm lower; ask that it be 1.5 mm lower.
    let ceiling = upright - 0.0015;
    let rows = |q: &JointVector| {
        let jacobian = robot.fk(q).jacobian(&wrist, Axes::Base);
        let gradient = JointVector::from_fn(|j, _| -jacobian[(2, j)]);
        vec![ClearanceRow {
            distance_m: ceiling - height(q),
            gradient,
            required_m: 0.0,
        }]
    };
    let asked = GeneralizedTask {
        freedom: TaskFreedom::cone(CONE),
        motion_rad: None,
        clearance: Some(&rows),
    };
    let answer = solver.solve_generalized(&target, &exact, &asked).unwrap();
    check(&robot, &target, &answer.q);
    assert!(height(&answer.q) <= ceiling);
    let tight = GeneralizedTask {
        freedom: TaskFreedom::cone(CONE / 10.0),
        ..asked
    };
    assert!(matches!(
        solver.solve_generalized(&target, &exact, &tight),
        Err(GeneralizedError::NotSolved(_))
    ));
}

#[test]
fn input_that_makes_no_sense_is_refused() {
    let robot = irb120();
    let solver = solver(&robot);
    let asked = GeneralizedTask {
        freedom: TaskFreedom::cone(-0.1),
        motion_rad: None,
        clearance: None,
    };
    let target = down_at(0.35, 0.0, 0.1);
    assert!(matches!(
        solver.solve_generalized(&target, &seed(), &asked),
        Err(GeneralizedError::Freedom(_))
    ));
    let fine = GeneralizedTask {
        freedom: TaskFreedom::cone(0.1),
        ..asked
    };
    let nan = JointVector::repeat(f64::NAN);
    assert!(matches!(
        solver.solve_generalized(&target, &nan, &fine),
        Err(GeneralizedError::Ik(IkError::Seed { .. }))
    ));
}

#[test]
fn freedoms_out_of_range_are_refused() {
    for (freedom, name) in [
        (
            TaskFreedom {
                position_m: [0.0, -1.0, 0.0],
                ..TaskFreedom::none()
            },
            "position_m",
        ),
        (TaskFreedom::cone(f64::NAN), "tilt_rad"),
        (TaskFreedom::cone(3.2), "tilt_rad"),
    ] {
        assert_eq!(freedom.validate().map_err(|e| e.name), Err(name));
    }
    assert_eq!(TaskFreedom::cone(0.3).validate(), Ok(()));
}
