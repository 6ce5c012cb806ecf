//! Motions of an arm alone, against dense samples.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_bodies::assembly;
use platewash_bodies::clearance::{ClearanceModel, ITERATIVE_ERROR_M};
use platewash_certificate::{ArmMotionProof, MotionRules, ProveError, Requirement, Status, Timing, prove_arm_motion};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::irb120::{IRB120_SRDF, IRB120_URDF};
use platewash_kinematics::urdf::MeshSource;
use platewash_kinematics::{DisabledPairs, JointVector, Pose, RobotModel};
use platewash_motion::piecewise::{MotionPiece, PiecewiseMotion};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::{Obstacle, ObstacleShape, Workcell};
use proptest::prelude::*;

const CLEARANCE_M: f64 = 0.005;

fn cell(arm: &RobotModel, mount: Pose) -> Workcell {
    let bar = |name: &str, at: [f64; 3], half_m: [f64; 3]| {
        let shape = Shape::Box { half_m };
        let pose = mount * Pose::translation(at[0], at[1], at[2]);
        Obstacle::new(name, ObstacleShape::Convex(shape), pose)
    };
    let obstacles = vec![
        bar("post", [0.35, 0.25, 0.3], [0.02, 0.02, 0.3]),
        bar("beam", [0.3, 0.0, 0.85], [0.02, 0.4, 0.02]),
    ];
    assembly::workcell_without_tool(arm, mount, obstacles).unwrap()
}

fn rules() -> MotionRules {
    MotionRules {
        clearance_m: CLEARANCE_M,
        acceleration_rad_s2: None,
        rests_outside: false,
        timing: Timing::Stated,
    }
}

fn judged(motion: &PiecewiseMotion, cell: &Workcell, arm: &RobotModel, rules: &MotionRules) -> ArmMotionProof {
    prove_arm_motion(motion, cell, arm, rules, &CancelToken::new()).unwrap()
}

fn joint_1(angle: f64) -> JointVector {
    JointVector::new(angle, 0.6, 0.0, 0.0, 0.0, 0.0)
}

fn lines(q: &[JointVector], step_s: f64) -> PiecewiseMotion {
    let line = |k: usize| MotionPiece::line([k as f64 * step_s, (k + 1) as f64 * step_s], [q[k], q[k + 1]]);
    PiecewiseMotion::new((0..q.len() - 1).map(line).collect()).unwrap()
}

fn cubics(q: &[JointVector], v: &[JointVector], step_s: f64) -> PiecewiseMotion {
    let piece = |k: usize| {
        let t_s = [k as f64 * step_s, (k + 1) as f64 * step_s];
        MotionPiece::cubic(t_s, [q[k], q[k + 1]], [v[k], v[k + 1]])
    };
    PiecewiseMotion::new((0..q.len() - 1).map(piece).collect()).unwrap()
}

/// Both ends of the line are clear; the post stands between them.
#[test]
fn names_a_collision_between_two_clear_points() {
    let arm = RobotModel::irb120().unwrap();
    let proof = judged(
        &lines(&[joint_1(0.0), joint_1(1.3)], 2.0),
        &cell(&arm, Pose::identity()),
        &arm,
        &rules(),
    );
    assert_eq!(proof.status(), Status::Violated);
    let check = proof.check(Requirement::Clearance).unwrap();
    assert!(
        check.worst.pair.as_ref().unwrap().contains(&"post".to_owned()),
        "{check:?}"
    );
    assert!(check.worst.time_s.is_some_and(|t| t > 0.2 && t < 1.8), "{check:?}");
    assert!(proof.least_at_knots_m.unwrap() > 0.05, "{proof:?}");
}

/// The same motion about a mount that is turned: places are in the world.
#[test]
fn a_mounted_arm_has_the_same_proof() {
    let arm = RobotModel::irb120().unwrap();
    let mount = Pose::new(Vector3::new(1.0, -2.0, 0.5), Vector3::new(0.3, -0.2, 1.0));
    let motion = lines(&[joint_1(0.0), joint_1(0.2)], 2.0);
    let [here, there] = [Pose::identity(), mount].map(|mount| judged(&motion, &cell(&arm, mount), &arm, &rules()));
    assert_eq!((here.status(), there.status()), (Status::Proved, Status::Proved));
    let least = |proof: &ArmMotionProof| {
        proof
            .check(Requirement::Clearance)
            .unwrap()
            .measure
            .unwrap()
            .bound
            .unwrap()
    };
    assert!((least(&here) - least(&there)).abs() < 2e-4);
    let place = |proof: &ArmMotionProof| proof.check(Requirement::Clearance).unwrap().worst.place_m.unwrap();
    let moved = mount * nalgebra::Point3::from(place(&here));
    assert!((moved.coords - Vector3::from(place(&there))).norm() < 0.02);
}

