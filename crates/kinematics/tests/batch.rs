//! Batches: the same answers as one at a time, on every path, for every length and number of threads.

use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::batch::{self, Backend, BatchError};
use platewash_kinematics::ik::{IkError, IkSettings, IkSolver, Start};
use platewash_kinematics::rotation::{RigidTransform, from_rpy, rotation_vector};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, Axes, Frame, Jacobian, JointVector, Pose, RobotModel};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::{FRAC_PI_2, PI};

const PATHS: [Backend; 2] = [Backend::Detected, Backend::Portable];
const AGREED: f64 = 1e-12;

fn irb120() -> RobotModel {
    RobotModel::irb120().unwrap()
}

/// An arm from (x y z, roll pitch yaw, axis) per joint, limits ±2.9 rad but joint 6 asymmetric.
fn arm(joints: &[([f64; 3], [f64; 3], [f64; 3]); AXES]) -> RobotModel {
    let mut text = String::from("<robot name=\"generated\"><link name=\"l0\"/>");
    for (i, (xyz, rpy, axis)) in joints.iter().enumerate() {
        let show = |v: &[f64; 3]| format!("{} {} {}", v[0], v[1], v[2]);
        let lower = if i == 5 { -1.5 } else { -2.9 };
        text += &format!(
            "<link name=\"l{n}\"/><joint name=\"j{n}\" type=\"revolute\"><parent link=\"l{i}\"/><child link=\"l{n}\"/>\
             <origin xyz=\"{}\" rpy=\"{}\"/><axis xyz=\"{}\"/><limit lower=\"{lower}\" upper=\"2.9\" velocity=\"3\" effort=\"9\"/></joint>",
            show(xyz),
            show(rpy),
            show(axis),
            n = i + 1,
        );
    }
    RobotModel::from_urdf(&(text + "</robot>"), &MeshSource::none()).unwrap()
}

fn random_arm(rng: &mut Pcg64) -> RobotModel {
    let mut triple = |half: f64| [0; 3].map(|_| half * (2.0 * rng.random::<f64>() - 1.0));
    arm(&[0; AXES].map(|_| (triple(0.4), triple(PI), triple(1.0))))
}

/// Arms whose axes are parallel, antiparallel, perpendicular, or nearly so.
fn special_arms() -> Vec<RobotModel> {
    let mut arms = Vec::new();
    for roll in [
        0.0,
        PI,
        FRAC_PI_2,
        -FRAC_PI_2,
        1e-9,
        FRAC_PI_2 + 1e-9,
        3e-16,
        PI - 1e-12,
    ] {
        for xyz in [[0.3, 0.0, 0.1], [0.0; 3], [0.0, 0.0, 0.4], [0.1, -0.2, 0.3]] {
            arms.push(arm(&[(xyz, [roll, 0.0, 0.7], [0.0, 0.0, 1.0]); AXES]));
            arms.push(arm(&[(xyz, [roll, 0.2, 0.0], [0.0, -1.0, 0.0]); AXES]));
        }
    }
    arms
}

fn arms() -> Vec<RobotModel> {
    let mut rng = Pcg64::seed_from_u64(3);
    let random = (0..20).map(|_| random_arm(&mut rng));
    [irb120()].into_iter().chain(random).chain(special_arms()).collect()
}

fn frames(robot: &RobotModel) -> Vec<Frame> {
    let offset = RigidTransform {
        rotation: from_rpy([0.3, -0.8, 2.0]),
        translation: Vector3::new(0.05, -0.02, 0.11),
    };
    let links = robot.links().iter().map(|link| link.frame);
    links
        .chain([Frame::base().offset(&offset), robot.last_link_frame().offset(&offset)])
        .collect()
}

fn random_q(robot: &RobotModel, rng: &mut Pcg64) -> JointVector {
    JointVector::from_fn(|i, _| {
        let [low, high] = robot.limits().sampling_range(i);
        low + (high - low) * rng.random::<f64>()
    })
}

fn configurations(robot: &RobotModel, count: usize, seed: u64) -> Vec<JointVector> {
    let mut rng = Pcg64::seed_from_u64(seed);
    (0..count).map(|_| random_q(robot, &mut rng)).collect()
}

type Slices = (Vec<[f64; 3]>, Vec<[f64; 9]>);

fn fk_slices(robot: &RobotModel, frame: &Frame, q: &[JointVector], path: Backend) -> Slices {
    let (mut p, mut r) = (vec![[f64::NAN; 3]; q.len()], vec![[f64::NAN; 9]; q.len()]);
    batch::fk_into(robot, frame, q, &mut p, &mut r, path).unwrap();
    (p, r)
}

