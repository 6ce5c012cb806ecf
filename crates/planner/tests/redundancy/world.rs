//! An arm among plates, and what a washing promises, for tests within the library and outside: the module above says where
//! `redundancy` and `placed_arm` are.

use super::placed_arm::PlacedArm;
use super::redundancy::places::MovedPlate;
use super::redundancy::samples::CHORD_ERROR_M;
use super::redundancy::{RedundancyError, Task, Washing, washing};
use platewash_bodies::clearance::ClearanceModel;
use platewash_fixtures::workcell;
use platewash_kinematics::trig::sin_cos;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::job::ReachBorders;
use platewash_workcell::plate::Plate;
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::wash_path::{WashCurve, WashPath, WashPattern};

pub const RADIUS_M: f64 = 0.12385;
pub const CLEARANCE_M: f64 = 0.01;
pub const HOME: JointVector = JointVector::new(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);

/// The tool of the kitchen with another length and another handle.
pub fn straight(length_m: f64, radius_m: f64) -> Tool {
    Tool::from(StraightTool {
        length_m,
        radius_m,
        ..StraightTool::default()
    })
}

pub fn curve(radius_m: f64) -> WashCurve {
    WashCurve {
        radius_m,
        turns: 3.5,
        start_angle_rad: 0.3,
        closing_ring: true,
        trim_rad: 0.0,
        pattern: WashPattern::Spiral,
    }
}

/// The path on the first plate.
pub fn path(curve: WashCurve, tilt_deg: f64) -> WashPath {
    WashPath {
        plate: 0,
        curve,
        lift_m: 0.03,
        cone_rad: tilt_deg.to_radians(),
    }
}

pub fn plate_at(rho: f64, azimuth_deg: f64) -> Plate {
    let (s, c) = sin_cos(azimuth_deg.to_radians());
    Plate::level_disc([rho * c, rho * s, 0.03], 0.145, 0.02)
}

/// An arm among some plates.
pub struct World<'a> {
    pub placed: PlacedArm<'a>,
    pub clearance: &'a ClearanceModel,
}

impl World<'_> {
    pub fn task(&self, path: &WashPath) -> Task<'_> {
        self.task_near(path, &HOME)
    }

    pub fn task_near(&self, path: &WashPath, near: &JointVector) -> Task<'_> {
        Task::new(&self.placed, path, CLEARANCE_M, near).unwrap()
    }

    pub fn washing(&self, path: &WashPath) -> Result<Washing, RedundancyError> {
        washing(&self.task(path))
    }
}

