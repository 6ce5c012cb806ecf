//! A washing that no planner made: two plates of the kitchen, the tool upright, each stretch at rest at both ends.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_fixtures::{kitchen_plates, kitchen_terms};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, Pose, RobotModel, trig};
use platewash_motion::plan::{Knots, Plan, PlanParts, Provenance};
use platewash_motion::trajectory::{PlanSegment, SegmentKind};
use platewash_simulator::{Execution, SimulationReport, simulate};
use platewash_workcell::job::JobTerms;
use platewash_workcell::plate::Plate;
use platewash_workcell::simulation::{ControlLawName, SimulationSettings};
use platewash_workcell::tool::tool_down;
use platewash_workcell::wash_path::{WashCurve, WashPath, WashPattern};
use std::f64::consts::TAU;
use std::sync::OnceLock;

/// Time between knots where the tip follows a line \[s\].
const DT_S: f64 = 0.01;

/// The arm and the plan, made once.
pub fn planned() -> &'static (RobotModel, Plan) {
    static PLANNED: OnceLock<(RobotModel, Plan)> = OnceLock::new();
    PLANNED.get_or_init(plan)
}

/// The plan's settings, under a law of that stiffness \[rad/s\].
pub fn under(law: ControlLawName, frequency: f64) -> SimulationSettings {
    let mut settings = planned().1.job.simulation.clone();
    settings.law = law;
    settings.control.frequency_rad_s = frequency;
    settings
}

/// What the plan comes to, and what is said of it.
pub fn judged(settings: &SimulationSettings) -> (Execution, SimulationReport) {
    let (robot, plan) = planned();
    let execution = simulate(plan, robot, settings).unwrap();
    let report = SimulationReport::new(plan, robot, settings, &execution).unwrap();
    (execution, report)
}

/// The arm and a plan that washes two plates.
fn plan() -> (RobotModel, Plan) {
    let robot = RobotModel::irb120().unwrap();
    let plates = kitchen_plates()[..2].to_vec();
    let terms = kitchen_terms(&robot, plates);
    let parts = Builder::new(&robot, &terms).wash_all();
    (robot, Plan::sealed(terms, parts).unwrap())
}

/// The wash path of the kitchen.
fn wash_path(terms: &JobTerms, plate: usize) -> WashPath {
    let settings = terms.planner_settings().unwrap();
    let [x, y] = terms.plates[plate].centre_xy();
    WashPath {
        plate,
        curve: WashCurve {
            radius_m: settings.path_radius_m.unwrap(),
            turns: settings.turns.unwrap(),
            start_angle_rad: trig::atan2(y, x),
            closing_ring: settings.closing_ring.unwrap(),
            trim_rad: 0.0,
            pattern: WashPattern::Spiral,
        },
        lift_m: settings.lift_m,
        cone_rad: terms.tilt_max_rad(),
    }
}

/// A share of the way at a share of the time, slow at both ends.
fn eased(share: f64) -> f64 {
    share * share * (3.0 - 2.0 * share)
}

/// A motion that grows stretch by stretch.
struct Builder<'a> {
    terms: &'a JobTerms,
    solver: IkSolver<'a>,
    knots: Knots,
    segments: Vec<PlanSegment>,
}

impl<'a> Builder<'a> {
    fn new(robot: &'a RobotModel, terms: &'a JobTerms) -> Self {
        let tight = IkSettings {
            position_tolerance_m: 1e-11,
            orientation_tolerance_rad: 1e-11,
            ..IkSettings::default()
        };
        Self {
            terms,
            solver: IkSolver::new(robot, terms.workcell.tool.tip_frame(robot), tight).unwrap(),
            knots: Knots {
                t_s: vec![0.0],
                q_rad: vec![terms.home_rad[0]],
                qd_rad_s: vec![JointVector::zeros()],
            },
            segments: Vec::new(),
        }
    }

