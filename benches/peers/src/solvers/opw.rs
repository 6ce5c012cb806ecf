//! The crate `rs-opw-kinematics`: all analytic solutions, of which the nearest within the limits is taken.

use super::Solver;
use super::pick::nearest_within;
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel};
use rs_opw_kinematics::glam::{DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::{Kinematics, Pose as OpwPose};
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use std::f64::consts::FRAC_PI_2;

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
        Self {
            robot,
            solver: OPWKinematics::new(parameters),
            targets: targets.iter().map(convert).collect(),
        }
    }

    /// What the crate calls a solution for a pose \[rad\], joints in (−π, π].
    #[must_use]
    pub fn solutions(&self, pose: &Pose) -> Vec<[f64; AXES]> {
        self.solver.inverse(&convert(pose))
    }
}

fn convert(pose: &Pose) -> OpwPose {
    let (p, q) = (pose.translation.vector, pose.rotation.coords);
    OpwPose::from_parts(DVec3::new(p.x, p.y, p.z), DQuat::from_xyzw(q.x, q.y, q.z, q.w))
}

impl Solver for Opw<'_> {
    fn name(&self) -> &'static str {
        "rs-opw-kinematics"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        let solutions = self.solver.inverse(&self.targets[target]);
        nearest_within(self.robot.limits(), solutions, seed)
    }
}

/// The same crate's `inverse_continuing`, which sorts the solutions by their distance from the last answer and keeps joints that a
/// singularity leaves free.
pub struct OpwContinuing<'a>(Opw<'a>);

impl<'a> OpwContinuing<'a> {
    /// Prepares the solver as [`Opw::new`] does.
    #[must_use]
    pub fn new(robot: &'a RobotModel, targets: &[Pose]) -> Self {
        Self(Opw::new(robot, targets))
    }
}

impl Solver for OpwContinuing<'_> {
    fn name(&self) -> &'static str {
        "rs-opw-kinematics, `inverse_continuing`"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        let Opw { robot, solver, targets } = &self.0;
        let solutions = solver.inverse_continuing(&targets[target], &(*seed).into());
        nearest_within(robot.limits(), solutions, seed)
    }
}