#[test]
fn no_acceleration_limit_holds_where_a_speed_jumps() {
    let arm = RobotModel::irb120().unwrap();
    let cell = cell(&arm, Pose::identity());
    let motion = lines(&[joint_1(0.0), joint_1(0.1), joint_1(0.1)], 1.0);
    let stated = MotionRules {
        acceleration_rad_s2: Some(JointVector::repeat(1e6)),
        ..rules()
    };
    let check = |motion: &PiecewiseMotion, rules| {
        judged(motion, &cell, &arm, rules)
            .check(Requirement::JointAcceleration)
            .cloned()
    };
    let plain = rules();
    assert_eq!(check(&motion, &plain), None);
    let found = check(&motion, &stated).unwrap();
    assert_eq!(
        (found.status, found.worst.joint, found.worst.time_s),
        (Status::Violated, Some(0), Some(1.0))
    );
    let straight = lines(&[joint_1(0.0), joint_1(0.1), joint_1(0.2)], 1.0);
    assert_eq!(check(&straight, &stated).unwrap().status, Status::Proved);
    let free = MotionRules {
        rests_outside: false,
        timing: Timing::Free,
        ..stated
    };
    assert_eq!(check(&motion, &free), None);
}

#[test]
fn speeds_are_judged_where_times_are_stated_alone() {
    let arm = RobotModel::irb120().unwrap();
    let cell = cell(&arm, Pose::identity());
    let fast = lines(&[joint_1(0.0), joint_1(0.2)], 1e-3);
    let free = MotionRules {
        rests_outside: false,
        timing: Timing::Free,
        ..rules()
    };
    assert_eq!(judged(&fast, &cell, &arm, &rules()).status(), Status::Violated);
    assert_eq!(judged(&fast, &cell, &arm, &free).status(), Status::Proved);
}

#[test]
fn refuses_what_cannot_be_judged() {
    let arm = RobotModel::irb120().unwrap();
    let good = cell(&arm, Pose::identity());
    let motion = lines(&[joint_1(0.0), joint_1(0.1)], 1.0);
    let refused = |motion: &PiecewiseMotion, cell: &Workcell, rules: MotionRules| -> ProveError {
        prove_arm_motion(motion, cell, &arm, &rules, &CancelToken::new()).unwrap_err()
    };
    let mut rules_of = rules();
    rules_of.clearance_m = f64::NAN;
    assert!(refused(&motion, &good, rules_of).to_string().contains("clearance"));
    rules_of = rules();
    rules_of.acceleration_rad_s2 = Some(JointVector::repeat(-1.0));
    assert!(refused(&motion, &good, rules_of).to_string().contains("acceleration"));
    let mut twice = good.clone();
    twice.obstacles[0].name = "link_2".to_owned();
    assert!(matches!(
        refused(&motion, &twice, rules()),
        ProveError::NameTwice { .. }
    ));
    let mut lost = good.clone();
    lost.obstacles[0].pose.translation.x = f64::NAN;
    assert!(refused(&motion, &lost, rules()).to_string().contains("post"));
    assert!(matches!(
        refused(&PiecewiseMotion::default(), &good, rules()),
        ProveError::NoMotion { .. }
    ));
    let cancelled = CancelToken::new();
    cancelled.cancel();
    let given_up = prove_arm_motion(&motion, &good, &arm, &rules(), &cancelled);
    assert!(matches!(given_up, Err(ProveError::Cancelled(_))));
}

