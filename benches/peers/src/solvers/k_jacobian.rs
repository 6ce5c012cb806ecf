//! The crate `k`: Newton steps on the Jacobian, restarted from random configurations.

use super::Solver;
use k::nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};
use k::{InverseKinematicsSolver, JacobianIkSolver, SerialChain};
use platewash_kinematics::{AXES, JointVector, Pose, RobotModel};
use platewash_problems::Tolerance;
use platewash_problems::problems::{Problems, configuration};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::error::Error;

const URDF: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../urdf/irb120.urdf");
/// Full Newton steps: with less, the solver needs more of them and solves no more targets here.
const GAIN: f64 = 1.0;
/// Steps from one start.
const STEPS: usize = 100;
/// Random restarts after the first failure; the crate has none of its own.
const RESTARTS: usize = 100;
/// Seed of the restarts.
const STREAM: u64 = 32;

/// `k::JacobianIkSolver`.
pub struct KJacobian<'a> {
    robot: &'a RobotModel,
    arm: SerialChain<f64>,
    solver: JacobianIkSolver<f64>,
    targets: Vec<Isometry3<f64>>,
    rng: Pcg64,
}

impl<'a> KJacobian<'a> {
    /// Builds the chain to `tool0` from our own URDF.
    ///
    /// # Errors
    /// A description that the crate does not read.
    pub fn new(robot: &'a RobotModel, problems: &Problems) -> Result<Self, Box<dyn Error>> {
        let chain = k::Chain::<f64>::from_urdf_file(URDF)?;
        let tip = chain.find_link("tool0").ok_or("no tool0")?;
        let convert = |pose: &Pose| {
            let (p, q) = (pose.translation.vector, pose.rotation.coords);
            let rotation = UnitQuaternion::from_quaternion(Quaternion::new(q.w, q.x, q.y, q.z));
            Isometry3::from_parts(Translation3::new(p.x, p.y, p.z), rotation)
        };
        let Tolerance {
            position_m,
            orientation_rad,
        } = problems.tolerance;
        Ok(Self {
            robot,
            arm: SerialChain::from_end(tip),
            solver: JacobianIkSolver::new(position_m, orientation_rad, GAIN, STEPS),
            targets: problems.targets.iter().map(convert).collect(),
            rng: Pcg64::seed_from_u64(STREAM),
        })
    }

    fn from(&self, start: &JointVector, target: usize) -> Option<JointVector> {
        self.arm.set_joint_positions(start.as_slice()).ok()?;
        self.solver.solve(&self.arm, &self.targets[target]).ok()?;
        let positions = self.arm.joint_positions();
        (positions.len() == AXES).then(|| JointVector::from_column_slice(&positions))
    }
}

impl Solver for KJacobian<'_> {
    fn name(&self) -> &'static str {
        "k"
    }

    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector> {
        self.from(seed, target).or_else(|| {
            (0..RESTARTS).find_map(|_| {
                let start = configuration(self.robot, &mut self.rng);
                self.from(&start, target)
            })
        })
    }
}
