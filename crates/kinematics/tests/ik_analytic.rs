//! Analytic inverse kinematics: complete, exact, and honest about what it refuses.

use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::ik::analytic::{
    AnalyticArm, AnalyticError, Label, NearestConfiguration, ReachBorder, Rejection, StructureMismatch,
};
use platewash_kinematics::model::manipulability;
use platewash_kinematics::rotation::{RigidTransform, from_rpy, rotation_vector};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{AXES, Axes, Frame, JointVector, RobotModel};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::{PI, TAU};

/// Random poses of the full test.
const POSES: usize = 200_000;
const EXACT: f64 = 1e-9;

struct Arm {
    robot: RobotModel,
    frame: Frame,
    arm: AnalyticArm,
}

impl Arm {
    fn new(robot: RobotModel) -> Self {
        let arm = AnalyticArm::recognise(&robot).unwrap();
        let frame = robot.last_link_frame();
        Self { robot, frame, arm }
    }

    fn irb120() -> Self {
        Self::new(RobotModel::irb120().unwrap())
    }

    /// Body 6's pose, by the crate's FK.
    fn target(&self, q: &JointVector) -> RigidTransform {
        AnalyticArm::body_target(&self.frame, &self.robot.fk(q).rigid(&self.frame)).unwrap()
    }

    fn random(&self, rng: &mut Pcg64) -> JointVector {
        JointVector::from_fn(|i, _| {
            let [low, high] = self.robot.limits().sampling_range(i);
            low + (high - low) * rng.random::<f64>()
        })
    }

    /// Largest error of `q` \[m or rad\].
    fn error(&self, q: &JointVector, target: &RigidTransform) -> f64 {
        let found = self.target(q);
        let angle = rotation_vector(&(found.rotation * target.rotation.transpose())).norm();
        (found.translation - target.translation).norm().max(angle)
    }

    fn nearest(&self, target: &RigidTransform, start: &JointVector) -> Result<NearestConfiguration, AnalyticError> {
        self.arm.nearest(target, start, self.robot.limits())
    }

    /// The nearest answer, checked in every way there is.
    fn checked(&self, target: &RigidTransform, start: &JointVector, what: &str) -> NearestConfiguration {
        let found = self
            .nearest(target, start)
            .unwrap_or_else(|e| panic!("{}: {what}: {e}", self.robot.name()));
        let error = self.error(&found.q, target);
        assert!(error <= EXACT, "{}: {what}: off by {error:e}", self.robot.name());
        assert!(self.robot.limits().contain(&found.q), "{what}: outside the limits");
        assert!((found.distance_rad - (found.q - start).norm()).abs() < 1e-12);
        found
    }

    /// Every answer within the limits, each checked.
    fn all(&self, target: &RigidTransform, previous: &JointVector) -> Vec<(Label, JointVector)> {
        let solutions = self.arm.solve_all(target, previous, self.robot.limits()).unwrap();
        let branches = self.arm.branches(target, previous).unwrap().iter().count();
        assert_eq!(solutions.iter().count() + solutions.rejections().count(), branches);
        let all: Vec<_> = solutions.configurations().collect();
        for (label, q) in &all {
            let error = self.error(q, target);
            assert!(error <= EXACT, "{}: {label:?} off by {error:e}", self.robot.name());
            assert!(self.robot.limits().contain(q));
        }
        all
    }
}

fn fixture(name: &str) -> RobotModel {
    let path = format!("{}/tests/fixtures/{name}.urdf", env!("CARGO_MANIFEST_DIR"));
    RobotModel::from_urdf(&std::fs::read_to_string(path).unwrap(), &MeshSource::none()).unwrap()
}

fn family() -> Vec<Arm> {
    let generated = (1..=9).map(|k| Arm::new(fixture(&format!("family_{k}"))));
    std::iter::once(Arm::irb120()).chain(generated).collect()
}

/// The distance between two configurations when whole turns do not count.
fn apart(a: &JointVector, b: &JointVector) -> f64 {
    (a - b).map(|d| d - TAU * (d / TAU).round()).amax()
}