/// Pairs whose distance no joint changes are judged once. By hand: link 1 has a mast whose top is 0.95 m over the floor, 5 mm are required.
#[test]
fn judges_pairs_that_no_joint_moves_apart() {
    let mast = r#"<link name="link_1">
    <collision name="mast"><origin xyz="-0.16 0 0.6"/><geometry><cylinder radius="0.015" length="0.7"/></geometry></collision>"#;
    let text = IRB120_URDF.replace(r#"<link name="link_1">"#, mast);
    let arm = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let turned = UnitQuaternion::from_scaled_axis(Vector3::new(std::f64::consts::PI, 0.0, 0.0));
    let half_space = |name: &str, z: f64, turn| {
        let pose = Pose::from_parts(Vector3::new(0.0, 0.0, z).into(), turn);
        Obstacle::new(name, ObstacleShape::HalfSpace, pose)
    };
    let ceiling = |z: f64| half_space("ceiling", z, turned);
    let floor = |z: f64| half_space("floor", z, UnitQuaternion::identity());
    let block = |z: f64| {
        let shape = Shape::Box { half_m: [0.015; 3] };
        Obstacle::new("block", ObstacleShape::Convex(shape), Pose::translation(0.0, 0.0, z))
    };
    let proof = |obstacles: Vec<Obstacle>| {
        let cell = assembly::workcell_without_tool(&arm, Pose::identity(), obstacles).unwrap();
        judged(&lines(&[joint_1(0.0), joint_1(0.3)], 2.0), &cell, &arm, &rules())
    };
    let line_of = |proof: &ArmMotionProof, pair: [&str; 2]| {
        let line = proof.clearance.iter().find(|line| line.pair == pair);
        line.map(|line| (line.status, line.at_least_m.unwrap()))
    };
    let fine = proof(vec![floor(0.0), ceiling(0.956), block(-0.015)]);
    assert_eq!(fine.status(), Status::Proved, "{:?}", fine.checks);
    let (_, kept_m) = line_of(&fine, ["link_1", "ceiling"]).unwrap();
    assert!((kept_m - 0.006).abs() < 1e-9, "{kept_m}");
    assert!(
        fine.check(Requirement::Clearance)
            .unwrap()
            .measure
            .unwrap()
            .bound
            .unwrap()
            <= kept_m
    );
    assert!(
        fine.excluded
            .iter()
            .all(|left_out| left_out.pair[0] != "link_1" || left_out.pair[1] != "ceiling")
    );
    assert_eq!(fine.in_base, []);
    for (obstacle, pair) in [
        (ceiling(0.954), ["link_1", "ceiling"]),
        (ceiling(0.9), ["link_1", "ceiling"]),
        (floor(0.2), ["link_1", "floor"]),
        (floor(0.001), ["base_link", "floor"]),
        (block(0.02), ["base_link", "block"]),
    ] {
        let broken = proof(vec![obstacle]);
        assert_eq!(broken.status(), Status::Violated);
        assert_eq!(line_of(&broken, pair).unwrap().0, Status::Violated, "{pair:?}");
        // A check of the points finds it, too.
        assert!(broken.least_at_knots_m.unwrap() < CLEARANCE_M);
        assert_eq!(broken.in_base.is_empty(), pair[0] != "base_link" && pair[1] != "floor");
    }
}

fn vector(size: f64) -> impl Strategy<Value = JointVector> {
    prop::array::uniform6(-size..size).prop_map(JointVector::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Nothing is proved where a sample is below the clearance, and everything is where all samples exceed it by 0.1 mm: for straight lines,
    /// whose speeds jump, and for cubics. No bound of a pair is above a sample of it.
    #[test]
    fn agrees_with_dense_samples(
        start in vector(0.5), steps in prop::collection::vec(vector(0.7), 1..5), v in prop::collection::vec(vector(1.0), 5), is_cubic: bool,
    ) {
        let arm = RobotModel::irb120().unwrap();
        let cell = cell(&arm, Pose::identity());
        let mut q = vec![start];
        for step in &steps {
            q.push(q[q.len() - 1] + step);
        }
        let motion = if is_cubic { cubics(&q, &v, 1.0) } else { lines(&q, 1.0) };
        let proof = judged(&motion, &cell, &arm, &rules());
        let check = proof.check(Requirement::Clearance).unwrap();
        let model = ClearanceModel::new(&arm, &cell, &[]).unwrap();
        let mut least = f64::INFINITY;
        let mut least_of_pair = vec![f64::INFINITY; model.pair_count()];
        for piece in motion.pieces() {
            for k in 0..=200 {
                let [q, _] = piece.at(piece.t_s[0] + piece.length_s() * f64::from(k) / 200.0);
                for (least_of_pair, pair) in least_of_pair.iter_mut().zip(model.all(&q)) {
                    *least_of_pair = least_of_pair.min(pair.distance_m);
                    least = least.min(pair.distance_m);
                }
            }
        }
        if check.status == Status::Proved {
            prop_assert!(least >= CLEARANCE_M - ITERATIVE_ERROR_M, "{least} {check:?}");
        }
        if least > CLEARANCE_M + 1e-4 {
            prop_assert_eq!(check.status, Status::Proved, "{} {:?}", least, check);
        }
        if least < CLEARANCE_M - 1e-4 {
            prop_assert_eq!(check.status, Status::Violated, "{} {:?}", least, check);
        }
        prop_assert_eq!(proof.clearance.len(), least_of_pair.len());
        for (bound, sampled) in proof.clearance.iter().zip(&least_of_pair) {
            prop_assert!(bound.at_least_m.is_none_or(|m| m <= sampled + ITERATIVE_ERROR_M), "{:?} {}", bound, sampled);
        }
    }
}

/// A pair that an SRDF leaves out as one that never meets, and that meets in this motion, is named.
#[test]
fn a_disabled_pair_that_meets_is_named() {
    let with = |more: &str| {
        let text = IRB120_SRDF.replace("</robot>", &format!("{more}</robot>"));
        let pairs = DisabledPairs::parse(&text).unwrap();
        RobotModel::irb120().unwrap().with_disabled_pairs(pairs).unwrap()
    };
    let alone = assembly::workcell_without_tool(&with(""), Pose::identity(), Vec::new()).unwrap();
    // The wrist folded down to the foot.
    let folded = JointVector::from([0.0, 109.0, 60.0, 0.0, 90.0, 0.0]).map(f64::to_radians);
    let motion = lines(&[JointVector::zeros(), folded], 5.0);
    let proof = |arm: &RobotModel| judged(&motion, &alone, arm, &rules());
    let shipped = proof(&with(""));
    assert_eq!(
        (shipped.status(), shipped.disabled_meeting.len()),
        (Status::Violated, 0)
    );
    let Some([a, b]) = shipped.check(Requirement::Clearance).unwrap().worst.pair.clone() else {
        panic!("{shipped:?}")
    };
    let disabled = |reason: &str| {
        let all = ["base_link", "link_1"]
            .into_iter()
            .flat_map(|a| ["link_3", "link_4", "link_5", "link_6"].map(|b| (a, b)));
        let lines = all.map(|(a, b)| format!("<disable_collisions link1=\"{a}\" link2=\"{b}\" {reason}/>"));
        proof(&with(&lines.collect::<String>()))
    };
    for reason in ["reason=\"Never\"", "reason=\"User\"", ""] {
        let found = disabled(reason);
        assert_ne!(found.status(), Status::Violated, "{:?}", found.checks);
        let (_, time_s) = found
            .disabled_meeting
            .iter()
            .find(|(pair, _)| pair == &[a.clone(), b.clone()])
            .unwrap();
        assert!((0.0..=5.0).contains(time_s));
    }
    assert_eq!(disabled("reason=\"Default\"").disabled_meeting, []);
}

/// Where one piece has no speeds, the acceleration limits of a description can be broken in another one; they are not kept there.
#[test]
fn described_accelerations_are_judged_beside_a_jump() {
    let text = IRB120_URDF.replace("effort=\"0\"", "effort=\"0\" acceleration=\"2\"");
    let arm = RobotModel::from_urdf(&text, &MeshSource::none()).unwrap();
    let alone = assembly::workcell_without_tool(&arm, Pose::identity(), Vec::new()).unwrap();
    let zero = JointVector::zeros();
    for (angle, status) in [(0.1, None), (0.8, Some(Status::Violated))] {
        let [a, b, c] = [0.0, angle, angle + 0.1].map(joint_1);
        let pieces = vec![
            MotionPiece::cubic([0.0, 1.0], [a, b], [zero; 2]),
            MotionPiece::line([1.0, 2.0], [b, c]),
        ];
        let motion = PiecewiseMotion::new(pieces).unwrap();
        let proof = judged(&motion, &alone, &arm, &rules());
        let check = proof.check(Requirement::JointAcceleration);
        assert_eq!(check.map(|check| check.status), status, "{angle}");
    }
}
