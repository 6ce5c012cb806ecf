//! A cell that is moved as a whole, mount, obstacles and plates together, is the same cell: its arm moves in the same way and the same
//! is proved of it.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use platewash::bodies::assembly;
use platewash::certificate::{Certificate, Requirement};
use platewash::kinematics::geometry::Shape;
use platewash::workcell::{Obstacle, ObstacleShape};
use platewash::{Plan, Pose, Scenario, SimulationReport, WashJob, plan, prove, simulate};
use platewash_fixtures::is_thorough;
use proptest::prelude::*;
use proptest::test_runner::Config;

/// How far joint positions may be apart \[rad\].
const ALIKE_RAD: f64 = 1e-9;

/// The kitchen, with a post beside it whose margin counts, so that something convex is moved along.
fn kitchen(seed: u64) -> WashJob {
    let mut scenario = Scenario::load("kitchen").unwrap();
    scenario.seed = seed;
    let job = scenario.job().unwrap();
    let mut terms = job.terms().clone();
    let post = Shape::Cylinder {
        radius_m: 0.04,
        half_length_m: 0.3,
    };
    let mut post = Obstacle::new("post", ObstacleShape::Convex(post), Pose::translation(-0.45, 0.1, 0.3));
    post.margin_m = 0.005;
    terms.workcell.obstacles.push(post);
    terms.workcell.exclusions = assembly::own_exclusions(&terms.workcell, job.arm()).unwrap();
    WashJob::new(job.shared_arm(), terms).unwrap()
}

/// The same job with everything in its world moved.
fn moved(job: &WashJob, by: &Pose) -> WashJob {
    let mut terms = job.terms().clone();
    terms.workcell.mount = by * terms.workcell.mount;
    for obstacle in &mut terms.workcell.obstacles {
        obstacle.pose = by * obstacle.pose;
    }
    for plate in &mut terms.plates {
        *plate = plate.seen_from(by);
    }
    WashJob::new(job.shared_arm(), terms).unwrap()
}

fn judged(job: &WashJob) -> (Plan, Certificate) {
    let plan = plan(job).unwrap().plan;
    let certificate = prove(&plan, job.arm()).unwrap();
    (plan, certificate)
}

/// The greatest difference of two motions' positions at their knots \[rad\]; infinite where they have not as many.
fn apart_rad(a: &Plan, b: &Plan) -> f64 {
    if a.knots.q_rad.len() != b.knots.q_rad.len() {
        return f64::INFINITY;
    }
    let pairs = a.knots.q_rad.iter().zip(&b.knots.q_rad);
    pairs.map(|(a, b)| (a - b).amax()).fold(0.0, f64::max)
}

/// When the tip is fastest \[s\], and where \[m\].
fn fastest(certificate: &Certificate) -> (f64, Vector3<f64>) {
    let worst = &certificate.check(Requirement::TipSpeed).unwrap().worst;
    (worst.time_s.unwrap(), worst.place_m.unwrap().into())
}

fn rotation() -> impl Strategy<Value = UnitQuaternion<f64>> {
    let parts =
        prop::array::uniform4(-1.0..1.0f64).prop_filter("no rotation", |q| q.iter().map(|v| v * v).sum::<f64>() > 0.1);
    parts.prop_map(|[w, x, y, z]| UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)))
}

proptest! {
    #![proptest_config(Config { cases: if is_thorough() { 6 } else { 2 }, failure_persistence: None, ..Config::default() })]

    #[test]
    fn moving_the_whole_cell_changes_nothing_for_the_arm(seed in 1..40u64, rotation in rotation(), at in prop::array::uniform3(-3.0..3.0f64)) {
        let by = Pose::from_parts(Vector3::from(at).into(), rotation);
        let here = kitchen(seed);
        let there = moved(&here, &by);
        let ((plan, proof), (other, other_proof)) = (judged(&here), judged(&there));
        let apart = apart_rad(&plan, &other);
        prop_assert!(apart <= ALIKE_RAD, "{apart} rad");
        prop_assert_eq!(&plan.order, &other.order);
        prop_assert!(proof.passes() && other_proof.passes(), "{}\n{}", proof.headline, other_proof.headline);
        let statuses = |certificate: &Certificate| certificate.checks.iter().map(|check| check.status).collect::<Vec<_>>();
        prop_assert_eq!(statuses(&proof), statuses(&other_proof));
        // What is told is told in the world.
        let ((t_s, place_m), (other_s, other_m)) = (fastest(&proof), fastest(&other_proof));
        let told = by * nalgebra::Point3::from(place_m);
        prop_assert!((t_s - other_s).abs() > 1e-9 || (told.coords - other_m).norm() < 1e-6);
    }
}

/// A world that is moved along the floor and turned about the vertical keeps its gravity: the arm needs the same torques.
#[test]
fn a_world_that_keeps_its_gravity_needs_the_same_torques() {
    let here = kitchen(3);
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), 2.0);
    let there = moved(&here, &Pose::from_parts(Vector3::new(1.0, -2.0, 0.7).into(), turn));
    let run = |job: &WashJob| {
        let plan = plan(job).unwrap().plan;
        let settings = &plan.job.simulation;
        let execution = simulate(&plan, job.arm(), settings).unwrap();
        let report = SimulationReport::new(&plan, job.arm(), settings, &execution).unwrap();
        (execution, report)
    };
    let ((a, here_told), (b, there_told)) = (run(&here), run(&there));
    assert_eq!(a.samples.len(), b.samples.len());
    let apart = a
        .samples
        .iter()
        .zip(&b.samples)
        .map(|(a, b)| (a.torque - b.torque).amax());
    let apart = apart.fold(0.0, f64::max);
    assert!(apart < 1e-4, "{apart} N·m");
    assert_eq!(here_told.verdict, there_told.verdict);
}

/// An arm that hangs head down carries its own weight the other way: the torques that hold it are those of the same arm under the
/// opposite gravity.
#[test]
fn a_hanging_arm_is_pulled_out_of_its_base() {
    use platewash::DynamicsModel;
    use platewash::simulator::dynamics::STANDARD_GRAVITY_M_S2;
    let job = kitchen(1);
    let half_turn = Pose::from_parts(
        Vector3::new(0.0, 0.0, 1.0).into(),
        UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI),
    );
    let hanging = DynamicsModel::mounted(job.arm(), None, &half_turn).unwrap();
    let pulled = DynamicsModel::new(job.arm(), None).unwrap();
    let pulled = pulled
        .with_gravity(Vector3::new(0.0, 0.0, STANDARD_GRAVITY_M_S2))
        .unwrap();
    let q = job.terms().home_rad[0];
    assert!((hanging.gravity_torque(&q) - pulled.gravity_torque(&q)).amax() < 1e-12);
    assert!(hanging.gravity_torque(&q).amax() > 1.0);
}
