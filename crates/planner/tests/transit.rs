//! Transits among made-up obstacles: each kind is needed once, and is really free.

use crate::redundancy::turns;
use nalgebra::Vector3;
use platewash_bodies::clearance::{ClearanceModel, PairClearance};
use platewash_fixtures::{kitchen_tool, workcell};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{Frame, JointVector, RobotModel};
use platewash_planner::placed_arm::{Contact, PlacedArm, Stretch, Surroundings, TiltPolicy};
use platewash_planner::timing::MotionLimits;
use platewash_planner::transit::{
    BaseArc, ClearanceShortfall, LiftLine, Transit, TransitError, TransitKind, TransitRules, plan,
};
use platewash_workcell::arc::Arc;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::job::ReachBorders;
use platewash_workcell::plate::Plate;
use platewash_workcell::random;
use platewash_workcell::tool::{StraightTool, Tool};
use std::f64::consts::TAU;
use std::fmt;

/// Check that a configuration is free on a stretch.
type FreeCheck<'a> = &'a (dyn Fn(&JointVector, Stretch) -> bool + Sync);

/// Obstacles that a rule says.
struct RuleObstacles<'a>(FreeCheck<'a>);

impl fmt::Debug for RuleObstacles<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("MadeUp")
    }
}

impl Surroundings for RuleObstacles<'_> {
    fn levels_kept(&self, q: &JointVector, stretch: Stretch, required_m: &[f64]) -> usize {
        if (self.0)(q, stretch) { required_m.len() } else { 0 }
    }

    fn too_near(&self, _: &JointVector, _: Stretch, _: f64) -> Option<PairClearance> {
        None
    }
}

struct Set {
    robot: RobotModel,
    /// Tip of an arm without a tool.
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
    let tip = robot.tool_mount(None).unwrap();
    Set { robot, tip, limits }
}

/// Does something among obstacles.
fn among<T>(set: &Set, free: FreeCheck<'_>, act: impl FnOnce(&PlacedArm<'_>) -> T) -> T {
    let tool = Tool::from(StraightTool::default());
    let obstacles = RuleObstacles(free);
    let placed = PlacedArm::new(&set.robot, &tool, &obstacles, &[], ReachBorders::IRB_120).unwrap();
    act(&placed)
}

/// The line over a place on the circle of radius 0.38 m, with the tool straight down.
fn line(set: &Set, plate: usize, azimuth: f64) -> LiftLine {
    among(set, &|_, _| true, |placed| {
        let foot = Contact::level(Vector3::new(0.38 * azimuth.cos(), 0.38 * azimuth.sin(), 0.2));
        let heights: Vec<f64> = (0..=15).map(|k| 2e-3 * f64::from(k)).collect();
        let poses: Vec<_> = heights.iter().map(|h| placed.tip_pose(&foot.raised(*h), 0.0)).collect();
        let seed = JointVector::new(azimuth, 0.3, 0.2, 0.0, 1.0, 0.0);
        let settings = IkSettings {
            position_tolerance_m: 1e-9,
            orientation_tolerance_rad: 1e-9,
            ..IkSettings::default()
        };
        let solver = IkSolver::new(placed.robot, placed.tip, settings).unwrap();
        LiftLine::line(plate, heights, solver.solve_path(&poses, &seed).unwrap().q).unwrap()
    })
}

fn plan_among(set: &Set, free: FreeCheck<'_>, arc: Option<f64>) -> Result<Transit, TransitError> {
    let arc = arc.map(|height_m| BaseArc {
        arc: Arc {
            points: 5,
            radius_m: 0.35,
            height_m,
        },
        policy: TiltPolicy::upright(0.0, &ReachBorders::IRB_120),
    });
    let transit = among(set, free, |placed| {
        let rules = TransitRules {
            placed,
            limits: &set.limits,
            clearance_m: 0.01,
            arc,
        };
        let ends = [line(set, 0, -0.7), line(set, 1, 0.9)];
        plan(&rules, &ends[0], &ends[1], &mut random::stream(1, "crossing"))
    })?;
    check(set, &transit, free);
    Ok(transit)
}

/// Checks a transit: from rest to rest, within limits, and free at a hundred times more places than the planner checks.
fn check(set: &Set, transit: &Transit, free: FreeCheck<'_>) {
    let motion = &transit.timed.motion;
    let (start, end) = (motion.at(0.0).unwrap(), motion.at(motion.duration_s()).unwrap());
    assert!(start.qd.amax() < 1e-12 && end.qd.amax() < 1e-9);
    assert!((start.q - line(set, 0, -0.7).rest()).amax() < 1e-9);
    assert!((end.q - line(set, 1, 0.9).rest()).amax() < 1e-9);
    let knot = |u: f64| transit.timed.parameters.iter().position(|p| *p >= u).unwrap();
    let [from, to] = transit.free.map(|u| motion.times()[knot(u)]);
    for k in 0..=5000 {
        let q = motion.at(from + (to - from) * f64::from(k) / 5000.0).unwrap().q;
        assert!(set.robot.limits().contain(&q));
        assert!(free(&q, Stretch::Free), "{:?} at {q}", transit.kind);
    }
}

#[test]
fn the_direct_transit_is_taken_where_it_is_free() {
    let set = set();
    let transit = plan_among(&set, &|_, _| true, Some(0.3)).unwrap();
    assert_eq!(transit.kind, TransitKind::Direct);
}

