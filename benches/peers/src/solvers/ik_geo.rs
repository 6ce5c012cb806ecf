//! The crate `ik-geo`: all analytic solutions by subproblems, of which the nearest within the limits is taken.

use super::Solver;
use super::pick::nearest_within;
use ik_geo::nalgebra::{Matrix3, Matrix3x6, SMatrix, Vector3};
use ik_geo::robot::{IKSolver, Robot, spherical_two_parallel, three_parallel_two_intersecting};
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel, ToolFrame, ToolFrameError};
use std::array;

/// `ik_geo::robot::spherical_two_parallel` or `three_parallel_two_intersecting`.
pub struct IkGeo<'a> {
    robot: &'a RobotModel,
    solver: Robot,
    /// Rotation from `tool0` to the solver's end frame, which is parallel to the base at q = 0.
    end: Matrix3<f64>,
    targets: Vec<(Matrix3<f64>, Vector3<f64>)>,
}

impl<'a> IkGeo<'a> {
    /// Prepares the solver for an arm with a spherical wrist and parallel axes 2 and 3, from the base to `tool0`. Axes 4 and 5 meet in the
    /// origin of joint 5.
    ///
    /// # Errors
    /// An arm without `tool0`.
    pub fn spherical(robot: &'a RobotModel, targets: &[Pose]) -> Result<Self, ToolFrameError> {
        Self::new(robot, targets, spherical_two_parallel, [1, 2, 3, 5, 5, 5])
    }

    /// Prepares the solver for an arm with parallel axes 2, 3 and 4. Axes 5 and 6 meet in the origin of joint 6.
    ///
    /// # Errors
    /// An arm without `tool0`.
    pub fn three_parallel(robot: &'a RobotModel, targets: &[Pose]) -> Result<Self, ToolFrameError> {
        Self::new(robot, targets, three_parallel_two_intersecting, [1, 2, 3, 4, 6, 6])
    }

    /// Makes the product of exponentials with the origins of the given bodies on the axes.
    fn new(
        robot: &'a RobotModel,
        targets: &[Pose],
        solver: fn(Matrix3x6<f64>, SMatrix<f64, 3, 7>) -> Robot,
        origins: [usize; AXES],
    ) -> Result<Self, ToolFrameError> {
        let zero = robot.fk(&JointVector::zeros());
        let tool0 = zero.pose(&robot.tool_frame(ToolFrame::Tool0)?);
        let vector = |v: [f64; 3]| Vector3::from(v);
        let axes: [_; AXES] = array::from_fn(|i| vector(zero.bodies()[i + 1].rotation.column(2).into_owned().into()));
        let place = |k: usize| match k {
            0 => Vector3::zeros(),
            7 => vector(tool0.translation.vector.into()),
            _ => vector(zero.bodies()[origins[k - 1]].translation.into()),
        };
        let links: [_; AXES + 1] = array::from_fn(|k| place(k + 1) - place(k));
        let mut geometry = Self {
            robot,
            solver: solver(Matrix3x6::from_columns(&axes), SMatrix::from_columns(&links)),
            end: rotation(&tool0).transpose(),
            targets: Vec::new(),
        };
        geometry.targets = targets.iter().map(|pose| geometry.convert(pose)).collect();
        Ok(geometry)
    }

    /// What the crate calls an exact solution for a pose \[rad\]; it offers least-squares ones besides.
    #[must_use]
    pub fn solutions(&self, pose: &Pose) -> Vec<[f64; AXES]> {
        let (rotation, position) = self.convert(pose);
        exact(self.solver.ik(rotation, position)).collect()
    }

    /// Number of solutions of one target, least-squares ones included.
    #[must_use]
    pub fn count(&self, target: usize) -> usize {
        let (rotation, position) = self.targets[target];
        self.solver.ik(rotation, position).len()
    }

    fn convert(&self, pose: &Pose) -> (Matrix3<f64>, Vector3<f64>) {
        let position: [f64; 3] = pose.translation.vector.into();
        (rotation(pose) * self.end, position.into())
    }
}

fn rotation(pose: &Pose) -> Matrix3<f64> {
    let r = pose.rotation.to_rotation_matrix();
    Matrix3::from_fn(|i, j| r[(i, j)])
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
