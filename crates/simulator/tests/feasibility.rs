//! The project's table of tip errors, measured before any of this was written, reproduced: three laws, three frequencies,
//! three distances of the plate from axis 1.
//!
//! Conditions known to be alike: spiral of 4 turns to R 0.12 m and a closing ring, 0.25 m/s slowed for 4 m/s² lateral, tool
//! 0.15 m and 0.3 kg, ζ = 1, Kp from each joint's largest inertia, 1 kHz, held torque, start on the path. Where the table does
//! not say: the tilt is that of the plate's policy (outward near the base); the tool's centre of mass is 90 mm from the flange
//! and its inertia m l²/12 about every axis, which alone gives the gains that the table states (tested below); and errors
//! count from 0.4 s on, because the path starts at the spiral's centre with its full acceleration, and the response to that
//! is no tracking error. The 0.4 s are our choice, not stated by the table: counted in, pd_gravity comes out up to 18 % above it at
//! 30 rad/s and 50 % at 60 rad/s.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use platewash_fixtures::{kitchen_plate, kitchen_terms};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, RobotModel, trig};
use platewash_motion::plan::{Knots, Plan, PlanParts, Provenance};
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_simulator::simulate::PlateVerdict;
use platewash_simulator::{DynamicsModel, SimulationReport, simulate};
use platewash_workcell::simulation::ControlLawName;
use std::f64::consts::{PI, TAU};

const RADIUS_M: f64 = 0.12;
const TURNS: f64 = 4.0;
const SETTLED_S: f64 = 0.4;
const DISTANCES_M: [f64; 3] = [0.28, 0.36, 0.46];
const FREQUENCIES: [f64; 3] = [15.0, 30.0, 60.0];

/// Tip error, rms \[mm\]: frequency by frequency, one entry a distance.
const PD: [[f64; 3]; 3] = [[54.0, 68.0, 88.0], [15.7, 19.3, 24.1], [4.1, 5.0, 6.2]];
const PD_GRAVITY: [[f64; 3]; 3] = [[5.3, 4.8, 4.3], [1.4, 1.3, 1.2], [0.34, 0.32, 0.29]];
const COMPUTED_TORQUE: [[f64; 3]; 3] = [[0.05; 3], [0.03; 3], [0.01; 3]];

/// A plan of the kitchen's arm and tool, without its motion.
fn frame() -> (RobotModel, Plan) {
    let robot = RobotModel::irb120().unwrap();
    let mut terms = kitchen_terms(&robot, vec![kitchen_plate([0.36, 0.0])]);
    let moment = 0.3 * 0.15 * 0.15 / 12.0;
    let mass = terms.workcell.tool.mass.as_mut().unwrap();
    mass.com_m = [0.0, 0.0, 0.09];
    mass.inertia_kg_m2 = [moment, 0.0, 0.0, moment, 0.0, moment];
    let parts = PlanParts {
        provenance: Provenance::new("feasibility"),
        order: vec![0],
        wash_paths: Vec::new(),
        segments: Vec::new(),
        knots: Knots::default(),
    };
    (robot, Plan::sealed(terms, parts).unwrap())
}

/// Tilt towards the base \[rad\] at a distance from axis 1 \[m\].
fn tilt(distance: f64) -> f64 {
    let outward = (0.21 - distance) / 0.07;
    let inward = (distance - 0.54) / 0.08;
    (outward.clamp(0.0, 1.0) - inward.clamp(0.0, 1.0)) * 15f64.to_radians()
}