#[test]
fn random_reachable_poses_are_all_solved() {
    let irb = Arm::irb120();
    let workers = 2;
    std::thread::scope(|scope| {
        for worker in 0..workers {
            let irb = &irb;
            scope.spawn(move || {
                let mut rng = Pcg64::seed_from_u64(worker);
                for _ in 0..POSES / workers as usize {
                    let (q, start) = (irb.random(&mut rng), irb.random(&mut rng));
                    let found = irb.checked(&irb.target(&q), &start, "random");
                    assert!(found.distance_rad <= (q - start).norm() + 1e-9);
                }
            });
        }
    });
}

/// The configuration that made the pose is among the answers, and `nearest` is the nearest of them.
#[test]
fn finds_all_solutions_of_generated_arms() {
    for arm in family() {
        let mut rng = Pcg64::seed_from_u64(17);
        for _ in 0..POSES / 20 {
            let (q, start) = (arm.random(&mut rng), arm.random(&mut rng));
            let target = arm.target(&q);
            let all = arm.all(&target, &start);
            let miss = all.iter().map(|(_, a)| apart(a, &q)).fold(f64::INFINITY, f64::min);
            assert!(miss < 1e-6, "{}: {miss:e} from {q:?}", arm.robot.name());
            let found = arm.checked(&target, &start, "random");
            let best = all
                .iter()
                .map(|(_, a)| (a - start).norm())
                .fold(f64::INFINITY, f64::min);
            assert!(
                (found.distance_rad - best).abs() < 1e-9,
                "{}: {} {best}",
                arm.robot.name(),
                found.distance_rad
            );
            let branches = arm.arm.branches(&target, &start).unwrap();
            assert_eq!(branches.get(found.label).unwrap().unwrap().label, found.label);
            for branch in branches.iter().flatten() {
                assert!(arm.error(&branch.q, &target) <= EXACT);
                assert!(branch.q.amax() <= PI);
            }
        }
    }
}

/// Brute force over whole turns: `solve_all` misses none.
#[test]
fn every_whole_turn_within_the_limits_is_listed() {
    let arm = Arm::irb120();
    let mut rng = Pcg64::seed_from_u64(23);
    let mut most = 0;
    for _ in 0..2000 {
        let q = arm.random(&mut rng);
        let target = arm.target(&q);
        let mut expected = 0;
        for branch in arm.arm.branches(&target, &q).unwrap().iter().flatten() {
            for turns in 0..3_usize.pow(6) {
                let turned =
                    JointVector::from_fn(|i, _| branch.q[i] + TAU * ((turns / 3_usize.pow(i as u32)) % 3) as f64 - TAU);
                expected += usize::from(arm.robot.limits().contain(&turned));
            }
        }
        let all = arm.all(&target, &q);
        assert_eq!(all.len(), expected);
        most = most.max(all.len());
    }
    assert!(most >= 8, "{most}");
}

/// Values to try around a singular one: 1e-12 … 1e-3 to either side, and exactly there.
fn around(value: f64) -> Vec<f64> {
    let steps = (0..19).map(|k| 10.0_f64.powf(-12.0 + 0.5 * f64::from(k)));
    std::iter::once(value)
        .chain(steps.flat_map(|d| [value - d, value + d]))
        .collect()
}

/// Joint values at which an arm is singular, found from its own answers: joint 3 at stretch and joint 5 straight.
fn singular_values(arm: &Arm) -> (f64, f64) {
    let mut rng = Pcg64::seed_from_u64(29);
    loop {
        let branches = arm
            .arm
            .branches(&arm.target(&arm.random(&mut rng)), &JointVector::zeros())
            .unwrap();
        let [up, down, plain, flipped] = [0, 2, 0, 1].map(|k| *branches.get(Label::EIGHT[k]).unwrap());
        let (Ok(up), Ok(down), Ok(plain), Ok(flipped)) = (up, down, plain, flipped) else {
            continue;
        };
        let middle = |a: f64, b: f64| (a + b) / 2.0;
        // The two elbow (wrist) branches lie symmetrically about it, or about the opposite point.
        let third = middle(up.q[2], down.q[2]);
        let fifth = middle(plain.q[4], flipped.q[4]);
        return (third, fifth);
    }
}

