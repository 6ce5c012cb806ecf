//! Inverse kinematics: complete on reachable poses, honest on the others, never outside the limits.

use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::ik::{AnalyticStarts, IkCause, IkError, IkSettings, IkSolver, Method, RandomRestarts, Start};
use platewash_kinematics::rotation::from_rpy;
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::PI;

fn random_q(robot: &RobotModel, rng: &mut Pcg64) -> JointVector {
    JointVector::from_fn(|i, _| {
        let [low, high] = robot.limits().sampling_range(i);
        low + (high - low) * rng.random::<f64>()
    })
}

/// Position \[m\] and orientation \[rad\] error, written without the library's own error function.
fn errors(robot: &RobotModel, q: &JointVector, target: &Pose) -> (f64, f64) {
    let found = robot.pose(q, &robot.frame("tool0").unwrap());
    let p = (found.translation.vector - target.translation.vector).norm();
    let chord: Matrix3<f64> =
        found.rotation.to_rotation_matrix().matrix() - target.rotation.to_rotation_matrix().matrix();
    // ‖R − R'‖_F = 2√2 sin(θ/2)
    (p, 2.0 * (chord.norm() / 8.0_f64.sqrt()).min(1.0).asin())
}

/// 10⁵ random targets, half of them poses of the arm, half anywhere within 1 m: whatever comes back is
/// within the limits, `Ok` is within tolerance, and a pose of the arm is nearly always solved.
#[test]
fn a_hundred_thousand_random_targets_never_get_a_wrong_answer() {
    let [reachable, solved, stray] = over_random_targets(IkSettings::default(), 100_000);
    println!("reachable {reachable}, solved {solved}, random targets solved {stray}");
    assert_eq!(
        solved, reachable,
        "with analytic starts every pose of the arm is solved"
    );
    assert!(stray > 0, "some random targets are within reach");
}

/// The numeric cascade alone, as on arms without a closed form.
#[test]
fn without_analytic_starts_nearly_every_pose_is_solved_and_no_answer_is_wrong() {
    let settings = IkSettings {
        analytic_starts: AnalyticStarts::Unused,
        ..IkSettings::default()
    };
    let [reachable, solved, _] = over_random_targets(settings, 20_000);
    println!("reachable {reachable}, solved {solved}");
    assert!(solved as f64 >= 0.999 * reachable as f64, "{solved} of {reachable}");
}

/// Poses of the arm, how many of them are solved, and how many random targets are.
fn over_random_targets(settings: IkSettings, count: usize) -> [usize; 3] {
    let robot = RobotModel::irb120().unwrap();
    let solver = IkSolver::new(&robot, robot.frame("tool0").unwrap(), settings).unwrap();
    let workers = 2;
    let counts: Vec<[usize; 3]> = std::thread::scope(|scope| {
        let run = |worker: u64| {
            let (robot, solver) = (&robot, &solver);
            move || count_answers(robot, solver, worker, count / workers as usize)
        };
        let handles: Vec<_> = (0..workers).map(|w| scope.spawn(run(w))).collect();
        handles.into_iter().map(|h| h.join().unwrap()).collect()
    });
    std::array::from_fn(|k| counts.iter().map(|c| c[k]).sum())
}

fn count_answers(robot: &RobotModel, solver: &IkSolver<'_>, worker: u64, count: usize) -> [usize; 3] {
    let tool0 = robot.frame("tool0").unwrap();
    let mut rng = Pcg64::seed_from_u64(7 + worker);
    let mut counts = [0; 3];
    for case in 0..count {
        let posed = case % 2 == 0;
        let target = if posed {
            robot.pose(&random_q(robot, &mut rng), &tool0)
        } else {
            let mut coordinate = |half: f64| (2.0 * rng.random::<f64>() - 1.0) * half;
            let p = Vector3::new(coordinate(1.0), coordinate(1.0), coordinate(1.0));
            Pose::new(p, Vector3::new(coordinate(PI), coordinate(PI), coordinate(PI)))
        };
        let seed = random_q(robot, &mut rng);
        counts[0] += usize::from(posed);
        match solver.solve(&target, &seed) {
            Ok(answer) => {
                assert!(robot.limits().contain(&answer.q), "outside the limits: {:?}", answer.q);
                let (p, r) = errors(robot, &answer.q, &target);
                assert!(p <= 1.01e-6 && r <= 1.1e-6, "wrong answer: {p:e} m {r:e} rad");
                counts[if posed { 1 } else { 2 }] += 1;
            }
            Err(IkError::NotSolved(failure)) => {
                assert!(robot.limits().contain(&failure.q));
                let (p, r) = errors(robot, &failure.q, &target);
                assert!(
                    (p - failure.position_error_m).abs() < 1e-9,
                    "reported error is not that of q"
                );
                assert!((r - failure.orientation_error_rad).abs() < 1e-6);
            }
            Err(other) => panic!("{other}"),
        }
    }
    counts
}

