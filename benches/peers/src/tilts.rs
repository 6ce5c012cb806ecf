//! Poses just outside the tool-down reach, and a brute-force search over how the tool may lean.

use nalgebra::{Unit, UnitQuaternion, Vector3};
use platewash_kinematics::ik::IkSolver;
use platewash_kinematics::{JointVector, Pose, RobotModel};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::f64::consts::{PI, TAU};

/// How far the tool may lean \[rad\].
pub const CONE_RAD: f64 = 15.0 / 180.0 * PI;
/// What the search must have to spare, of the cone and of every limit \[rad\].
const SPARE_RAD: f64 = 0.2 / 180.0 * PI;
/// Grids, each tried if the one before finds nothing \[rad\].
const GRIDS_RAD: [f64; 2] = [PI / 180.0, PI / 1800.0];
/// Poses.
const CASES: usize = 200;

/// Where every search starts \[rad\].
#[must_use]
pub fn start() -> JointVector {
    JointVector::new(0.0, 0.3, 0.2, 0.0, 1.0, 0.0)
}

fn down_at(rho: f64, azimuth: f64, z: f64) -> Pose {
    let (s, c) = azimuth.sin_cos();
    let half_turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), PI);
    Pose::from_parts(Vector3::new(rho * c, rho * s, z).into(), half_turn)
}

/// Tool-down poses up to 20 mm beyond the inner and outer border of the reach.
#[must_use]
pub fn poses(solver: &IkSolver<'_>) -> Vec<Pose> {
    let mut rng = Pcg64::seed_from_u64(4);
    let pose = |case: usize| {
        let z = 0.05 + 0.25 * rng.random::<f64>();
        let beyond = 0.02 * rng.random::<f64>();
        let rho = if case.is_multiple_of(2) {
            border(solver, z, 0.8) + beyond
        } else {
            border(solver, z, 0.0) - beyond
        };
        down_at(rho, 2.6 * (2.0 * rng.random::<f64>() - 1.0), z)
    };
    (0..CASES).map(pose).collect()
}

/// The last solvable distance from axis 1 on the way from 0.35 m to `outside`, by bisection \[m\].
fn border(solver: &IkSolver<'_>, z: f64, mut outside: f64) -> f64 {
    let mut inside = 0.35;
    for _ in 0..40 {
        let middle = 0.5 * (inside + outside);
        if solver.solve(&down_at(middle, 0.0, z), &start()).is_ok() {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    inside
}

/// Whether some tilt on the grid, of the cone less what is to be spared, has a branch that far from every limit.
#[must_use]
pub fn brute_force(robot: &RobotModel, solver: &IkSolver<'_>, target: &Pose) -> bool {
    GRIDS_RAD.iter().any(|&step| {
        let tilts = ((CONE_RAD - SPARE_RAD) / step) as usize;
        let azimuths = (TAU / step) as usize;
        // The largest tilts first: they reach furthest.
        (0..=tilts).rev().any(|tilt| {
            (0..azimuths).any(|azimuth| {
                let pose = leaning(target, tilt as f64 * step, azimuth as f64 * step);
                solver.solve_all(&pose, &start()).is_ok_and(|solutions| {
                    let mut all = solutions.configurations();
                    all.any(|(_, q)| robot.limits().margins(&q).min() >= SPARE_RAD)
                })
            })
        })
    })
}

/// The target leaning by `tilt` towards `azimuth` of its own xy plane.
fn leaning(target: &Pose, tilt: f64, azimuth: f64) -> Pose {
    let (s, c) = azimuth.sin_cos();
    let axis = Unit::new_unchecked(Vector3::new(-s, c, 0.0));
    target * UnitQuaternion::from_axis_angle(&axis, tilt)
}

/// Whether the configuration is within the limits, meets the position and leans by no more than the cone.
#[must_use]
pub fn met(robot: &RobotModel, found: &Pose, target: &Pose, q: &JointVector) -> bool {
    let position_m = (found.translation.vector - target.translation.vector).norm();
    let lean = (found.rotation * Vector3::z()).angle(&(target.rotation * Vector3::z()));
    robot.limits().contain(q) && position_m <= 1.001e-6 && lean <= CONE_RAD + 1.1e-6
}
