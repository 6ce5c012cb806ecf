//! Crossings among made-up obstacles: each route is needed once, and is really free.

use super::*;
use crate::timing::MotionLimits;
use nalgebra::Vector3;
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{Frame, JointVector, Pose, RobotModel};
use platewash_workcell::arc::Arc;
use platewash_workcell::random;

struct Set {
    robot: RobotModel,
    tip: Frame,
    limits: MotionLimits,
}

fn set() -> Set {
    let robot = RobotModel::irb120().unwrap();
    let limits = MotionLimits {
        velocity: robot.limits().velocity,
        acceleration: JointVector::new(4.0, 4.0, 4.0, 5.0, 5.0, 6.0),
        tip: None,
    };
    let tip = robot.mounting_frame();
    Set { robot, tip, limits }
}

fn down(place: Vector3<f64>) -> Pose {
    platewash_workcell::tool::tool_down(place)
}

/// The line over a place on the circle of radius 0.38 m, with the tool straight down.
fn line(set: &Set, plate: usize, azimuth: f64) -> Terminal {
    let solver = IkSolver::new(&set.robot, set.tip, IkSettings::default()).unwrap();
    let foot = Vector3::new(0.38 * azimuth.cos(), 0.38 * azimuth.sin(), 0.2);
    let heights: Vec<f64> = (0..=15).map(|k| 2e-3 * f64::from(k)).collect();
    let poses: Vec<_> = heights.iter().map(|h| down(foot + Vector3::z() * *h)).collect();
    let seed = JointVector::new(azimuth, 0.3, 0.2, 0.0, 1.0, azimuth);
    Terminal::line(plate, heights, solver.solve_path(&poses, &seed).unwrap().q).unwrap()
}

fn plan_among(
    set: &Set,
    keeps_clear: &dyn Fn(&JointVector, Stage) -> bool,
    arc: Option<f64>,
) -> Result<Crossing, CrossingError> {
    let solver = IkSolver::new(&set.robot, set.tip, IkSettings::default()).unwrap();
    let pose = down;
    let arc = arc.map(|height_m| PaperArc {
        arc: Arc {
            points: 5,
            radius_m: 0.35,
            height_m,
        },
        solver: &solver,
        pose: &pose,
    });
    let scene = Scene {
        robot: &set.robot,
        tip: &set.tip,
        keeps_clear,
        too_near: &|_, _| None,
        limits: &set.limits,
        arc: arc.as_ref(),
    };
    let crossing = plan(
        &scene,
        &line(set, 0, -0.7),
        &line(set, 1, 0.9),
        &mut random::stream(1, "crossing"),
    )?;
    check(set, &crossing, keeps_clear);
    Ok(crossing)
}

/// From rest to rest, within limits, and free at a hundred times more places than the planner looked at.
fn check(set: &Set, crossing: &Crossing, keeps_clear: &dyn Fn(&JointVector, Stage) -> bool) {
    let motion = &crossing.timed.motion;
    let (start, end) = (motion.at(0.0).unwrap(), motion.at(motion.duration_s()).unwrap());
    assert!(start.qd.amax() < 1e-12 && end.qd.amax() < 1e-9);
    assert!((start.q - line(set, 0, -0.7).rest()).amax() < 1e-9);
    assert!((end.q - line(set, 1, 0.9).rest()).amax() < 1e-9);
    let knot = |u: f64| crossing.timed.parameters.iter().position(|p| *p >= u).unwrap();
    let [from, to] = crossing.free.map(|u| motion.times()[knot(u)]);
    for k in 0..=5000 {
        let q = motion.at(from + (to - from) * f64::from(k) / 5000.0).unwrap().q;
        assert!(set.robot.limits().contain(&q));
        assert!(keeps_clear(&q, Stage::Free), "{:?} at {q}", crossing.route);
    }
}

#[test]
fn the_direct_way_is_taken_where_it_is_free() {
    let set = set();
    let crossing = plan_among(&set, &|_, _| true, Some(0.3)).unwrap();
    assert_eq!(crossing.route, Route::Direct);
}

#[test]
fn joint_2_is_drawn_back_where_only_that_helps() {
    let set = set();
    let top = *line(&set, 0, -0.7).top();
    let drawn_back = |q: &JointVector, _: Stage| q[0].abs() > 0.1 || q[1] < top[1] - 0.4 && (q[2] - top[2]).abs() < 0.1;
    let crossing = plan_among(&set, &drawn_back, None).unwrap();
    assert_eq!(crossing.route, Route::Raised);
}

#[test]
fn the_papers_arc_stands_in_where_the_joints_ways_are_blocked() {
    let set = set();
    // A tunnel about the arc.
    let tunnel = |q: &JointVector, _: Stage| {
        let tip = set.robot.fk(q).rigid(&set.tip).translation;
        tip.y.abs() > 0.12 || (tip.xy().norm() - 0.35).abs() < 0.012 && (tip.z - 0.22).abs() < 0.012
    };
    let crossing = plan_among(&set, &tunnel, Some(0.22)).unwrap();
    assert_eq!(crossing.route, Route::Arc);
}

#[test]
fn a_window_among_the_joints_is_found_by_sampling() {
    let set = set();
    let window = |q: &JointVector, _: Stage| q[0].abs() > 0.1 || q[2] < -0.6 && q[2] > -1.2;
    let crossing = plan_among(&set, &window, None).unwrap();
    assert_eq!(crossing.route, Route::Sampled);
    // From its own seeded stream: the same again.
    assert_eq!(plan_among(&set, &window, None).unwrap(), crossing);
}

#[test]
fn what_cannot_be_crossed_is_named() {
    let set = set();
    let blocked = |q: &JointVector, _: Stage| q[0].abs() > 0.1;
    let error = plan_among(&set, &blocked, Some(0.3)).unwrap_err();
    assert!(
        matches!(
            error,
            CrossingError::NoWay {
                from: Some(0),
                to: Some(1),
                ..
            }
        ),
        "{error}"
    );
    let over_plate = |q: &JointVector, stage: Stage| stage == Stage::Free || q[0] < 0.0;
    let error = plan_among(&set, &over_plate, None).unwrap_err();
    assert!(matches!(error, CrossingError::Line { plate: 1, .. }), "{error}");
}
