//! A small planner for tests: inverse kinematics along the wash path, straight joint motions between, slow timing.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_fixtures::{kitchen_plate, kitchen_terms};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::ik::{IkSettings, IkSolver};
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_motion::plan::{Knots, Plan, PlanParts, Provenance};
use platewash_motion::trajectory::{PlanSegment, SegmentKind, Trajectory};
use platewash_workcell::job::{ContactRequirements, JobTerms};
use platewash_workcell::surface::Surface;
use platewash_workcell::tool::{StraightTool, Tool, tool_down};
use platewash_workcell::wash_path::{WashCurve, WashPath, WashPattern};
use platewash_workcell::{Obstacle, ObstacleShape};
use std::sync::OnceLock;

/// Time between knots \[s\].
const STEP_S: f64 = 0.012;

/// Parameters of a plan that a test may change before planning.
#[derive(Clone)]
pub struct Recipe {
    pub terms: JobTerms,
    pub curve: WashCurve,
    pub order: Vec<usize>,
    /// Forward lean of the tool while it is at a plate \[rad\].
    pub lean: f64,
    /// Share of the face's slope that the tool's axis has, radially.
    pub share: f64,
    /// Share of the wash limits that is used.
    pub pace: f64,
    /// Depth below the face that the tip reaches before a wash and after it \[m\].
    pub dips_m: [f64; 2],
}

impl Recipe {
    /// Plates on an arc of radius 0.37 m about the base.
    pub fn arc(azimuths_deg: &[f64]) -> Self {
        let place = |a: &f64| [0.37 * a.to_radians().cos(), 0.37 * a.to_radians().sin()];
        let plates: Vec<_> = azimuths_deg.iter().map(|a| kitchen_plate(place(a))).collect();
        let order = (0..plates.len()).collect();
        let mut terms = kitchen_terms(&irb120(), plates);
        terms.home_rad[0] = JointVector::new(0.0, 0.0, 10.0, 0.0, 70.0, 0.0).map(f64::to_radians);
        terms.home_rad[1] = terms.home_rad[0];
        terms.limits.joint_acceleration_rad_s2 = [8.0; 6];
        Self {
            terms,
            curve: WashCurve {
                radius_m: 0.123,
                turns: 3.5,
                start_angle_rad: 0.3,
                closing_ring: true,
                trim_rad: 0.0,
                pattern: WashPattern::Spiral,
            },
            order,
            lean: 0.0,
            share: 0.0,
            pace: 0.5,
            dips_m: [0.0; 2],
        }
    }

    /// One plate of a face of its own before the arm, washed with what the kitchen asks of contact.
    pub fn on(surface: Surface, [rho, height_m]: [f64; 2], curve: WashCurve) -> Self {
        let mut recipe = Self::arc(&[10.0]);
        let plate = &mut recipe.terms.plates[0];
        plate.surface = surface;
        plate.pose.translation.vector *= rho / 0.37;
        plate.pose.translation.z = 0.03;
        recipe.terms.workcell.tool = tool(|t| {
            t.sponge_height_m = height_m;
            t.sponge_stiffness_pa = Some([1.1e4, 4.4e4]);
        });
        recipe.terms.requirements.contact = Some(promise());
        (recipe.curve, recipe.share, recipe.pace) = (curve, 0.5, 0.9);
        recipe
    }

    /// Returns the wash path of a plate.
    pub fn path(&self, plate: usize) -> WashPath {
        WashPath {
            plate,
            curve: self.curve,
            lift_m: 0.05,
            cone_rad: self.terms.tilt_max_rad(),
        }
    }

    pub fn plan(&self) -> Plan {
        Maker::new(self).plan()
    }
}