#[test]
fn joint_2_is_drawn_back_where_only_that_helps() {
    let set = set();
    let top = *line(&set, 0, -0.7).top();
    let drawn_back =
        |q: &JointVector, _: Stretch| q[0].abs() > 0.1 || q[1] < top[1] - 0.4 && (q[2] - top[2]).abs() < 0.1;
    let transit = plan_among(&set, &drawn_back, None).unwrap();
    assert_eq!(transit.kind, TransitKind::Raised);
}

#[test]
fn uses_the_arc_where_joint_motion_is_blocked() {
    let set = set();
    // A tunnel about the arc.
    let tunnel = |q: &JointVector, _: Stretch| {
        let tip = set.robot.fk(q).rigid(&set.tip).translation;
        tip.y.abs() > 0.12 || (tip.xy().norm() - 0.35).abs() < 0.012 && (tip.z - 0.22).abs() < 0.012
    };
    let transit = plan_among(&set, &tunnel, Some(0.22)).unwrap();
    assert_eq!(transit.kind, TransitKind::Arc);
}

#[test]
fn a_window_among_the_joints_is_found_by_sampling() {
    let set = set();
    let window = |q: &JointVector, _: Stretch| q[0].abs() > 0.1 || q[2] < -0.6 && q[2] > -1.2;
    let transit = plan_among(&set, &window, None).unwrap();
    assert_eq!(transit.kind, TransitKind::Sampled);
    // From its own seeded stream: the same again.
    assert_eq!(plan_among(&set, &window, None).unwrap(), transit);
}

/// With joints of many turns, all of them 12 turns from 0: samples lie where the motion is.
#[test]
fn a_window_is_found_by_sampling_far_from_0() {
    let by = JointVector::repeat(12.0 * TAU);
    let window = |q: &JointVector, _: Stretch| {
        let q = q - by;
        q[0].abs() > 0.1 || (-1.2..-0.6).contains(&q[2]) && q[3].abs() < 1.0 && q[5].abs() < 1.0
    };
    let ends = [line(&set(), 0, -0.7), line(&set(), 1, 0.9)].map(|line| LiftLine::home(line.top() + by));
    for robot in [turns::arm_between([-100.0, 100.0]), turns::continuous_arm()] {
        let set = Set { robot, ..set() };
        let transit = among(&set, &window, |placed| {
            let rules = TransitRules {
                placed,
                limits: &set.limits,
                clearance_m: 0.01,
                arc: None,
            };
            plan(&rules, &ends[0], &ends[1], &mut random::stream(1, "crossing"))
        });
        assert_eq!(transit.unwrap().kind, TransitKind::Sampled);
    }
}

#[test]
fn names_the_obstruction_of_a_transit() {
    let set = set();
    let blocked = |q: &JointVector, _: Stretch| q[0].abs() > 0.1;
    let error = plan_among(&set, &blocked, Some(0.3)).unwrap_err();
    assert!(
        matches!(
            error,
            TransitError::NotFound {
                from: Some(0),
                to: Some(1),
                ..
            }
        ),
        "{error}"
    );
    let over_plate = |q: &JointVector, stretch: Stretch| stretch == Stretch::Free || q[0] < 0.0;
    let error = plan_among(&set, &over_plate, None).unwrap_err();
    assert!(matches!(error, TransitError::Line { plate: 1, .. }), "{error}");
}

#[test]
fn a_cancelled_search_returns_no_transit() {
    let (set, cancel) = (set(), CancelToken::new());
    cancel.cancel();
    among(&set, &|_, _| true, |placed| {
        let placed = placed.clone().with_cancel(&cancel);
        let rules = TransitRules {
            placed: &placed,
            limits: &set.limits,
            clearance_m: 0.01,
            arc: None,
        };
        let ends = [line(&set, 0, -0.7), line(&set, 1, 0.9)];
        let given_up = plan(&rules, &ends[0], &ends[1], &mut random::stream(1, "crossing"));
        assert!(matches!(given_up, Err(TransitError::Cancelled(_))), "{given_up:?}");
    });
}

/// A plate whose surface is `gap` below the free sponge, under the tool that points straight down.
#[test]
fn names_the_pair_its_distance_and_the_required_clearance() {
    let robot = RobotModel::irb120().unwrap();
    let tool = kitchen_tool();
    let q = JointVector::new(0.0, 0.0, 0.0, 0.0, 90.0_f64.to_radians(), 0.0);
    let tip = robot.fk(&q).rigid(&tool.tip_frame(&robot)).translation;
    let free_m = tool.sponge.compression_m;
    let workcell = workcell(&robot, tool);
    for (gap, near) in [(0.0105, true), (0.0112, false)] {
        let plate = Plate::level_disc([tip.x, tip.y, tip.z - free_m - gap], 0.1, 0.02);
        let clearance = ClearanceModel::new(&robot, &workcell, &[plate]).unwrap();
        let found = ClearanceShortfall::at(&clearance, &q, Stretch::Free, 0.01);
        assert_eq!(found.is_some(), near);
        let at_plate = ClearanceShortfall::at(&clearance, &q, Stretch::AtPlate(0), 0.01);
        assert_eq!(at_plate, None, "the sponge may be near a plate");
        if let Some(found) = found {
            let message = found.to_string();
            for part in ["sponge", "plate 1", "10.50 mm", "11.00 mm", "1.00 mm in reserve"] {
                assert!(message.contains(part), "{message}");
            }
        }
    }
}