fn pose_difference(scalar: &RigidTransform, p: &[f64; 3], r: &[f64; 9]) -> f64 {
    let position = (scalar.translation - Vector3::from(*p)).amax();
    position.max((scalar.rotation - Matrix3::from_row_slice(r)).amax())
}

#[test]
fn poses_and_jacobians_are_those_of_one_at_a_time() {
    for robot in arms() {
        let q = configurations(&robot, 37, 5);
        for (frame, path) in frames(&robot).iter().flat_map(|f| PATHS.map(|p| (f, p))) {
            let (p, r) = fk_slices(&robot, frame, &q, path);
            let mut matrices = vec![[f64::NAN; 16]; q.len()];
            batch::fk_matrices_into(&robot, frame, &q, &mut matrices, path).unwrap();
            let poses = batch::fk(&robot, frame, &q, path);
            for k in 0..q.len() {
                let [a, b, c] = [0, 4, 8].map(|row| &matrices[k][row..row + 3]);
                assert_eq!([a, b, c].concat(), r[k], "the same bits");
                assert_eq!([3, 7, 11].map(|i| matrices[k][i]), p[k]);
                assert_eq!(matrices[k][12..], [0.0, 0.0, 0.0, 1.0]);
                let scalar = robot.fk(&q[k]).rigid(frame);
                let off = pose_difference(&scalar, &p[k], &r[k]);
                assert!(off < AGREED, "{path:?} {off:e} at {:?}", q[k]);
                let off = (poses[k].inverse() * Pose::from(&scalar)).rotation.angle();
                assert!(
                    off < AGREED && poses[k].translation.vector == Vector3::from(p[k]),
                    "{off:e}"
                );
            }
            for axes in [Axes::Base, Axes::Local] {
                let jacobians = batch::jacobian(&robot, frame, &q, axes, path);
                for (q, found) in q.iter().zip(&jacobians) {
                    let off = (robot.fk(q).jacobian(frame, axes) - found).amax();
                    assert!(off < AGREED, "{path:?} {axes:?} {off:e} at {q:?}");
                }
            }
        }
    }
}

/// On a machine with AVX2 this compares two sets of instructions, elsewhere one with itself.
#[test]
fn scalar_and_vector_code_agree_far_beyond_the_limits() {
    println!("AVX2 and FMA: {}", Backend::Detected.is_vectorised());
    let robot = irb120();
    let frame = robot.frame("tool0").unwrap();
    let near = configurations(&robot, 20_000, 8);
    let far = near
        .iter()
        .map(|q| q * 1e3)
        .chain(near.iter().take(100).map(|q| q * 1e5));
    let q: Vec<_> = near.iter().copied().chain(far).collect();
    let (a, b) = (
        fk_slices(&robot, &frame, &q, PATHS[0]),
        fk_slices(&robot, &frame, &q, PATHS[1]),
    );
    let [i, j] = PATHS.map(|path| batch::jacobian(&robot, &frame, &q, Axes::Base, path));
    for k in 0..q.len() {
        let rounding = f64::EPSILON * q[k].amax();
        let rigid = RigidTransform {
            rotation: Matrix3::from_row_slice(&a.1[k]),
            translation: Vector3::from(a.0[k]),
        };
        assert!(
            pose_difference(&rigid, &b.0[k], &b.1[k]) < AGREED.max(9.0 * rounding),
            "{:?}",
            q[k]
        );
        assert!((i[k] - j[k]).amax() < AGREED.max(9.0 * rounding), "{:?}", q[k]);
    }
}

#[test]
fn an_answer_does_not_depend_on_its_index_or_neighbours() {
    let robot = irb120();
    let frame = robot.frame("tool0").unwrap();
    let q = configurations(&robot, 1100, 9);
    for path in PATHS {
        let (p, r) = fk_slices(&robot, &frame, &q, path);
        let j = batch::jacobian(&robot, &frame, &q, Axes::Base, path);
        for (from, to) in [
            (0, 0),
            (3, 4),
            (1, 8),
            (0, 9),
            (5, 21),
            (500, 530),
            (1093, 1100),
            (1, 1100),
        ] {
            let part = fk_slices(&robot, &frame, &q[from..to], path);
            assert_eq!(part, (p[from..to].to_vec(), r[from..to].to_vec()), "{from}..{to}");
            assert_eq!(
                batch::jacobian(&robot, &frame, &q[from..to], Axes::Base, path),
                j[from..to]
            );
        }
    }
}