/// The plan with the stroke on a plate at `rho` and nothing else.
fn stroke(robot: &RobotModel, plan: &Plan, rho: f64) -> Plan {
    const DT: f64 = 0.002;
    let tight = IkSettings {
        position_tolerance_m: 1e-11,
        orientation_tolerance_rad: 1e-11,
        ..IkSettings::default()
    };
    let tip = plan.job.workcell.tool.tip_frame(robot);
    let solver = IkSolver::new(robot, tip, tight).unwrap();
    let rate = RADIUS_M / (TAU * TURNS);
    let (mut theta, mut q) = (0.0, vec![JointVector::new(0.0, 0.5, 0.0, 0.0, 1.0, 0.0)]);
    while theta < TAU * (TURNS + 1.0) {
        let r = (rate * theta).min(RADIUS_M);
        let (s, c) = trig::sin_cos(theta);
        let (x, y) = (rho + r * c, r * s);
        let turned = UnitQuaternion::new(Vector3::z() * trig::atan2(y, x));
        let down = turned * UnitQuaternion::new(Vector3::y() * (PI + tilt((x * x + y * y).sqrt())));
        let pose = Isometry3::from_parts(Vector3::new(x, y, 0.03).into(), down);
        q.push(solver.solve(&pose, q.last().unwrap()).unwrap().q);
        let (length, curvature) = if r < RADIUS_M {
            let length = (r * r + rate * rate).sqrt();
            (length, (r * r + 2.0 * rate * rate) / (length * length * length))
        } else {
            (RADIUS_M, 1.0 / RADIUS_M)
        };
        theta += 0.25f64.min((4.0 / curvature).sqrt()) * DT / length;
    }
    q.remove(0);
    let n = q.len();
    let speed = |k: usize| match k {
        0 => (q[1] * 4.0 - q[2] - q[0] * 3.0) / (2.0 * DT),
        _ if k + 1 == n => (q[k] - q[k - 1]) / DT,
        _ => (q[k + 1] - q[k - 1]) / (2.0 * DT),
    };
    let mut plan = plan.clone();
    plan.knots.t_s = (0..n).map(|k| k as f64 * DT).collect();
    plan.knots.qd_rad_s = (0..n).map(speed).collect();
    let end = plan.knots.t_s[n - 1];
    let part = |kind, t_start_s, t_end_s| PlanSegment {
        kind,
        plate: 0,
        t_start_s,
        t_end_s,
    };
    plan.segments = vec![
        part(SegmentKind::Approach, 0.0, SETTLED_S),
        part(SegmentKind::Wash, SETTLED_S, end),
    ];
    plan.knots.q_rad = q;
    plan
}

#[test]
fn the_gains_are_those_of_the_table() {
    let (robot, plan) = frame();
    let model = DynamicsModel::new(&robot, Some(&plan.job.workcell.tool)).unwrap();
    let kp = model.largest_inertias(robot.limits()) * 900.0;
    let stated = [1036.0, 1027.0, 222.0, 12.3, 9.8, 1.4];
    for (joint, stated) in stated.into_iter().enumerate() {
        assert!(
            (kp[joint] / stated - 1.0).abs() < 0.006,
            "joint {}: {} against {stated}",
            joint + 1,
            kp[joint]
        );
    }
}

#[test]
fn the_table_is_reproduced() {
    let (robot, plan) = frame();
    let strokes = DISTANCES_M.map(|rho| stroke(&robot, &plan, rho));
    for (law, table, share) in [
        (ControlLawName::Pd, PD, 0.15),
        (ControlLawName::PdGravity, PD_GRAVITY, 0.10),
        (ControlLawName::ComputedTorque, COMPUTED_TORQUE, 0.10),
    ] {
        for (frequency, row) in FREQUENCIES.into_iter().zip(table) {
            for (plan, stated) in strokes.iter().zip(row) {
                let mut settings = plan.job.simulation.clone();
                settings.law = law;
                settings.control.frequency_rad_s = frequency;
                let execution = simulate(plan, &robot, &settings).unwrap();
                let report = SimulationReport::new(plan, &robot, &settings, &execution).unwrap();
                let found = 1e3 * report.segments[1].tracking.tip_m.rms;
                println!("{} at {frequency} rad/s: {found:.3} mm, table {stated} mm", law.name());
                let off = (found - stated).abs();
                assert!(
                    off < (share * stated).max(0.02),
                    "{} at {frequency} rad/s: {found} mm, not {stated}",
                    law.name()
                );
            }
        }
    }
}

/// The paper's Kp = 20, Kd = 0.1, taken as torque gains: stable, and far too weak to hold the arm up.
#[test]
fn the_papers_gains_as_torque_gains_let_the_arm_collapse() {
    let (robot, plan) = frame();
    for rho in DISTANCES_M {
        let plan = stroke(&robot, &plan, rho);
        let mut settings = plan.job.simulation.clone();
        settings.law = ControlLawName::Pd;
        (settings.control.joint_kp, settings.control.joint_kd) = (Some([20.0; 6]), Some([0.1; 6]));
        let execution = simulate(&plan, &robot, &settings).unwrap();
        let report = SimulationReport::new(&plan, &robot, &settings, &execution).unwrap();
        let rms = report.tracking.tip_m.rms;
        println!("Kp 20, Kd 0.1 at {rho} m: {rms:.3} m rms");
        assert!((0.25..0.6).contains(&rms), "{rms} m at {rho} m");
        assert_eq!(report.plates[0].verdict, PlateVerdict::NotSwept);
    }
}