#[test]
fn poses_near_stretch_and_the_wrist_singularity_are_solved() {
    for arm in family() {
        let mut rng = Pcg64::seed_from_u64(31);
        let (third, fifth) = singular_values(&arm);
        let mut tried = 0;
        for (joint, value) in [(2, third), (2, third + PI), (4, fifth), (4, fifth + PI)] {
            for near in around(value) {
                for _ in 0..20 {
                    let mut q = arm.random(&mut rng);
                    q[joint] = near;
                    if rng.random::<f64>() < 0.3 {
                        let both = if joint == 2 { (4, fifth) } else { (2, third) };
                        q[both.0] = both.1 + 10.0_f64.powf(-12.0 + 9.0 * rng.random::<f64>());
                    }
                    let q = q.zip_map(&arm.robot.limits().lower, |v, low| if v < low { v + TAU } else { v });
                    let q = q.zip_map(&arm.robot.limits().upper, |v, high| if v > high { v - TAU } else { v });
                    if !arm.robot.limits().contain(&q) {
                        continue;
                    }
                    tried += 1;
                    let start = arm.random(&mut rng);
                    let found = arm.checked(&arm.target(&q), &start, &format!("joint {joint} at {near}"));
                    assert!(!arm.all(&arm.target(&q), &start).is_empty());
                    let spherical = arm.arm.structure().starts_with("spherical wrist");
                    if found.degenerate.wrist && joint == 4 && near == value && spherical {
                        let kept = (found.q[3] - start[3]).abs() < 1e-12;
                        let at_limit = arm.robot.limits().margins(&found.q)[5] < 1e-9;
                        assert!(kept || at_limit, "joint 4 keeps its value: {} {}", found.q[3], start[3]);
                    }
                }
            }
        }
        assert!(tried > 500, "{}: {tried}", arm.robot.name());
    }
}

/// Configurations with the wrist centre near axis 1 (or near the column around it): joint 2 is turned until
/// the wrist centre gets as close as it can.
fn over_the_shoulder(arm: &Arm, rng: &mut Pcg64) -> Option<JointVector> {
    let mut q = arm.random(rng);
    // In the frame of joint 1 the wrist centre's distance from axis 1 is what q₁ does not change.
    let distance = |q: &JointVector| {
        let wrist = |q1: f64| {
            let mut p = *q;
            p[0] = q1;
            arm.wrist_centre(&p)
        };
        (wrist(0.0) - wrist(PI)).norm() / 2.0
    };
    let [low, high] = arm.robot.limits().sampling_range(1);
    let at = |mut p: JointVector, v: f64| {
        p[1] = v;
        distance(&p)
    };
    let grid = 200;
    let value = |k: usize| low + (high - low) * k as f64 / grid as f64;
    let best = (1..grid).min_by(|a, b| at(q, value(*a)).total_cmp(&at(q, value(*b))))?;
    let (mut a, mut b) = (value(best - 1), value(best + 1));
    for _ in 0..90 {
        let (x, y) = (a + (b - a) * 0.382, a + (b - a) * 0.618);
        if at(q, x) < at(q, y) { b = y } else { a = x }
    }
    q[1] = (a + b) / 2.0;
    Some(q)
}

impl Arm {
    /// Where axes 4, 5 and 6 meet: the point of body 6 that joints 4 to 6 leave in place.
    fn wrist_centre(&self, q: &JointVector) -> Vector3<f64> {
        // p(q) = c + R(q) v with the same c for every wrist angle: (R − R') v = p − p'.
        let poses = [0.0, 0.7, -0.9].map(|d| self.target(&(q + JointVector::new(0.0, 0.0, 0.0, d, 2.0 * d, d * d))));
        let a = poses[0].rotation - poses[1].rotation;
        let b = poses[0].rotation - poses[2].rotation;
        let normal = a.tr_mul(&a) + b.tr_mul(&b);
        let right = a.tr_mul(&(poses[0].translation - poses[1].translation))
            + b.tr_mul(&(poses[0].translation - poses[2].translation));
        let v: Vector3<f64> = normal.try_inverse().unwrap() * right;
        poses[0].translation - poses[0].rotation * v
    }
}

#[test]
fn poses_near_the_shoulder_singularity_are_solved() {
    for arm in family() {
        let mut rng = Pcg64::seed_from_u64(37);
        let mut met = 0;
        for _ in 0..60 {
            let Some(closest) = over_the_shoulder(&arm, &mut rng) else {
                continue;
            };
            for second in around(closest[1]) {
                let mut q = closest;
                q[1] = second;
                if !arm.robot.limits().contain(&q) {
                    continue;
                }
                let start = arm.random(&mut rng);
                let found = arm.checked(&arm.target(&q), &start, "over the shoulder");
                met += usize::from(found.degenerate.shoulder);
                assert!(!arm.all(&arm.target(&q), &start).is_empty());
            }
        }
        println!("{}: shoulder singular {met} times", arm.robot.name());
    }
}

