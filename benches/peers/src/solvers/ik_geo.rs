//! The crate `ik-geo`: all analytic solutions by subproblems, of which the nearest within the limits is taken.

use super::Solver;
use super::pick::nearest_within;
use ik_geo::nalgebra::{Matrix3, Matrix3x6, SMatrix, Vector3};
use ik_geo::robot::{IKSolver, Robot, spherical_two_parallel};
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel};

/// `ik_geo::robot::spherical_two_parallel`.
pub struct IkGeo<'a> {
    robot: &'a RobotModel,
    solver: Robot,
    targets: Vec<(Matrix3<f64>, Vector3<f64>)>,
}

impl<'a> IkGeo<'a> {
    /// Prepares the solver with the IRB 120's product of exponentials, from the base to the flange.
    #[must_use]
    pub fn new(robot: &'a RobotModel, targets: &[Pose]) -> Self {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let axes = Matrix3x6::from_columns(&[z, y, y, x, y, x]);
        let zero = Vector3::zeros();
        let links = [
            zero,
            z * 0.290,
            z * 0.270,
            Vector3::new(0.302, 0.0, 0.070),
            zero,
            zero,
            x * 0.072,
        ];
        Self {
            robot,
            solver: spherical_two_parallel(axes, SMatrix::<f64, 3, 7>::from_columns(&links)),
            targets: targets.iter().map(convert).collect(),
        }
    }

    /// What the crate calls an exact solution for a pose \[rad\]; it offers least-squares ones besides.
    #[must_use]
    pub fn solutions(&self, pose: &Pose) -> Vec<[f64; AXES]> {
        let (rotation, position) = convert(pose);
        exact(self.solver.ik(rotation, position)).collect()
    }
}

/// Its end frame is parallel to the base at q = 0, where `tool0` is turned by 90° about y.
fn convert(pose: &Pose) -> (Matrix3<f64>, Vector3<f64>) {
    let (p, r) = (pose.translation.vector, pose.rotation.to_rotation_matrix());
    let column = |i: usize| Vector3::new(r[(0, i)], r[(1, i)], r[(2, i)]);
    let rotation = Matrix3::from_columns(&[column(2), column(1), -column(0)]);
    (rotation, Vector3::new(p.x, p.y, p.z))
}

fn exact(solutions: Vec<(ik_geo::nalgebra::Vector6<f64>, bool)>) -> impl Iterator<Item = [f64; AXES]> {
    solutions
        .into_iter()
        .filter(|(_, least_squares)| !least_squares)
        .map(|(q, _)| q.into())
}

impl Solver for IkGeo<'_> {
    fn name(&self) -> &'static str {
        "ik-geo"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        let (rotation, position) = self.targets[target];
        nearest_within(self.robot.limits(), exact(self.solver.ik(rotation, position)), seed)
    }
}
