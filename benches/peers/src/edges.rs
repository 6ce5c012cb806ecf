//! Poses for the judged run: anywhere, and where solvers go wrong.

use crate::plain_fk::PlainArm;
use nalgebra::{Isometry3, UnitQuaternion, Vector3, Vector4};
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel};
use platewash_problems::problems::configuration;
use rand::RngExt;
use rand_pcg::Pcg64;
use std::f64::consts::{PI, TAU};

/// A pose, where to start from, and a configuration within the limits that has the pose, if one is known.
#[derive(Debug, Clone)]
pub struct Case {
    /// What it is.
    pub kind: &'static str,
    /// `T_base_tool0`.
    pub pose: Pose,
    /// Start within the limits \[rad\].
    pub start: JointVector,
    /// Proof that the pose is reachable \[rad\].
    pub witness: Option<JointVector>,
}

/// The elbow angle at which the arm is stretched, −atan2(0.302, 0.070) \[rad\].
fn stretched() -> f64 {
    -f64::atan2(0.302, 0.070)
}

/// A random pose, whether reachable or not: half of configurations within the limits, a quarter of any configuration,
/// a quarter anywhere in a box around the arm.
pub fn anywhere(robot: &RobotModel, arm: &PlainArm, rng: &mut Pcg64) -> Case {
    match rng.random_range(0..4) {
        0 => {
            let q = JointVector::from_fn(|_, _| signed(rng) * PI);
            case("any configuration", robot, arm, q, rng)
        }
        1 => {
            let position = Vector3::new(0.8 * signed(rng), 0.8 * signed(rng), 0.35 + 0.8 * signed(rng));
            let pose = Isometry3::from_parts(position.into(), rotation(rng));
            Case {
                kind: "any pose",
                pose,
                start: configuration(robot, rng),
                witness: None,
            }
        }
        _ => {
            let q = configuration(robot, rng);
            case("configuration within the limits", robot, arm, q, rng)
        }
    }
}

/// A pose at, or 1e-12 to 1e-3 (m or rad) beside, an edge of what the arm can do; in one case of four at a second
/// edge as well.
pub fn at_an_edge(robot: &RobotModel, arm: &PlainArm, rng: &mut Pcg64) -> Case {
    let mut q = configuration(robot, rng);
    if rng.random_range(0..4) == 0 {
        put_beside_an_angle(robot, &mut q, rng);
    }
    match rng.random_range(0..4) {
        0 => {
            put_beside_a_limit(robot, &mut q, rng);
            case("limit", robot, arm, q, rng)
        }
        1 => {
            q[4] = offset(rng);
            case("wrist singularity", robot, arm, q, rng)
        }
        2 => {
            q[2] = stretched();
            let bodies = arm.bodies(&q);
            let along =
                (bodies[4].translation + bodies[4].rotation.column(2) * 0.302 - bodies[2].translation).normalize();
            moved("full stretch", robot, arm, q, along * offset(rng), rng)
        }
        _ => {
            while !put_the_wrist_on_axis_1(robot, &mut q) {
                q[2] = configuration(robot, rng)[2];
            }
            let (s, c) = (TAU * rng.random::<f64>()).sin_cos();
            let by = Vector3::new(c, s, 0.0) * offset(rng);
            moved("shoulder singularity", robot, arm, q, by, rng)
        }
    }
}

/// Joint 2 such that `0.27 sin q₂ + 0.302 cos(q₂ + q₃) + 0.07 sin(q₂ + q₃) = 0`; false if its limits forbid that.
fn put_the_wrist_on_axis_1(robot: &RobotModel, q: &mut JointVector) -> bool {
    let (s, c) = q[2].sin_cos();
    let of_sine = 0.27 + 0.07 * c - 0.302 * s;
    let of_cosine = 0.302 * c + 0.07 * s;
    q[1] = (-of_cosine).atan2(of_sine);
    let fits = |q: &JointVector| robot.limits().margins(q)[1] >= 0.0;
    if !fits(q) {
        q[1] -= PI.copysign(q[1]);
    }
    fits(q)
}

fn put_beside_an_angle(robot: &RobotModel, q: &mut JointVector, rng: &mut Pcg64) {
    if rng.random_range(0..2) == 0 {
        q[4] = offset(rng);
    } else {
        put_beside_a_limit(robot, q, rng);
    }
}

fn put_beside_a_limit(robot: &RobotModel, q: &mut JointVector, rng: &mut Pcg64) {
    let joint = rng.random_range(0..AXES);
    let limits = robot.limits();
    let limit = [limits.lower, limits.upper][rng.random_range(0..2)][joint];
    q[joint] = limit + offset(rng);
}

/// Zero in one case of sixteen, else ± 1e-12 to 1e-3.
fn offset(rng: &mut Pcg64) -> f64 {
    if rng.random_range(0..16) == 0 {
        return 0.0;
    }
    let size = 10_f64.powf(-12.0 + 9.0 * rng.random::<f64>());
    size.copysign(signed(rng))
}

fn case(kind: &'static str, robot: &RobotModel, arm: &PlainArm, q: JointVector, rng: &mut Pcg64) -> Case {
    // One start of four is near.
    let start = match rng.random_range(0..4) {
        0 => robot.limits().clamp(&q.map(|angle| angle + 0.1 * signed(rng))),
        _ => configuration(robot, rng),
    };
    Case {
        kind,
        pose: Pose::from(&arm.tool0(&q)),
        start,
        witness: robot.limits().contain(&q).then_some(q),
    }
}

fn moved(
    kind: &'static str,
    robot: &RobotModel,
    arm: &PlainArm,
    q: JointVector,
    by: Vector3<f64>,
    rng: &mut Pcg64,
) -> Case {
    let mut case = case(kind, robot, arm, q, rng);
    case.pose.translation.vector += by;
    case.witness = case.witness.filter(|_| by == Vector3::zeros());
    case
}

/// Uniform in [−1, 1).
fn signed(rng: &mut Pcg64) -> f64 {
    2.0 * rng.random::<f64>() - 1.0
}

/// A uniformly random rotation: a direction in four dimensions.
fn rotation(rng: &mut Pcg64) -> UnitQuaternion<f64> {
    loop {
        let v = Vector4::from_fn(|_, _| signed(rng));
        if (0.01..=1.0).contains(&v.norm_squared()) {
            return UnitQuaternion::from_quaternion(v.into());
        }
    }
}