/// The same on arms of every shape: oblique axes, offsets, asymmetric limits.
#[test]
fn generated_arms_are_solved_too() {
    let mut rng = Pcg64::seed_from_u64(11);
    for k in 1..=8 {
        let path = format!("{}/tests/fixtures/arm_{k}.urdf", env!("CARGO_MANIFEST_DIR"));
        let robot = RobotModel::from_urdf(&std::fs::read_to_string(path).unwrap(), &MeshSource::none()).unwrap();
        let frame = robot.last_link_frame();
        let solver = IkSolver::new(&robot, frame, IkSettings::default()).unwrap();
        let mut solved = 0;
        for _ in 0..200 {
            let (q, seed) = (random_q(&robot, &mut rng), random_q(&robot, &mut rng));
            if let Ok(answer) = solver.solve(&robot.pose(&q, &frame), &seed) {
                assert!(robot.limits().contain(&answer.q));
                solved += 1;
            }
        }
        assert!(solved >= 198, "arm_{k}: {solved} of 200");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Poses with a joint exactly at a limit are solved and stay inside.
    #[test]
    fn poses_at_a_limit_are_solved(joint in 0..AXES, upper in any::<bool>(), seed in 0..u64::MAX) {
        let robot = RobotModel::irb120().unwrap();
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut q = random_q(&robot, &mut rng);
        q[joint] = if upper { robot.limits().upper[joint] } else { robot.limits().lower[joint] };
        let tool0 = robot.frame("tool0").unwrap();
        let solver = IkSolver::new(&robot, tool0, IkSettings::default()).unwrap();
        let near = robot.limits().clamp(&(q + JointVector::from_fn(|_, _| 0.2 * (rng.random::<f64>() - 0.5))));
        let target = robot.pose(&q, &tool0);
        let answer = solver.solve(&target, &near).unwrap();
        prop_assert!(robot.limits().contain(&answer.q));
        let (p, r) = errors(&robot, &answer.q, &target);
        prop_assert!(p <= 1.01e-6 && r <= 1.1e-6);
    }

    /// The same arguments give the same bits.
    #[test]
    fn answers_depend_on_the_arguments_alone(seed in 0..u64::MAX) {
        let robot = RobotModel::irb120().unwrap();
        let mut rng = Pcg64::seed_from_u64(seed);
        let tool0 = robot.frame("tool0").unwrap();
        let target = robot.pose(&random_q(&robot, &mut rng), &tool0);
        let from = random_q(&robot, &mut rng);
        let solve = || IkSolver::new(&robot, tool0, IkSettings::default()).unwrap().solve(&target, &from);
        prop_assert_eq!(solve(), solve());
    }
}

/// A target that only the QP reaches from the seed: the DLS step runs into a limit on the way.
#[test]
fn the_qp_takes_over_at_an_active_limit() {
    let robot = RobotModel::irb120().unwrap();
    let tool0 = robot.frame("tool0").unwrap();
    let settings = IkSettings {
        listed_starts: 0,
        analytic_starts: AnalyticStarts::Unused,
        ..IkSettings::default()
    };
    let solver = IkSolver::new(&robot, tool0, settings).unwrap();
    let mut rng = Pcg64::seed_from_u64(3);
    let mut by_qp = 0;
    for _ in 0..400 {
        let mut q = random_q(&robot, &mut rng);
        q[4] = robot.limits().upper[4];
        let seed = robot.limits().clamp(&q.map(|v| v + 0.8 * (rng.random::<f64>() - 0.5)));
        if let Ok(answer) = solver.solve(&robot.pose(&q, &tool0), &seed) {
            assert_eq!(answer.start, Start::Seed);
            by_qp += usize::from(answer.method == Method::Qp);
        }
    }
    assert!(by_qp >= 5, "the fallback answered only {by_qp} times");
}

#[test]
fn failures_state_their_cause() {
    let robot = RobotModel::irb120().unwrap();
    let tool0 = robot.frame("tool0").unwrap();
    let solver = IkSolver::new(&robot, tool0, IkSettings::default()).unwrap();
    let far = Pose::new(Vector3::new(2.0, 0.0, 0.3), Vector3::zeros());
    let Err(IkError::NotSolved(failure)) = solver.solve(&far, &JointVector::zeros()) else {
        panic!("2 m away")
    };
    assert_eq!(failure.cause, IkCause::Unreachable);
    assert!(failure.position_error_m > 1.2, "{failure:?}");

    // 20 mm beyond the stretched arm, wrist in line: the branches prove it; the numeric cascade finds no way nearer.
    let q = JointVector::new(0.0, 1.3, -1.3, 0.0, 0.0, 0.0);
    let stretched = robot.pose(&q, &tool0);
    let beyond = stretched.translation.vector + Vector3::new(0.05, 0.0, 0.0);
    let beyond = Pose::from_parts(beyond.into(), stretched.rotation);
    let numeric = IkSettings {
        analytic_starts: AnalyticStarts::Unused,
        ..IkSettings::default()
    };
    for (settings, expected) in [
        (IkSettings::default(), IkCause::Unreachable),
        (numeric, IkCause::LocalMinimum),
    ] {
        let solver = IkSolver::new(&robot, tool0, settings).unwrap();
        let Err(IkError::NotSolved(failure)) = solver.solve(&beyond, &q) else {
            panic!("beyond reach")
        };
        assert_eq!(failure.cause, expected, "{failure:?}");
        assert!(failure.position_error_m > 0.02 && failure.position_error_m < 0.06);
    }

    // One iteration is not enough for anything: the cause says so.
    let hasty = IkSettings {
        max_iterations: 1,
        max_qp_iterations: 0,
        listed_starts: 0,
        analytic_starts: AnalyticStarts::Unused,
        ..IkSettings::default()
    };
    let hasty = IkSolver::new(&robot, tool0, hasty).unwrap();
    let near = robot.pose(&JointVector::new(0.3, 0.4, 0.1, 0.5, 0.9, 0.2), &tool0);
    let Err(IkError::NotSolved(failure)) = hasty.solve(&near, &JointVector::new(0.0, 0.2, 0.2, 0.0, 1.0, 0.0)) else {
        panic!("one iteration")
    };
    assert_eq!(failure.cause, IkCause::Iterations);

    // Behind the base, wrist straight: joint 1 would have to turn beyond ±165°.
    let narrow = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../urdf/irb120.urdf")).unwrap();
    let narrow = narrow.replace("lower=\"-2.87979\" upper=\"2.87979\"", "lower=\"-0.5\" upper=\"0.5\"");
    let narrow = RobotModel::from_urdf(&narrow, &MeshSource::none()).unwrap();
    assert_eq!(narrow.limits().upper[0], 0.5, "the limit was edited");
    let solver = IkSolver::new(&narrow, narrow.frame("tool0").unwrap(), IkSettings::default()).unwrap();
    let left = Pose::new(Vector3::new(0.0, 0.45, 0.3), Vector3::new(0.0, PI, 0.0));
    let Err(IkError::NotSolved(failure)) = solver.solve(&left, &JointVector::zeros()) else {
        panic!("beyond joint 1")
    };
    assert_eq!(failure.cause, IkCause::Limit { joint: 0 });
    // The analytic branches say by how much: the pose lies at an azimuth of 90°.
    let excess = failure.limit_excess_rad.unwrap();
    assert!((excess - (PI / 2.0 - 0.5)).abs() < 1e-9, "{excess}");
}

#[test]
fn input_that_is_not_finite_is_refused() {
    let robot = RobotModel::irb120().unwrap();
    let tool0 = robot.frame("tool0").unwrap();
    let solver = IkSolver::new(&robot, tool0, IkSettings::default()).unwrap();
    let mut target = robot.pose(&JointVector::zeros(), &tool0);
    let mut seed = JointVector::zeros();
    seed[3] = f64::NAN;
    assert!(matches!(
        solver.solve(&target, &seed),
        Err(IkError::Seed { joint: 3, .. })
    ));
    target.translation.x = f64::INFINITY;
    assert!(matches!(
        solver.solve(&target, &JointVector::zeros()),
        Err(IkError::Target { .. })
    ));
    for broken in [
        IkSettings {
            position_tolerance_m: f64::NAN,
            ..IkSettings::default()
        },
        IkSettings {
            step_bound_rad: 0.0,
            ..IkSettings::default()
        },
        IkSettings {
            listed_starts: 257,
            ..IkSettings::default()
        },
    ] {
        assert!(IkSolver::new(&robot, tool0, broken).is_err(), "{broken:?}");
    }
}

/// Random restarts happen only with a seed, and the seed decides them.
#[test]
fn random_restarts_need_a_seed() {
    let robot = RobotModel::irb120().unwrap();
    let tool0 = robot.frame("tool0").unwrap();
    let with = |random_restarts| {
        let settings = IkSettings {
            listed_starts: 0,
            analytic_starts: AnalyticStarts::Unused,
            random_restarts,
            ..IkSettings::default()
        };
        IkSolver::new(&robot, tool0, settings).unwrap()
    };
    let mut rng = Pcg64::seed_from_u64(5);
    let mut rescued = 0;
    for _ in 0..200 {
        let (q, seed) = (random_q(&robot, &mut rng), random_q(&robot, &mut rng));
        let target = robot.pose(&q, &tool0);
        if with(None).solve(&target, &seed).is_ok() {
            continue;
        }
        let restarts = Some(RandomRestarts { seed: 9, count: 50 });
        let answer = with(restarts).solve(&target, &seed);
        assert_eq!(with(restarts).solve(&target, &seed), answer, "the seed decides");
        if let Ok(answer) = answer {
            assert!(matches!(answer.start, Start::Random(_)));
            rescued += 1;
        }
    }
    assert!(rescued > 5, "{rescued}");
}

/// A rotation of exactly π from the seed's pose is no trap: joint 6 can make it.
#[test]
fn half_turns_are_solved() {
    let robot = RobotModel::irb120().unwrap();
    let tool0 = robot.frame("tool0").unwrap();
    let solver = IkSolver::new(&robot, tool0, IkSettings::default()).unwrap();
    let down = Pose::from_parts(
        Vector3::new(0.35, 0.0, 0.2).into(),
        nalgebra::UnitQuaternion::from_matrix(&from_rpy([0.0, PI, 0.0])),
    );
    let q = solver.solve(&down, &JointVector::zeros()).unwrap().q;
    let turned = down * nalgebra::UnitQuaternion::from_scaled_axis(Vector3::z() * PI);
    let answer = solver.solve(&turned, &q).unwrap();
    assert!(errors(&robot, &answer.q, &turned).1 < 1.1e-6);
    // Turned over, the flange would have to come from below the floor: not one of the arm's poses there.
    let over = down * nalgebra::UnitQuaternion::from_scaled_axis(Vector3::x() * PI);
    assert!(matches!(solver.solve(&over, &q), Err(IkError::NotSolved(_))));
}

/// Damped steps alone solve what is warm, to tolerance.
#[test]
fn descents_solve_warm_targets() {
    let robot = RobotModel::irb120().unwrap();
    let tool0 = robot.frame("tool0").unwrap();
    let mut rng = Pcg64::seed_from_u64(21);
    let settings = IkSettings {
        analytic_starts: AnalyticStarts::Unused,
        listed_starts: 0,
        ..IkSettings::default()
    };
    let solver = IkSolver::new(&robot, tool0, settings).unwrap();
    let mut solved = 0;
    for _ in 0..300 {
        let q = random_q(&robot, &mut rng) * 0.8;
        let seed = robot.limits().clamp(&q.map(|v| v + 0.05 * (rng.random::<f64>() - 0.5)));
        let target = robot.pose(&q, &tool0);
        if let Ok(answer) = solver.solve(&target, &seed) {
            assert!(errors(&robot, &answer.q, &target).0 <= 1.01e-6);
            solved += 1;
        }
    }
    assert!(solved >= 297, "{solved} of 300");
}
