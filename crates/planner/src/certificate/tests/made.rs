//! A small planner for tests: inverse kinematics along the declared path, straight joint motions between, slow timing.

use crate::certificate::summary;
use crate::plan::{Plan, PlanParts, PlanSegment, Summary};
use crate::scenario::Scenario;
use crate::tool_path::{Segment, SegmentKind, Shape};
use nalgebra::{UnitQuaternion, Vector3};
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::layout::Plate;
use platewash_workcell::stroke::Stroke;
use platewash_workcell::tool::tool_down;
use platewash_workcell::trajectory::Trajectory;
use std::sync::OnceLock;

/// Time between knots \[s\].
const STEP_S: f64 = 0.012;

/// What a test may change before planning.
#[derive(Clone)]
pub struct Recipe {
    pub scenario: Scenario,
    pub order: Vec<usize>,
    /// Forward lean of the tool while it is at a plate \[rad\].
    pub lean: f64,
    /// Share of the wash limits that is used.
    pub pace: f64,
    pub start_angle_rad: f64,
}

impl Recipe {
    /// Plates on an arc of radius 0.37 m about the base.
    pub fn arc(azimuths_deg: &[f64]) -> Self {
        let places: Vec<_> = azimuths_deg
            .iter()
            .map(|a| [0.37 * a.to_radians().cos(), 0.37 * a.to_radians().sin()])
            .collect();
        let mut scenario = Scenario::parse("[layout]\nregion = \"appendix\"\n", "made").unwrap();
        scenario.layout.region = None;
        scenario.layout.positions_m = Some(places.clone());
        scenario.tool.length_m = 0.15;
        scenario.robot.start_deg = [0.0, 0.0, 10.0, 0.0, 70.0, 0.0];
        scenario.job.required_coverage = 0.995;
        scenario.limits.joint_acceleration_rad_s2 = [8.0; 6];
        let wash = &mut scenario.wash;
        (wash.path_radius_m, wash.turns, wash.closing_ring) = (0.123, 3.5, true);
        (wash.height_m, wash.clearance_m, wash.lift_m) = (0.0, 0.01, 0.05);
        Self {
            scenario,
            order: (0..places.len()).collect(),
            lean: 0.0,
            pace: 0.5,
            start_angle_rad: 0.3,
        }
    }

    pub fn plan(&self) -> Plan {
        Maker::new(self).plan()
    }
}

/// The plan that most tests start from: two plates, planned once.
pub fn good() -> Plan {
    static GOOD: OnceLock<Plan> = OnceLock::new();
    GOOD.get_or_init(|| Recipe::arc(&[-35.0, 30.0]).plan()).clone()
}

pub fn irb120() -> RobotModel {
    RobotModel::irb120().unwrap()
}

/// With the summary that follows from it, unless that was edited too, and sealed again, as whoever edits a plan would.
pub fn restated(mut plan: Plan) -> Plan {
    if plan.summary == good().summary {
        plan.summary = summary(&plan, &irb120());
    }
    resealed(plan)
}

/// Sealed again.
pub fn resealed(mut plan: Plan) -> Plan {
    plan.hash = Some(plan.seal().unwrap());
    plan
}

struct Maker<'a> {
    recipe: &'a Recipe,
    robot: RobotModel,
    plates: Vec<Plate>,
    q: Vec<JointVector>,
    /// Knots at which the arm rests.
    rests: Vec<usize>,
    marks: Vec<(SegmentKind, usize, usize)>,
    path: Vec<Segment>,
}

impl<'a> Maker<'a> {
    fn new(recipe: &'a Recipe) -> Self {
        let layout = &recipe.scenario.layout;
        let plate = |[x_m, y_m]: [f64; 2]| Plate {
            x_m,
            y_m,
            z_m: layout.plate_height_m,
            radius_m: layout.plate_radius_m,
            thickness_m: layout.plate_thickness_m,
        };
        Self {
            recipe,
            robot: irb120(),
            plates: layout.positions_m.clone().unwrap().into_iter().map(plate).collect(),
            q: vec![recipe.scenario.homes()[0]],
            rests: vec![0],
            marks: Vec::new(),
            path: Vec::new(),
        }
    }