#[test]
fn non_finite_values_spoil_only_their_own_configuration() {
    let robot = irb120();
    let frame = robot.frame("tool0").unwrap();
    let good = configurations(&robot, 24, 10);
    for (path, joint, value) in PATHS
        .iter()
        .flat_map(|p| (0..AXES).flat_map(|j| [f64::NAN, f64::INFINITY].map(|v| (*p, j, v))))
    {
        let mut bad = good.clone();
        bad[10][joint] = value;
        let (before, after) = (
            fk_slices(&robot, &frame, &good, path),
            fk_slices(&robot, &frame, &bad, path),
        );
        let [i, j] = [&good, &bad].map(|q| batch::jacobian(&robot, &frame, q, Axes::Base, path));
        for k in (0..24).filter(|k| *k != 10) {
            assert_eq!((before.0[k], before.1[k], i[k]), (after.0[k], after.1[k], j[k]));
        }
        assert!(
            after.0[10].iter().chain(&after.1[10]).all(|v| v.is_nan()),
            "{:?}",
            after.1[10]
        );
        // A joint beyond the frame does not matter.
        let inner = robot
            .links()
            .iter()
            .map(|l| l.frame)
            .find(|f| f.body() == joint)
            .unwrap();
        assert_eq!(
            fk_slices(&robot, &inner, &good, path),
            fk_slices(&robot, &inner, &bad, path)
        );
    }
}

#[test]
fn rejects_slices_of_different_lengths() {
    let robot = irb120();
    let frame = robot.frame("tool0").unwrap();
    let q = configurations(&robot, 9, 11);
    let solver = IkSolver::new(&robot, frame, IkSettings::default()).unwrap();
    let wrong = |name, found| BatchError::Length {
        name,
        expected: 9,
        found,
    };
    for path in PATHS {
        let (mut p, mut r, mut j) = ([[0.0; 3]; 9], [[0.0; 9]; 10], [Jacobian::zeros(); 8]);
        assert_eq!(
            batch::fk_into(&robot, &frame, &q, &mut p[..8], &mut r[..9], path),
            Err(wrong("positions", 8))
        );
        assert_eq!(
            batch::fk_into(&robot, &frame, &q, &mut p, &mut r, path),
            Err(wrong("rotations", 10))
        );
        assert_eq!(p, [[0.0; 3]; 9], "nothing is written");
        assert_eq!(
            batch::fk_matrices_into(&robot, &frame, &q, &mut [[0.0; 16]; 8], path),
            Err(wrong("matrices", 8))
        );
        assert_eq!(
            batch::jacobian_into(&robot, &frame, &q, Axes::Base, &mut j, path),
            Err(wrong("jacobians", 8))
        );
        let targets = vec![Pose::identity(); 9];
        assert_eq!(batch::solve(&solver, &targets, &q[..3], path), Err(wrong("seeds", 3)));
        assert_eq!(batch::fk(&robot, &frame, &[], path), []);
        assert!(batch::jacobian(&robot, &frame, &[], Axes::Base, path).is_empty());
        assert_eq!(batch::solve(&solver, &[], &[], path), Ok(vec![]));
    }
    assert_eq!(wrong("seeds", 3).to_string(), "seeds: 9 entries are needed; found 3");
}

/// Targets with seeds at most `off` \[rad\] away in each joint, both within the limits.
fn warm(robot: &RobotModel, frame: &Frame, count: usize, off: f64) -> (Vec<Pose>, Vec<JointVector>) {
    let mut rng = Pcg64::seed_from_u64(12);
    let seeds = configurations(robot, count, 13);
    let moved = |q: &JointVector| {
        robot
            .limits()
            .clamp(&q.map(|v| v + off * (2.0 * rng.random::<f64>() - 1.0)))
    };
    (seeds.iter().map(moved).map(|q| robot.pose(&q, frame)).collect(), seeds)
}

/// Largest of position \[m\] and angle \[rad\] from the target, by the scalar FK.
fn miss(robot: &RobotModel, frame: &Frame, q: &JointVector, target: &Pose) -> f64 {
    let (found, target) = (robot.fk(q).rigid(frame), RigidTransform::from(target));
    let angle = rotation_vector(&(target.rotation * found.rotation.transpose())).norm();
    (found.translation - target.translation).norm().max(angle)
}

