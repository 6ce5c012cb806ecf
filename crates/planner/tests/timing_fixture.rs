//! Timed paths as a file, for `tests/python/test_timing_against_toppra.py`.
//!
//!     cargo test -p platewash-planner --test planner timing_fixture -- --ignored     writes it
//!
//! A case holds the path as samples (`u`, `q_rad`) of a not-a-knot cubic spline, the limits of the joints, those of the
//! tip or `null`, and the motion: its knots as parameters of the path (`knots_u`), times and speeds. Positions at the

//! knots are the path's.

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use platewash_fixtures::kitchen_tool;
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_planner::joint_path::{Ends, JointPath};
use platewash_planner::timing::{MotionLimits, TipLimits, time_optimal};
use platewash_workcell::surface::Surface;
use platewash_workcell::wash_path::{WashCurve, WashPattern};
use serde_json::{Value, json};
use std::f64::consts::PI;
use std::path::PathBuf;

/// Speeds \[deg/s\] of the IRB 120, and accelerations \[rad/s²\].
const SPEEDS_DEG_S: [f64; 6] = [250.0, 250.0, 250.0, 320.0, 320.0, 420.0];
const ACCELERATIONS: [f64; 6] = [4.0, 4.0, 4.0, 5.0, 5.0, 6.0];

/// Samples between the waypoints of the smooth path; they do not change it.
const PARTS: usize = 125;

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/timing.json")
}

#[test]
#[ignore = "writes the fixture"]
fn write() {
    std::fs::write(file(), fixture()).unwrap();
}

#[test]
fn the_fixture_is_current() {
    let committed = std::fs::read_to_string(file()).unwrap();
    assert!(committed == fixture(), "write it anew: see the head of this file");
}

fn fixture() -> String {
    let robot = RobotModel::irb120().unwrap();
    let tip = kitchen_tool().tip_frame(&robot);
    let smooth = smooth();
    let wash = wash(&robot, &tip, 3e-5);
    let tip_limits = TipLimits {
        speed_m_s: 0.25,
        acceleration_m_s2: 4.0,
    };
    let cases = [
        case("smooth", &smooth, &fine(&smooth), None, &robot, &tip),
        case("wash", &wash, &wash, None, &robot, &tip),
        case("wash, tip limited", &wash, &wash, Some(tip_limits), &robot, &tip),
    ];
    // One case a line.
    format!("[\n{}\n]\n", cases.map(|case| case.to_string()).join(",\n"))
}

/// The case of `stated`, a path that `timed` equals with more samples.
fn case(
    name: &str,
    stated: &JointPath,
    timed: &JointPath,
    tip_limits: Option<TipLimits>,
    robot: &RobotModel,
    tip: &Frame,
) -> Value {
    let limits = MotionLimits {
        velocity: JointVector::from(SPEEDS_DEG_S).map(f64::to_radians),
        acceleration: JointVector::from(ACCELERATIONS),
        tip: tip_limits,
    };
    let timed = time_optimal(timed, robot, tip, &limits).unwrap();
    json!({
        "name": name,
        "u": stated.parameters(),
        "q_rad": stated.positions(),
        "velocity_rad_s": limits.velocity,
        "acceleration_rad_s2": limits.acceleration,
        "tip": tip_limits.map(|tip| json!({
            "tool_length_m": 0.15, "speed_m_s": tip.speed_m_s, "acceleration_m_s2": tip.acceleration_m_s2,
        })),
        "knots_u": timed.parameters,
        "t_s": timed.motion.times(),
        "qd_rad_s": timed.motion.speeds(),
    })
}

/// Through a few configurations.
fn smooth() -> JointPath {
    let q = [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.5, 0.4, -0.3, 0.2, 0.6, -0.5],
        [0.9, -0.2, 0.3, -0.4, 0.9, 0.4],
        [0.2, -0.5, 0.6, 0.3, 0.1, 1.2],
        [-0.6, 0.1, 0.2, 0.8, -0.4, 0.3],
        [-0.8, 0.7, -0.5, 0.1, 0.3, -0.9],
        [-0.1, 0.3, -0.2, -0.6, 0.7, 0.1],
        [0.4, -0.3, 0.1, 0.2, -0.2, 0.8],
        [0.7, 0.2, 0.4, 0.5, 0.4, 0.2],
    ];
    let u = vec![0.0, 1.0, 1.8, 3.0, 4.1, 5.0, 6.2, 7.0, 8.0];
    JointPath::through(u, q.map(JointVector::from).to_vec(), Ends::NotAKnot).unwrap()
}

/// The same path with more samples: its pieces stay cubics that meet with continuous second derivatives.
fn fine(path: &JointPath) -> JointPath {
    let u = path.parameters();
    let mut fine = vec![u[0]];
    for ends in u.windows(2) {
        fine.extend((1..PARTS).map(|k| ends[0] + (ends[1] - ends[0]) * k as f64 / PARTS as f64));
        fine.push(ends[1]);
    }
    let q = fine.iter().map(|&u| path.at(u).q).collect();
    JointPath::through(fine, q, Ends::NotAKnot).unwrap()
}

/// The spiral and ring of a plate in front of the arm, tool straight down.
pub fn wash(robot: &RobotModel, tip: &Frame, chord_error_m: f64) -> JointPath {
    let curve = WashCurve {
        radius_m: 0.124,
        turns: 3.5,
        start_angle_rad: 0.3,
        closing_ring: true,
        trim_rad: 0.0,
        pattern: WashPattern::Spiral,
    };
    let solver = IkSolver::new(robot, *tip, IkSettings::default()).unwrap();
    let down = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), PI);
    let u = curve.parameters(&Surface::Disc { radius_m: 0.145 }, chord_error_m);
    let mut seed = JointVector::new(0.0, 0.5, 0.3, 0.0, 0.7, 0.0);
    let q = u.iter().map(|&theta| {
        let p = curve.at(theta).position;
        let target = Isometry3::from_parts(Translation3::new(0.36 + p.x, p.y, 0.03), down);
        seed = solver.solve(&target, &seed).unwrap().q;
        seed
    });
    let q = q.collect();
    JointPath::through(u, q, Ends::NotAKnot).unwrap()
}