    fn plan(mut self) -> Plan {
        let wash = self.recipe.scenario.wash.clone();
        let stroke = Stroke {
            radius_m: wash.path_radius_m,
            turns: wash.turns,
            start_angle_rad: self.recipe.start_angle_rad,
            closing_ring: wash.closing_ring,
        };
        let up = Vector3::z() * wash.lift_m;
        for (i, plate) in self.recipe.order.clone().into_iter().enumerate() {
            let p = self.plates[plate];
            let centre = Vector3::new(p.x_m, p.y_m, p.z_m + wash.height_m);
            let on = |theta: f64| centre + stroke.at(theta).position.push(0.0);
            let line = |foot: Vector3<f64>| Shape::Line {
                foot_m: foot.into(),
                normal: [0.0, 0.0, 1.0],
                height_m: wash.lift_m,
            };
            let (start, end) = (on(0.0), on(stroke.end()));
            let down: Vec<_> = shares(0.9).map(|s| start + up * (1.0 - s)).collect();
            let seed = self.reach(&down[0]);
            let kind = if i == 0 {
                SegmentKind::Depart
            } else {
                SegmentKind::Transition
            };
            self.go(kind, plate, seed);
            self.follow(SegmentKind::Approach, plate, line(start), &down);
            let points = pace(
                &stroke,
                wash.speed_m_s * self.recipe.pace,
                wash.acceleration_m_s2 * self.recipe.pace,
            );
            let shape = Shape::Stroke {
                centre_m: centre.into(),
                normal: [0.0, 0.0, 1.0],
                stroke,
            };
            self.follow(
                SegmentKind::Wash,
                plate,
                shape,
                &points.into_iter().map(on).collect::<Vec<_>>(),
            );
            let lift: Vec<_> = shares(0.9).map(|s| end + up * s).collect();
            self.follow(SegmentKind::Retreat, plate, line(end), &lift);
        }
        self.go(
            SegmentKind::Return,
            *self.recipe.order.last().unwrap(),
            self.recipe.scenario.homes()[1],
        );
        self.seal()
    }

    /// A configuration for the tip at a place, the elbow up.
    fn reach(&self, place: &Vector3<f64>) -> JointVector {
        let turn = place.y.atan2(place.x);
        let seed = JointVector::new(turn, 0.4, 0.2, 0.0, 0.9, turn);
        self.solve(std::slice::from_ref(place), &seed)[0]
    }

    fn solve(&self, places: &[Vector3<f64>], seed: &JointVector) -> Vec<JointVector> {
        let tip = platewash_workcell::tool::tip_frame(&self.robot, &self.recipe.scenario.tool);
        let settings = IkSettings {
            position_tolerance_m: 1e-9,
            orientation_tolerance_rad: 1e-9,
            ..IkSettings::default()
        };
        let solver = IkSolver::new(&self.robot, tip, settings).unwrap();
        let target = |p: &Vector3<f64>| {
            let lean = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), self.recipe.lean);
            let down = tool_down(*p);
            Pose::from_parts(down.translation, lean * down.rotation)
        };
        let targets: Vec<_> = places.iter().map(target).collect();
        solver.solve_path(&targets, seed).unwrap().q
    }

    fn go(&mut self, kind: SegmentKind, plate: usize, to: JointVector) {
        let from = self.q[self.q.len() - 1];
        let seconds = 1.0 + 2.5 * (to - from).amax();
        self.q.extend(shares(seconds).skip(1).map(|s| from + (to - from) * s));
        self.mark(kind, plate, Shape::Free);
    }

    fn follow(&mut self, kind: SegmentKind, plate: usize, shape: Shape, places: &[Vector3<f64>]) {
        let q = self.solve(places, &self.q[self.q.len() - 1]);
        self.q.extend(&q[1..]);
        self.mark(kind, plate, shape);
    }

    fn mark(&mut self, kind: SegmentKind, plate: usize, shape: Shape) {
        self.marks.push((kind, plate, self.q.len() - 1));
        self.rests.push(self.q.len() - 1);
        self.path.push(Segment {
            kind,
            plate,
            shape,
            waypoints: Vec::new(),
        });
    }

    fn seal(self) -> Plan {
        let count = self.q.len();
        let time = |k: usize| k as f64 * STEP_S;
        // Differences of fourth order inside, of second next to a rest.
        let speed = |k: usize| match self.rests.binary_search(&k) {
            Ok(_) => JointVector::zeros(),
            Err(_) if self.rests.iter().any(|r| r.abs_diff(k) == 1) => (self.q[k + 1] - self.q[k - 1]) / (2.0 * STEP_S),
            Err(_) => ((self.q[k + 1] - self.q[k - 1]) * 8.0 - (self.q[k + 2] - self.q[k - 2])) / (12.0 * STEP_S),
        };
        let motion = Trajectory::from_knots(
            (0..count).map(time).collect(),
            self.q.clone(),
            (0..count).map(speed).collect(),
        )
        .unwrap();
        let mut start = 0.0;
        let mut segments = Vec::new();
        for &(kind, plate, knot) in &self.marks {
            let (t_start_s, t_end_s) = (start, time(knot));
            segments.push(PlanSegment {
                kind,
                plate,
                t_start_s,
                t_end_s,
            });
            start = t_end_s;
        }
        let model = ClearanceModel::new(&self.robot, &self.recipe.scenario.tool, &self.plates).unwrap();
        let pairs = model
            .pair_names()
            .into_iter()
            .map(|(a, b)| [a.to_owned(), b.to_owned()])
            .collect();
        let mut plan = Plan::open(PlanParts {
            scenario: &self.recipe.scenario,
            robot: &self.robot,
            plates: &self.plates,
            order: &self.recipe.order,
            tool_path: &self.path,
            segments,
            motion: &motion,
            clearance_pairs: pairs,
            summary: Summary::default(),
        });
        plan.summary = summary(&plan, &self.robot);
        resealed(plan)
    }
}