/// Returns contact requirements as a job may have them.
pub fn promise() -> ContactRequirements {
    ContactRequirements {
        compression_m: 1e-3,
        height_error_m: 1e-3,
        share: 0.995,
        strain: 0.6,
        force_n: [1.0, 40.0],
        time_s: 0.1,
        time_share: 0.99,
        dose_pa_m: 50.0,
        dose_share: 0.99,
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

/// A tool like the kitchen's.
pub fn tool(change: impl FnOnce(&mut StraightTool)) -> Tool {
    let mut straight = StraightTool {
        length_m: 0.15,
        ..StraightTool::default()
    };
    change(&mut straight);
    Tool::from(straight)
}

/// A slim obstacle that stands on the floor before the arm.
pub fn post(name: &str) -> Obstacle {
    let shape = Shape::Cylinder {
        radius_m: 0.02,
        half_length_m: 0.3,
    };
    Obstacle::new(name, ObstacleShape::Convex(shape), Pose::translation(0.4, 0.0, 0.3))
}

/// Sealed again.
pub fn resealed(mut plan: Plan) -> Plan {
    plan.hash = Some(plan.seal().unwrap());
    plan
}

/// A place of the tip, and the normal of the face there.
type Place = (Vector3<f64>, Vector3<f64>);

struct Maker<'a> {
    recipe: &'a Recipe,
    robot: RobotModel,
    q: Vec<JointVector>,
    /// Knots at which the arm rests.
    rests: Vec<usize>,
    marks: Vec<(SegmentKind, usize, usize)>,
}

impl<'a> Maker<'a> {
    fn new(recipe: &'a Recipe) -> Self {
        Self {
            recipe,
            robot: irb120(),
            q: vec![recipe.terms.home_rad[0]],
            rests: vec![0],
            marks: Vec::new(),
        }
    }

    fn plan(mut self) -> Plan {
        let terms = &self.recipe.terms;
        let wanted = terms.requirements;
        let pace = [wanted.wash_speed_m_s, wanted.wash_acceleration_m_s2].map(|limit| limit * self.recipe.pace);
        for (i, index) in self.recipe.order.clone().into_iter().enumerate() {
            let (path, plate) = (self.recipe.path(index), &terms.plates[index]);
            let [start, end] = path.feet(plate);
            let slope = |foot: &Vector3<f64>| plate.normal_at(foot);
            let (first, last) = (slope(&start), slope(&end));
            let (up, off) = (first * path.lift_m, last * path.lift_m);
            let [before, after] = self.recipe.dips_m;
            let come = heights(path.lift_m, before).map(|h| (start + up * (h / path.lift_m), first));
            let down: Vec<_> = come.collect();
            let seed = self.reach(&down[0]);
            let kind = if i == 0 {
                SegmentKind::Depart
            } else {
                SegmentKind::Transit
            };
            self.go(kind, index, seed);
            self.follow(SegmentKind::Approach, index, &down);
            let points = thetas(&path.curve, &plate.surface, pace).into_iter().map(|theta| {
                let normal = path.curve.on(&plate.surface, theta).normal;
                (path.contact(plate, theta), normal)
            });
            self.follow(SegmentKind::Wash, index, &points.collect::<Vec<_>>());
            let leave = heights(path.lift_m, after).map(|h| (end + off * (h / path.lift_m), last));
            let lift: Vec<_> = leave.collect::<Vec<_>>().into_iter().rev().collect();
            self.follow(SegmentKind::Retreat, index, &lift);
        }
        let last = self.recipe.order[self.recipe.order.len() - 1];
        self.go(SegmentKind::Return, last, terms.home_rad[1]);
        self.seal()
    }

    /// A configuration for the tip at a place, the elbow up.
    fn reach(&self, place: &Place) -> JointVector {
        let turn = place.0.y.atan2(place.0.x);
        let seed = JointVector::new(turn, 0.4, 0.2, 0.0, 0.9, turn);
        self.solve(std::slice::from_ref(place), &seed)[0]
    }

    fn solve(&self, places: &[Place], seed: &JointVector) -> Vec<JointVector> {
        let tip = self.recipe.terms.workcell.tool.tip_frame(&self.robot);
        let settings = IkSettings {
            position_tolerance_m: 1e-9,
            orientation_tolerance_rad: 1e-9,
            ..IkSettings::default()
        };
        let solver = IkSolver::new(&self.robot, tip, settings).unwrap();
        let target = |(p, normal): &Place| {
            let lean = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), self.recipe.lean);
            let half = UnitQuaternion::rotation_between(&Vector3::z(), normal).unwrap();
            let half = half.powf(self.recipe.share);
            let down = tool_down(*p);
            Pose::from_parts(down.translation, half * lean * down.rotation)
        };
        let targets: Vec<_> = places.iter().map(target).collect();
        solver.solve_path(&targets, seed).unwrap().q
    }

    fn go(&mut self, kind: SegmentKind, plate: usize, to: JointVector) {
        let from = self.q[self.q.len() - 1];
        let seconds = 1.0 + 2.5 * (to - from).amax();
        self.q.extend(shares(seconds).skip(1).map(|s| from + (to - from) * s));
        self.mark(kind, plate);
    }

    fn follow(&mut self, kind: SegmentKind, plate: usize, places: &[Place]) {
        let q = self.solve(places, &self.q[self.q.len() - 1]);
        self.q.extend(&q[1..]);
        self.mark(kind, plate);
    }

    fn mark(&mut self, kind: SegmentKind, plate: usize) {
        self.marks.push((kind, plate, self.q.len() - 1));
        self.rests.push(self.q.len() - 1);
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
        let order = self.recipe.order.clone();
        let parts = PlanParts {
            provenance: Provenance::new("made"),
            wash_paths: order.iter().map(|plate| self.recipe.path(*plate)).collect(),
            order,
            segments,
            knots: Knots::from(&motion),
        };
        Plan::sealed(self.recipe.terms.clone(), parts).unwrap()
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

/// Heights over a face from a lift to the face \[m\], by way of a dip below it where there is one.
fn heights(lift_m: f64, dip_m: f64) -> impl Iterator<Item = f64> {
    let down = shares(0.9).map(move |s| (lift_m + dip_m) * (1.0 - s) - dip_m);
    let up = shares(0.5).skip(1).map(move |s| -dip_m * (1.0 - s));
    down.chain(up.filter(move |_| dip_m > 0.0))
}

/// θ at equal time steps, from rest to rest, with the tip's speed and acceleration within limits: the greatest speeds on a fine
/// grid by a pass forwards and one backwards.
fn thetas(curve: &WashCurve, surface: &Surface, [speed, acceleration]: [f64; 2]) -> Vec<f64> {
    let n = 40_000;
    let grid: Vec<f64> = (0..=n).map(|k| curve.end() * f64::from(k) / f64::from(n)).collect();
    let along = 0.5 * acceleration;
    let mut v: Vec<f64> = grid
        .iter()
        .map(|&theta| {
            if !surface.is_flat() {
                let h = 1e-5 * curve.end();
                let at = |theta: f64| curve.on(surface, theta.clamp(0.0, curve.end()));
                let (p, q, r) = (at(theta - h), at(theta), at(theta + h));
                let second = (r.first - p.first) / (2.0 * h);
                return speed.min((along * q.first.norm_squared() / second.norm()).sqrt());
            }
            let p = curve.at(theta);
            let across = (p.first.x * p.second.y - p.first.y * p.second.x).abs();
            speed.min((along * p.first.norm().powi(3) / across).sqrt())
        })
        .collect();
    let length = |k: usize| curve.on(surface, grid[k]).first.norm() * (grid[k + 1] - grid[k]);
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
        (grid[k - 1] + (grid[k] - grid[k - 1]) * way / length(k - 1)).min(curve.end())
    };
    (0..=steps).map(|k| at(t[last] * k as f64 / steps as f64)).collect()
}