/// Exactly over the shoulder joint 1 keeps its value when it can.
#[test]
fn over_the_shoulder_joint_1_keeps_its_value() {
    let arm = Arm::irb120();
    // Joint 2 such that 0.302 m forwards and 0.070 m up from the elbow end above axis 1, joint 3 at zero.
    let second = -(0.302_f64).atan2(0.340);
    let mut rng = Pcg64::seed_from_u64(41);
    let (mut kept, mut runs) = (0, 0);
    for _ in 0..20_000 {
        let mut q = arm.random(&mut rng);
        (q[1], q[2]) = (second, 0.0);
        let start = arm.random(&mut rng);
        let found = arm.checked(&arm.target(&q), &start, "exactly over the shoulder");
        assert!(found.degenerate.shoulder);
        runs += 1;
        kept += usize::from((found.q[0] - start[0]).abs() < 1e-12);
    }
    assert!(kept * 2 > runs, "{kept} of {runs}");
}

#[test]
fn poses_at_and_around_every_limit_are_solved() {
    // The IRB 120's wrist centre above axis 1 with joint 3 at zero.
    let over = -(0.302_f64).atan2(0.340);
    for arm in family() {
        let mut rng = Pcg64::seed_from_u64(43);
        let (third, fifth) = singular_values(&arm);
        for joint in 0..AXES {
            let limits = arm.robot.limits();
            for limit in [limits.lower[joint], limits.upper[joint]]
                .into_iter()
                .filter(|l| l.is_finite())
            {
                for near in around(limit)
                    .into_iter()
                    .filter(|v| limits.lower[joint] <= *v && *v <= limits.upper[joint])
                {
                    for corner in 0..6 {
                        let mut q = arm.random(&mut rng);
                        let tiny = 10.0_f64.powf(-12.0 + 9.0 * rng.random::<f64>());
                        match corner {
                            0 => q[2] = third + tiny,
                            1 => q[4] = fifth + tiny,
                            3 if arm.robot.name() == "irb120" => (q[1], q[2]) = (over + tiny, 0.0),
                            2 => q = limits.clamp(&q.map(|v| if v > 0.0 { 1e3 } else { -1e3 })),
                            _ => {}
                        }
                        q[joint] = near;
                        if limits.contain(&q) && q.amax() < 100.0 {
                            let start = arm.random(&mut rng);
                            arm.checked(
                                &arm.target(&q),
                                &start,
                                &format!("joint {joint} at {near}, corner {corner}"),
                            );
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn targets_beyond_reach_are_refused_with_the_distance() {
    let arm = Arm::irb120();
    let reach = 0.270 + (0.302_f64.powi(2) + 0.070_f64.powi(2)).sqrt();
    let straight = JointVector::new(0.3, 0.9, -(0.302_f64).atan2(0.070), 0.2, 0.4, 0.1);
    let target = arm.target(&straight);
    let wrist = arm.wrist_centre(&straight);
    let outwards = (wrist - Vector3::new(0.0, 0.0, 0.290)) / reach;
    for (by, reachable) in [
        (0.0, true),
        (1e-10, true),
        (1.5e-9, false),
        (1e-6, false),
        (1.0, false),
        (1e200, false),
    ] {
        let moved = RigidTransform {
            rotation: target.rotation,
            translation: target.translation + outwards * by,
        };
        match arm.nearest(&moved, &JointVector::zeros()) {
            Ok(found) => assert!(reachable && arm.error(&found.q, &moved) <= EXACT),
            Err(AnalyticError::OutOfReach(miss)) => {
                assert!(!reachable, "{by:e}: {miss}");
                assert!(
                    (miss.by_m - by).abs() <= 1e-12 + 1e-9 * by || by > 1e100,
                    "{by:e}: {miss}"
                );
                assert_eq!(miss.border, ReachBorder::Stretch);
            }
            Err(other) => panic!("{by:e}: {other}"),
        }
    }
    // Inside the column of an arm with a lateral offset.
    let lateral = Arm::new(fixture("family_5"));
    let mut rng = Pcg64::seed_from_u64(47);
    let borders = (0..20_000).filter_map(|_| {
        let p = Vector3::from_fn(|_, _| 1.2 * (rng.random::<f64>() - 0.5));
        let rotation = from_rpy([p.x, p.y, p.z].map(|v| 9.0 * v));
        lateral
            .nearest(
                &RigidTransform {
                    rotation,
                    translation: p,
                },
                &JointVector::zeros(),
            )
            .err()
    });
    let columns = borders.filter(|e| matches!(e, AnalyticError::OutOfReach(m) if m.border == ReachBorder::Column));
    assert!(columns.count() > 10);
}

#[test]
fn rejections_name_the_joint_and_the_limit() {
    let arm = Arm::irb120();
    let mut rng = Pcg64::seed_from_u64(53);
    let mut q = arm.random(&mut rng);
    q[4] = 2.2; // limit 2.094395
    let all = arm.arm.solve_all(&arm.target(&q), &q, arm.robot.limits()).unwrap();
    let by_joint_5 = all.rejections().any(|(_, rejection)| match rejection {
        Rejection::Limit(v) => v.joint == 4 && (v.position_rad - 2.2).abs() < 1e-9 && v.limit_rad == 2.094395,
        Rejection::OutOfReach(_) => false,
    });
    assert!(by_joint_5, "{:?}", all.rejections().collect::<Vec<_>>());
}

#[test]
fn input_that_is_not_finite_is_refused() {
    let arm = Arm::irb120();
    let target = arm.target(&JointVector::zeros());
    for broken in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for entry in 0..12 {
            let mut bad = target;
            if entry < 9 {
                bad.rotation[entry] = broken
            } else {
                bad.translation[entry - 9] = broken
            }
            let zeros = JointVector::zeros();
            assert!(matches!(arm.nearest(&bad, &zeros), Err(AnalyticError::Target { .. })));
            assert!(arm.arm.branches(&bad, &zeros).is_err());
            assert!(arm.arm.solve_all(&bad, &zeros, arm.robot.limits()).is_err());
        }
        let mut start = JointVector::zeros();
        start[2] = broken;
        assert!(matches!(
            arm.nearest(&target, &start),
            Err(AnalyticError::Start { joint: 2, .. })
        ));
    }
}

/// Along a spiral and a line the label of the nearest answer stays, and so does that of every branch.
#[test]
fn labels_stay_along_paths() {
    let arm = Arm::irb120();
    let down = from_rpy([0.0, PI / 2.0, 0.0]);
    let tip = |p: Vector3<f64>| {
        let target = RigidTransform {
            rotation: down,
            translation: p,
        };
        AnalyticArm::body_target(&arm.frame, &target).unwrap()
    };
    let spiral = |k: f64| {
        let (angle, radius) = (k * 6.0 * PI, 0.06 * k);
        tip(Vector3::new(0.40 + radius * angle.cos(), radius * angle.sin(), 0.12))
    };
    let line = |k: f64| tip(Vector3::new(0.38, -0.1 + 0.2 * k, 0.12));
    let paths: [&dyn Fn(f64) -> RigidTransform; 2] = [&spiral, &line];
    for path in paths {
        let mut q = arm
            .checked(&path(0.0), &JointVector::new(0.0, 0.5, 0.0, 0.0, 1.0, 0.0), "start")
            .q;
        let first = arm.checked(&path(0.0), &q, "start").label;
        let mut branches = arm.arm.branches(&path(0.0), &q).unwrap();
        for k in 1..=1000 {
            let target = path(f64::from(k) / 1000.0);
            let found = arm.checked(&target, &q, "path");
            assert_eq!(found.label, first);
            assert!(found.distance_rad < 0.05, "no jump");
            q = found.q;
            let next = arm.arm.branches(&target, &q).unwrap();
            assert_eq!(branches.iter().count(), next.iter().count());
            for ((label, before), after) in branches.labelled().zip(next.iter()) {
                if let (Ok(before), Ok(after)) = (before, after) {
                    assert!(apart(&before.q, &after.q) < 0.05, "{label:?} jumps at {k}");
                }
            }
            branches = next;
        }
    }
}

#[test]
fn labels_survive_small_perturbations() {
    for arm in family() {
        let mut rng = Pcg64::seed_from_u64(59);
        for _ in 0..5000 {
            let q = arm.random(&mut rng);
            let start = q + JointVector::from_fn(|_, _| 1e-7 * (rng.random::<f64>() - 0.5));
            let here = arm.checked(&arm.target(&q), &q, "here");
            let there = arm.checked(&arm.target(&start), &q, "there");
            if apart(&here.q, &q) < 1e-7 && apart(&there.q, &start) < 1e-7 && here.degenerate == there.degenerate {
                // The only crossings within 1e-7 are those of a singularity, which 5000 draws do not meet.
                assert_eq!(here.label, there.label, "{q:?}");
            }
        }
    }
}

#[test]
fn published_solutions_are_found() {
    let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/fixtures/solutions.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    let arm = Arm::irb120();
    let frame = arm.robot.frame(json["frame"].as_str().unwrap()).unwrap();
    let target = RigidTransform {
        rotation: Matrix3::identity(),
        translation: Vector3::new(0.0, 0.5, 0.5),
    };
    let target = AnalyticArm::body_target(&frame, &target).unwrap();
    let all = arm.all(&target, &JointVector::zeros());
    let published = json["solutions"].as_array().unwrap();
    assert_eq!(published.len(), 3);
    for solution in published {
        let q = JointVector::from_fn(|i, _| solution[i].as_f64().unwrap());
        let miss = all.iter().map(|(_, a)| (a - q).amax()).fold(f64::INFINITY, f64::min);
        assert!(miss < 1e-4, "{miss}");
    }
}

#[test]
fn rejects_other_structures_by_name() {
    for k in 1..=8 {
        let refused = AnalyticArm::recognise(&fixture(&format!("arm_{k}"))).unwrap_err();
        let oblique = matches!(
            refused,
            StructureMismatch::NotParallel { joints: [1, 2], by_rad } if by_rad > 1e-3
        );
        let wrist = matches!(refused, StructureMismatch::NotPerpendicular { by_rad, .. } if by_rad > 1e-3)
            || matches!(refused, StructureMismatch::WristNotSpherical { by_m, .. } if by_m > 1e-3);
        println!("arm_{k}: {refused}");
        assert!(oblique || ([4, 6].contains(&k) && wrist), "arm_{k}: {refused}");
    }
    let edited = |old: &str, new: &str| {
        let text = platewash_kinematics::irb120::IRB120_URDF;
        assert!(text.contains(old), "{old}");
        RobotModel::from_urdf(&text.replace(old, new), &MeshSource::none()).unwrap()
    };
    // The wrist's last axis 3 µm off, then 1e-12 m off.
    let shifted = |by: &str| edited("xyz=\"0.072 0 0\"", &format!("xyz=\"0.072 0 {by}\""));
    match AnalyticArm::recognise(&shifted("3e-6")).unwrap_err() {
        StructureMismatch::WristNotSpherical { joints: [4, 5], by_m } => assert!((by_m - 3e-6).abs() < 1e-12),
        other => panic!("{other}"),
    }
    assert!(AnalyticArm::recognise(&shifted("1e-12")).unwrap().rounding().is_none());
    // The real reason is named, not an angle that is off by rounding.
    let said = AnalyticArm::recognise(&rounded_irb120("xyz=\"0.072 0 0.0997\""))
        .unwrap_err()
        .to_string();
    assert!(
        said.contains("axes 4, 5 and 6 do not meet in one point")
            && said.contains("axes 5 and 6 miss each other by 99.7000 mm"),
        "{said}"
    );
    let flat = edited("xyz=\"0 0 0.27\"", "xyz=\"0 0.1 0\"");
    assert!(matches!(
        AnalyticArm::recognise(&flat),
        Err(StructureMismatch::NoUpperArm { .. })
    ));
}

/// The IRB 120 with axes 2 and 3 turned by 3e-6 rad, as rounding of a description turns them, and another origin of joint 6.
fn rounded_irb120(sixth: &str) -> RobotModel {
    let text = platewash_kinematics::irb120::IRB120_URDF.replace("xyz=\"0.072 0 0\"", sixth);
    let text = ["joint_2", "joint_3"].iter().fold(text, |text, joint| {
        let at = text.find(&format!("<joint name=\"{joint}\"")).unwrap();
        let (before, after) = text.split_at(at);
        let turned = after.replacen("<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0.000003\"/>", 1);
        format!("{before}{turned}")
    });
    RobotModel::from_urdf(&text, &MeshSource::none()).unwrap()
}

/// Away from singularities, the configuration that a pose was made from is among the answers, and every answer meets the pose of the chain
/// as described.
#[test]
fn meets_poses_of_a_rounded_arm_exactly() {
    let arm = Arm::new(rounded_irb120("xyz=\"0.072 0 0.0000005\""));
    let rounding = arm.arm.rounding().unwrap().to_string();
    assert_eq!(rounding, "axes 1 and 2 are not perpendicular, by 3.000e-6 rad");
    let mut rng = Pcg64::seed_from_u64(5);
    let (mut regular, mut answers) = (0, 0);
    for _ in 0..2000 {
        let q = arm.random(&mut rng);
        let target = arm.target(&q);
        let all = arm.all(&target, &q);
        for (_, found) in &all {
            assert!(
                arm.robot.limits().contain(found) && arm.error(found, &target) < EXACT,
                "{found}"
            );
        }
        answers += all.len();
        let jacobian = arm.robot.fk(&q).jacobian(&arm.frame, Axes::Base);
        if manipulability(&jacobian) > 1e-3 {
            regular += 1;
            let near = |found: &JointVector| (found - q).amax() < 1e-6;
            assert!(all.iter().any(|(_, found)| near(found)), "{q}");
            let nearest = arm.nearest(&target, &q).unwrap();
            assert!(near(&nearest.q), "{q}");
        }
    }
    assert!(regular > 1500 && answers > 2 * regular, "{regular} {answers}");
}

#[test]
fn the_same_arguments_give_the_same_bits() {
    let arm = Arm::irb120();
    let mut rng = Pcg64::seed_from_u64(61);
    for _ in 0..1000 {
        let (target, start) = (arm.target(&arm.random(&mut rng)), arm.random(&mut rng));
        assert_eq!(arm.nearest(&target, &start), arm.nearest(&target, &start));
    }
}

/// Brute force over whole turns: in the order of all configurations, the first of those nearest to a start is the first of those that are
/// nearest turn by turn, also where a joint is half a turn from the start. They are as few for joints of ±16 turns as for ±1.
#[test]
fn the_nearest_turns_hold_the_nearest_configuration() {
    let nearest = |all: &mut dyn Iterator<Item = JointVector>, start: &JointVector| {
        all.min_by(|a, b| (a - start).norm().total_cmp(&(b - start).norm()))
    };
    let mut rng = Pcg64::seed_from_u64(29);
    let mut ties = 0;
    for arm in [Arm::irb120(), Arm::new(fixture("ur5_lengths"))] {
        for k in 0..60 {
            let mut within =
                |low: f64, high: f64| JointVector::from_fn(|_, _| low + (high - low) * rng.random::<f64>());
            let (q, mut start) = (within(-3.0, 3.0), within(-16.0, 16.0));
            let target = arm.target(&q);
            let mut limits = arm.robot.limits().clone();
            (limits.lower, limits.upper) = (within(-13.0, -5.0), within(4.0, 8.0));
            let solutions = arm.arm.solve_all(&target, &start, &limits).unwrap();
            for solution in solutions.iter() {
                if k % 2 == 0 {
                    start = solution.lowest + within(0.0, 2.0).map(|turns| PI * turns.floor());
                }
                let few: Vec<_> = solution.nearest_configurations(&start).collect();
                assert_eq!(
                    nearest(&mut few.iter().copied(), &start),
                    nearest(&mut solution.configurations(), &start)
                );
                let mut all = solution.configurations();
                assert!(
                    few.iter().all(|q| all.any(|other| other == *q)),
                    "in order, and none twice"
                );
                assert!(few.len() <= 64);
                ties += usize::from(few.len() > 1);
            }
            let [once, often] = [1.0, 15.9].map(|turns| {
                (limits.lower, limits.upper) = (JointVector::repeat(-TAU * turns), JointVector::repeat(TAU * turns));
                let solutions = arm.arm.solve_all(&target, &q, &limits).unwrap();
                let few = solutions
                    .iter()
                    .map(|solution| solution.nearest_configurations(&q).count());
                few.sum::<usize>()
            });
            assert_eq!(often, once);
        }
    }
    assert!(ties > 100, "{ties}");
}