#[test]
fn warm_problems_are_all_solved_on_the_scalar_solvers_branch() {
    let robot = irb120();
    let frame = robot.frame("tool0").unwrap();
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let settings = IkSettings {
            position_tolerance_m: tolerance,
            orientation_tolerance_rad: tolerance,
            ..IkSettings::default()
        };
        let solver = IkSolver::new(&robot, frame, settings).unwrap();
        for off in [1e-3, 0.01, 0.1] {
            let (targets, seeds) = warm(&robot, &frame, 3001, off);
            let scalar: Vec<_> = targets.iter().zip(&seeds).map(|(t, s)| solver.solve(t, s)).collect();
            for path in PATHS {
                let answers = batch::solve(&solver, &targets, &seeds, path).unwrap();
                for k in 0..targets.len() {
                    let (answer, scalar) = match (&answers[k], &scalar[k]) {
                        (Ok(answer), Ok(scalar)) => (answer, scalar),
                        (a, b) => panic!("{path:?} {a:?} {b:?}"),
                    };
                    assert!(robot.limits().contain(&answer.q));
                    let missed = miss(&robot, &frame, &answer.q, &targets[k]);
                    assert!(missed <= tolerance, "{missed:e}");
                    let stated = answer.position_error_m.max(answer.orientation_error_rad);
                    assert!((missed - stated).abs() < 1e-14, "{missed:e} {stated:e}");
                    // Near a singularity poses within tolerance are further apart in the joints.
                    assert!((answer.q - scalar.q).amax() < 0.02, "{path:?} {answer:?} {scalar:?}");
                    // At 1e-12 rounding decides whether the scalar descent arrives or stalls.
                    assert!(
                        answer.start == scalar.start || tolerance < 1e-10,
                        "{path:?} {tolerance:e} {off} {answer:?} {scalar:?}"
                    );
                }
            }
        }
    }
}

/// Warm, cold, unreachable, on a limit, and not finite, side by side: whatever the lanes don't solve is answered
/// exactly as by the scalar solver.
#[test]
fn hard_problems_among_easy_ones_are_left_to_the_scalar_solver() {
    let robot = irb120();
    let frame = robot.frame("tool0").unwrap();
    let solver = IkSolver::new(&robot, frame, IkSettings::default()).unwrap();
    let (mut targets, mut seeds) = warm(&robot, &frame, 400, 0.01);
    let cold = configurations(&robot, 400, 14);
    for k in 0..400 {
        match k % 8 {
            1 => seeds[k] = cold[k],
            2 => targets[k].translation.vector *= 3.0,
            3 => seeds[k][k % 6] = f64::NAN,
            4 => targets[k].translation.vector.y = f64::INFINITY,
            5 => seeds[k] = JointVector::from_fn(|i, _| robot.limits().upper[i] + 1.0),
            6 => seeds[k] = robot.limits().clamp(&(seeds[k] * 1e300)),
            _ => {}
        }
    }
    for path in PATHS {
        let answers = batch::solve(&solver, &targets, &seeds, path).unwrap();
        let mut fallen = 0;
        for (k, answer) in answers.iter().enumerate() {
            let scalar = solver.solve(&targets[k], &seeds[k]);
            match (answer, scalar) {
                (Ok(a), Ok(b)) => {
                    assert!(miss(&robot, &frame, &a.q, &targets[k]) <= 1e-6 && robot.limits().contain(&a.q));
                    assert!((a.q - b.q).amax() < 0.02 && a.start == b.start, "{k} {a:?} {b:?}");
                    fallen += usize::from(a.start != Start::Seed);
                }
                (Err(IkError::Seed { joint: a, .. }), Err(IkError::Seed { joint: b, .. })) => assert_eq!(*a, b),
                (Err(a), Err(b)) => assert_eq!(*a, b),
                (a, b) => panic!("{k} {path:?} {a:?} {b:?}"),
            }
        }
        assert!(fallen > 10, "{fallen}");
        // The company does not matter: the warm ones alone give the same bits.
        let easy: Vec<_> = (0..400).filter(|k| k % 8 == 0).collect();
        let (t, s): (Vec<_>, Vec<_>) = easy.iter().map(|k| (targets[*k], seeds[*k])).unzip();
        let alone = batch::solve(&solver, &t, &s, path).unwrap();
        assert!(easy.iter().zip(&alone).all(|(k, alone)| answers[*k] == *alone));
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let robot = irb120();
    let frame = robot.frame("tool0").unwrap();
    let solver = IkSolver::new(&robot, frame, IkSettings::default()).unwrap();
    let (targets, seeds) = warm(&robot, &frame, 5003, 0.05);
    for path in PATHS {
        let run = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let solved = batch::solve(&solver, &targets, &seeds, path).unwrap();
                let jacobians = batch::jacobian(&robot, &frame, &seeds, Axes::Local, path);
                (
                    fk_slices(&robot, &frame, &seeds, path),
                    batch::fk(&robot, &frame, &seeds, path),
                    jacobians,
                    solved,
                )
            })
        };
        let one = run(1);
        assert!(one == run(2) && one == run(8), "{path:?}");
    }
}