/// Does something with an arm among some plates.
pub fn with_arm<T>(robot: &RobotModel, tool: &Tool, plates: &[Plate], act: impl FnOnce(&World<'_>) -> T) -> T {
    let clearance = ClearanceModel::new(robot, &workcell(robot, tool.clone()), plates).unwrap();
    act(&World {
        placed: PlacedArm::new(robot, tool, &clearance, plates, ReachBorders::IRB_120).unwrap(),
        clearance: &clearance,
    })
}

/// The same with the IRB 120.
pub fn within<T>(tool: &Tool, plates: &[Plate], act: impl FnOnce(&World<'_>) -> T) -> T {
    with_arm(&RobotModel::irb120().unwrap(), tool, plates, act)
}

/// The second derivatives of the clamped cubic spline through (x, y) (de Boor, ch. IV), by elimination.
pub fn spline_curvatures(x: &[f64], y: &[f64], ends: [f64; 2]) -> Vec<f64> {
    let n = x.len();
    let h = |k: usize| x[k + 1] - x[k];
    let rise = |k: usize| (y[k + 1] - y[k]) / h(k);
    let (mut upper, mut right) = (vec![0.5; n], vec![3.0 * (rise(0) - ends[0]) / h(0); n]);
    for k in 1..n {
        let below = h(k - 1);
        let (diagonal, above, value) = if k + 1 < n {
            (2.0 * (below + h(k)), h(k), 6.0 * (rise(k) - rise(k - 1)))
        } else {
            (2.0 * below, 0.0, 6.0 * (ends[1] - rise(k - 1)))
        };
        let pivot = diagonal - below * upper[k - 1];
        upper[k] = above / pivot;
        right[k] = (value - below * right[k - 1]) / pivot;
    }
    for k in (0..n - 1).rev() {
        right[k] -= upper[k] * right[k + 1];
    }
    right
}

/// Checks everything that a washing promises, from outside.
pub fn check(world: &World<'_>, path: &WashPath, washing: &Washing) {
    let placed = &world.placed;
    let (plate, limits) = (&placed.plates[path.plate], placed.robot.limits());
    assert_eq!(washing.theta, path.curve.parameters(&plate.surface, CHORD_ERROR_M));
    assert_eq!([washing.q.len(), washing.tilt_rad.len()], [washing.theta.len(); 2]);
    let stance = placed.clone().leaning_aside(washing.aside_rad).stance;
    for (k, (&theta, q)) in washing.theta.iter().zip(&washing.q).enumerate() {
        let tip = placed.robot.fk(q).rigid(&placed.tip);
        let contact = plate.pose.rotation * path.curve.at(theta).position.push(0.0) + plate.centre();
        assert!((tip.translation - contact).norm() < 1e-9, "point {k}");
        let tool = tip.rotation.column(2);
        let lean = tool.cross(&plate.axis()).norm().atan2(-tool.dot(&plate.axis()));
        let stated = stance.lean_rad(washing.tilt_rad[k]);
        assert!(
            (lean - stated).abs() < 1e-9,
            "tilt at {k}: {lean} {}",
            washing.tilt_rad[k]
        );
        assert!(lean <= path.cone_rad + 1e-9);
        assert!(limits.contain(q), "point {k}");
        for pair in world.clearance.all(q) {
            let sponge_on_plate = pair.a == "sponge" && pair.b.starts_with("plate");
            let kept = pair.distance_m >= CLEARANCE_M;
            assert!(sponge_on_plate || kept, "point {k}: {pair:?}");
        }
    }
    check_between(placed, &path.curve, plate, washing);
}

/// The clamped spline through the answer stays near the wash path and keeps the answer's slopes.
pub fn check_between(placed: &PlacedArm<'_>, curve: &WashCurve, plate: &Plate, washing: &Washing) {
    let x = &washing.theta;
    let curvatures: Vec<Vec<f64>> = (0..6)
        .map(|joint| {
            let y: Vec<_> = washing.q.iter().map(|q| q[joint]).collect();
            spline_curvatures(x, &y, washing.end_slopes.map(|slope| slope[joint]))
        })
        .collect();
    let mut worst: f64 = 0.0;
    for k in 0..x.len() - 1 {
        let h = x[k + 1] - x[k];
        for share in [0.2, 0.5, 0.8] {
            let (a, b) = (1.0 - share, share);
            let q = JointVector::from_fn(|joint, _| {
                let m = &curvatures[joint];
                a * washing.q[k][joint]
                    + b * washing.q[k + 1][joint]
                    + ((a * a * a - a) * m[k] + (b * b * b - b) * m[k + 1]) * h * h / 6.0
            });
            let tip = placed.robot.pose(&q, &placed.tip).translation.vector;
            // Distance from the curve: to the point at this θ, less what is along the curve.
            let point = curve.at(x[k] + share * h);
            let off = plate.local(&tip) - point.position.push(0.0);
            let along = point.first.push(0.0).normalize();
            worst = worst.max((off - along * along.dot(&off)).norm());
        }
    }
    assert!(worst < 2e-5, "the spline leaves the wash path by {worst} m");
}

/// Where else the first plate could lie.
pub fn elsewhere<'a>(world: &'a World<'a>, path: &'a WashPath) -> MovedPlate<'a> {
    MovedPlate {
        placed: &world.placed,
        clearance: world.clearance,
        path,
        clearance_m: CLEARANCE_M,
        near: &HOME,
    }
}