/// Shares of a way from rest to rest over some time: 10 s³ − 15 s⁴ + 6 s⁵.
fn shares(seconds: f64) -> impl Iterator<Item = f64> {
    let steps = (seconds / STEP_S).ceil() as usize;
    (0..=steps).map(move |k| {
        let s = k as f64 / steps as f64;
        s * s * s * (10.0 - 15.0 * s + 6.0 * s * s)
    })
}

/// θ at equal time steps, from rest to rest, with the tip's speed and acceleration within limits: the greatest speeds on a fine
/// grid by a pass forwards and one backwards.
fn pace(stroke: &Stroke, speed: f64, acceleration: f64) -> Vec<f64> {
    let n = 40_000;
    let grid: Vec<f64> = (0..=n).map(|k| stroke.end() * f64::from(k) / f64::from(n)).collect();
    let along = 0.5 * acceleration;
    let mut v: Vec<f64> = grid
        .iter()
        .map(|&theta| {
            let p = stroke.at(theta);
            let across = (p.first.x * p.second.y - p.first.y * p.second.x).abs();
            speed.min((along * p.first.norm().powi(3) / across).sqrt())
        })
        .collect();
    let length = |k: usize| stroke.at(grid[k]).first.norm() * (grid[k + 1] - grid[k]);
    let last = grid.len() - 1;
    (v[0], v[last]) = (0.0, 0.0);
    for k in 0..last {
        v[k + 1] = v[k + 1].min((v[k] * v[k] + 2.0 * along * length(k)).sqrt());
    }
    for k in (0..last).rev() {
        v[k] = v[k].min((v[k + 1] * v[k + 1] + 2.0 * along * length(k)).sqrt());
    }
    let mut t = vec![0.0];
    for k in 0..last {
        t.push(t[k] + 2.0 * length(k) / (v[k] + v[k + 1]));
    }
    let steps = (t[last] / STEP_S).ceil() as usize;
    let at = |time: f64| {
        let k = t.partition_point(|&x| x <= time).clamp(1, last);
        // Evenly accelerated between grid points, so that it starts and ends like √t.
        let (h, u) = (t[k] - t[k - 1], time - t[k - 1]);
        let way = v[k - 1] * u + 0.5 * (v[k] - v[k - 1]) / h * u * u;
        (grid[k - 1] + (grid[k] - grid[k - 1]) * way / length(k - 1)).min(stroke.end())
    };
    (0..=steps).map(|k| at(t[last] * k as f64 / steps as f64)).collect()
}
