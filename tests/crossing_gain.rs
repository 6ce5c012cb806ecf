//! What better crossings gain over the paper's: an arc round the base with a stop at every waypoint, under the same limits.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, missing_docs)]

use nalgebra::Vector3;
use platewash::kinematics::ik::{IkSettings, IkSolver};
use platewash::planner::joint_path::{Ends, JointPath};
use platewash::planner::posture::{Cell, TiltPolicy};
use platewash::planner::timing::{self, MotionLimits, TipLimits};
use platewash::planner::tool_path::{Segment, SegmentKind, Shape};
use platewash::workcell::arc;
use platewash::workcell::clearance::ClearanceModel;
use platewash::workcell::tool::tip_frame;
use platewash::{Cycle, Scenario};

/// Samples of one straight stretch between two waypoints of the arc.
const SAMPLES: usize = 40;

/// Where the tip touches a plate last, and the next one first.
fn contacts(tool_path: &[Segment]) -> Vec<[Vector3<f64>; 2]> {
    let feet = tool_path
        .iter()
        .filter_map(|segment| match (segment.kind, &segment.shape) {
            (SegmentKind::Retreat | SegmentKind::Approach, Shape::Line { foot_m, .. }) => Some(Vector3::from(*foot_m)),
            _ => None,
        });
    let feet: Vec<_> = feet.collect();
    feet[1..feet.len() - 1]
        .chunks(2)
        .map(|pair| [pair[0], pair[1]])
        .collect()
}

/// Time of the paper's crossings: cubics at rest at every waypoint are straight lines, each as fast as the limits let it be.
fn paper_s(cycle: &Cycle, scenario: &Scenario) -> f64 {
    let (robot, limits) = (&cycle.robot, &scenario.limits);
    let tip = tip_frame(robot, &scenario.tool);
    let model = ClearanceModel::new(robot, &scenario.tool, &cycle.layout.plates).unwrap();
    let cell = Cell::new(robot, &scenario.tool, &model, &cycle.layout.plates).unwrap();
    let solver = IkSolver::new(robot, tip, IkSettings::default()).unwrap();
    let policy = TiltPolicy::upright(scenario.wash.tilt_max_deg.to_radians());
    let pose = |p: Vector3<f64>| cell.tip_pose(p, policy.tilt(cell.distance(&p)));
    let limits = MotionLimits {
        velocity: robot.limits().velocity,
        acceleration: limits.joint_acceleration_rad_s2.into(),
        tip: Some(TipLimits {
            speed_m_s: limits.tip_speed_m_s,
            acceleration_m_s2: limits.tip_acceleration_m_s2,
        }),
    };
    let stretch = |from: Vector3<f64>, to: Vector3<f64>| {
        let share = |k: usize| k as f64 / (SAMPLES - 1) as f64;
        let poses: Vec<_> = (0..SAMPLES).map(|k| pose(from + (to - from) * share(k))).collect();
        let q = solver.solve_path(&poses, &scenario.homes()[0]).unwrap().q;
        let path = JointPath::through((0..SAMPLES).map(share).collect(), q, Ends::NotAKnot).unwrap();
        timing::time_optimal(&path, robot, &tip, &limits)
            .unwrap()
            .motion
            .duration_s()
    };
    let crossing = |[from, to]: [Vector3<f64>; 2]| {
        let points = arc::waypoints(from, to, &scenario.arc());
        points.windows(2).map(|ends| stretch(ends[0], ends[1])).sum::<f64>()
    };
    contacts(&cycle.tool_path).into_iter().map(crossing).sum()
}

#[test]
fn crossings_take_at_most_six_tenths_of_the_papers() {
    let (mut ours, mut papers, mut cycles) = (0.0, 0.0, 0.0);
    for seed in 1..=20 {
        let scenario = Scenario {
            seed,
            ..Scenario::load("kitchen").unwrap()
        };
        let cycle = Cycle::plan(&scenario).unwrap();
        let between = &cycle.crossings[1..cycle.crossings.len() - 1];
        let (own, paper): (f64, f64) = (between.iter().map(|c| c.duration_s).sum(), paper_s(&cycle, &scenario));
        assert!(own <= 0.6 * paper, "seed {seed}: {own:.2} s against {paper:.2} s");
        ours += own;
        papers += paper;
        cycles += cycle.motion.duration_s();
    }
    println!(
        "crossings {ours:.1} s, the paper's {papers:.1} s: {:.1} % less; whole cycles {cycles:.1} s: {:.1} % less",
        100.0 * (1.0 - ours / papers),
        100.0 * (1.0 - cycles / (cycles - ours + papers)),
    );
}
