//! What better transits gain over the paper's: an arc round the base with a stop at every waypoint, under the same limits.

use nalgebra::Vector3;
use platewash::planner::joint_path::{Ends, JointPath};
use platewash::planner::placed_arm::{Contact, PlacedArm, TiltPolicy};
use platewash::planner::timing::{self, MotionLimits, TipLimits};
use platewash::workcell::arc;
use platewash::{ClearanceModel, IkSettings, IkSolver, Plan, RobotModel, Scenario, plan};
use platewash_fixtures::is_thorough;

/// Samples of one straight stretch between two waypoints of the arc.
const SAMPLES: usize = 40;

/// Where the tip touches a plate last, and the next one first.
fn contacts(plan: &Plan) -> Vec<[Vector3<f64>; 2]> {
    let feet = |k: usize| {
        let path = &plan.wash_paths[k];
        path.feet(&plan.job.plates[path.plate])
    };
    (1..plan.wash_paths.len())
        .map(|k| [feet(k - 1)[1], feet(k)[0]])
        .collect()
}

/// Time of the paper's transits: cubics at rest at every waypoint are straight lines, each as fast as the limits let it be.
fn paper_s(plan: &Plan, robot: &RobotModel) -> f64 {
    let job = &plan.job;
    let (tool, settings) = (&job.workcell.tool, job.planner_settings().unwrap());
    let tip = tool.tip_frame(robot);
    let model = ClearanceModel::new(robot, &job.workcell, &job.plates).unwrap();
    let placed = PlacedArm::new(robot, tool, &model, &job.plates, settings.reach).unwrap();
    let solver = IkSolver::new(robot, tip, IkSettings::default()).unwrap();
    let policy = TiltPolicy::upright(job.requirements.tilt_rad, &settings.reach);
    let pose = |p: Vector3<f64>| placed.pose(&Contact::level(p), &policy);
    let limits = MotionLimits {
        velocity: robot.limits().velocity,
        acceleration: job.limits.joint_acceleration_rad_s2.into(),
        tip: Some(TipLimits {
            speed_m_s: job.limits.tip_speed_m_s,
            acceleration_m_s2: job.limits.tip_acceleration_m_s2,
        }),
    };
    let stretch = |from: Vector3<f64>, to: Vector3<f64>| {
        let share = |k: usize| k as f64 / (SAMPLES - 1) as f64;
        let poses: Vec<_> = (0..SAMPLES).map(|k| pose(from + (to - from) * share(k))).collect();
        let q = solver.solve_path(&poses, &job.home_rad[0]).unwrap().q;
        let path = JointPath::through((0..SAMPLES).map(share).collect(), q, Ends::NotAKnot).unwrap();
        let timed = timing::time_optimal(&path, robot, &tip, &limits).unwrap();
        timed.motion.duration_s()
    };
    let transit = |[from, to]: [Vector3<f64>; 2]| {
        let points = arc::waypoints(from, to, &settings.arc);
        points.windows(2).map(|ends| stretch(ends[0], ends[1])).sum::<f64>()
    };
    contacts(plan).into_iter().map(transit).sum()
}

#[test]
fn transits_take_at_most_six_tenths_of_the_papers() {
    let (mut ours, mut papers, mut motions) = (0.0, 0.0, 0.0);
    for seed in 1..=if is_thorough() { 20 } else { 5 } {
        let scenario = Scenario {
            seed,
            ..Scenario::load("kitchen-spiral").unwrap()
        };
        let job = scenario.job().unwrap();
        let planned = plan(&job).unwrap();
        let between = &planned.transits[1..planned.transits.len() - 1];
        let own: f64 = between.iter().map(|transit| transit.duration_s).sum();
        let paper = paper_s(&planned.plan, job.arm());
        assert!(own <= 0.6 * paper, "seed {seed}: {own:.2} s against {paper:.2} s");
        ours += own;
        papers += paper;
        motions += planned.plan.duration_s();
    }
    println!(
        "transits {ours:.1} s, the paper's {papers:.1} s: {:.1} % less; whole motions {motions:.1} s: {:.1} % less",
        100.0 * (1.0 - ours / papers),
        100.0 * (1.0 - motions / (motions - ours + papers)),
    );
}