    fn wash_all(mut self) -> PlanParts {
        let plates = &self.terms.plates;
        let wash_paths: Vec<_> = (0..plates.len()).map(|plate| wash_path(self.terms, plate)).collect();
        for path in &wash_paths {
            let kind = match path.plate {
                0 => SegmentKind::Depart,
                _ => SegmentKind::Transit,
            };
            self.wash(kind, path, &plates[path.plate]);
        }
        let last = plates.len() - 1;
        self.turn_to(self.terms.home_rad[1]);
        self.ends(SegmentKind::Return, last);
        PlanParts {
            provenance: Provenance::new("two plates"),
            order: (0..plates.len()).collect(),
            wash_paths,
            segments: self.segments,
            knots: self.knots,
        }
    }

    fn wash(&mut self, there: SegmentKind, path: &WashPath, plate: &Plate) {
        let [first, last] = path.feet(plate);
        let up = plate.axis() * path.lift_m;
        let above = self.reach(&(first + up));
        self.turn_to(above);
        self.ends(there, path.plate);
        self.follow(1.0, |share| first + up * (1.0 - share));
        self.ends(SegmentKind::Approach, path.plate);
        // θ goes with the square root of the length, so that the tip is as fast near the centre as at the rim.
        let (spiral, end) = (path.curve.spiral_end(), path.curve.end());
        let lengths = [0.5 * spiral, end - spiral];
        let share_of_spiral = lengths[0] / (lengths[0] + lengths[1]);
        self.follow(14.0, |share| {
            let theta = if share < share_of_spiral {
                spiral * (share / share_of_spiral).sqrt()
            } else {
                spiral + (share - share_of_spiral) / (1.0 - share_of_spiral) * TAU
            };
            path.contact(plate, theta.min(end))
        });
        self.ends(SegmentKind::Wash, path.plate);
        self.follow(1.0, |share| last + up * share);
        self.ends(SegmentKind::Retreat, path.plate);
    }

    /// Straight in joint space, 3 s long.
    fn turn_to(&mut self, q: JointVector) {
        self.knots.t_s.push(self.now_s() + 3.0);
        self.knots.q_rad.push(q);
        self.knots.qd_rad_s.push(JointVector::zeros());
    }

    /// The tip along a line, eased.
    fn follow(&mut self, duration_s: f64, line: impl Fn(f64) -> Vector3<f64>) {
        let (start_s, steps) = (self.now_s(), (duration_s / DT_S).round() as usize);
        let from = self.knots.q_rad.len() - 1;
        for k in 1..=steps {
            let share = k as f64 / steps as f64;
            let q = self.reach(&line(eased(share)));
            self.knots.t_s.push(start_s + duration_s * share);
            self.knots.q_rad.push(q);
        }
        let q = &self.knots.q_rad;
        let speeds = (from + 1..q.len() - 1).map(|k| (q[k + 1] - q[k - 1]) / (2.0 * DT_S));
        let speeds: Vec<_> = speeds.chain([JointVector::zeros()]).collect();
        self.knots.qd_rad_s.extend(speeds);
    }

    /// The arm with the tip there, the tool straight down and turned with the arm's first axis.
    fn reach(&self, tip: &Vector3<f64>) -> JointVector {
        let near = self.knots.q_rad[self.knots.q_rad.len() - 1];
        let turned = UnitQuaternion::new(Vector3::z() * trig::atan2(tip.y, tip.x));
        let down = turned * tool_down(*tip).rotation;
        let pose = Pose::from_parts((*tip).into(), down);
        self.solver.solve(&pose, &near).unwrap().q
    }

    fn now_s(&self) -> f64 {
        self.knots.t_s[self.knots.t_s.len() - 1]
    }

    fn ends(&mut self, kind: SegmentKind, plate: usize) {
        let segment = PlanSegment {
            kind,
            plate,
            t_start_s: self.segments.last().map_or(0.0, |before| before.t_end_s),
            t_end_s: self.now_s(),
        };
        self.segments.push(segment);
    }
}
