//! The crate `rs-opw-kinematics`: all analytic solutions, of which the nearest within the limits is taken.

use super::Solver;
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use std::f64::consts::{FRAC_PI_2, TAU};

/// `rs_opw_kinematics::kinematics_impl::OPWKinematics`.
pub struct Opw<'a> {
    robot: &'a RobotModel,
    solver: OPWKinematics,
    targets: Vec<OpwPose>,
}

impl<'a> Opw<'a> {
    /// Prepares the solver with the IRB 120's parameters; its end frame is `tool0`.
    #[must_use]
    pub fn new(robot: &'a RobotModel, targets: &[Pose]) -> Self {
        let parameters = Parameters {
            a1: 0.0,
            a2: -0.070,
            b: 0.0,
            c1: 0.290,
            c2: 0.270,
            c3: 0.302,
            c4: 0.072,
            offsets: [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0],
            sign_corrections: [1; AXES],
            dof: 6,
        };
        let convert = |pose: &Pose| {
            let (p, q) = (pose.translation.vector, pose.rotation.coords);
            OpwPose::from_parts(DVec3::new(p.x, p.y, p.z), DQuat::from_xyzw(q.x, q.y, q.z, q.w))
        };
        Self {
            robot,
            solver: OPWKinematics::new(parameters),
            targets: targets.iter().map(convert).collect(),
        }
    }

    /// The solution with every joint turned by whole turns towards `seed`, as far as the limits allow.
    fn towards(&self, solution: [f64; AXES], seed: &JointVector) -> Option<JointVector> {
        let limits = self.robot.limits();
        let q = JointVector::from_fn(|i, _| {
            let nearest = solution[i] + TAU * ((seed[i] - solution[i]) / TAU).round();
            if nearest > limits.upper[i] {
                nearest - TAU
            } else if nearest < limits.lower[i] {
                nearest + TAU
            } else {
                nearest
            }
        });
        limits.contain(&q).then_some(q)
    }
}

impl Solver for Opw<'_> {
    fn name(&self) -> &'static str {
        "rs-opw-kinematics"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        let solutions = self.solver.inverse(&self.targets[target]);
        let within = solutions
            .into_iter()
            .filter_map(|solution| self.towards(solution, seed));
        within.min_by(|a, b| (a - seed).amax().total_cmp(&(b - seed).amax()))
    }
}
