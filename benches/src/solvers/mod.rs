//! The solvers under comparison, behind one interface.

mod k_jacobian;
mod opw;
mod platewash;

pub use k_jacobian::KJacobian;
pub use opw::Opw;
pub use platewash::Platewash;

use crate::problems::Problems;
use platewash_kinematics::{JointVector, RobotModel};
use std::error::Error;

/// A solver that has been given its targets in the form it likes best, so that no conversion is timed.
pub trait Solver {
    /// Name for tables.
    fn name(&self) -> &'static str;

    /// What the solver calls a solution for the target of that index, from `seed` \[rad\].
    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector>;
}

/// Every solver, our own first.
///
/// # Errors
/// A peer that does not read the arm's description.
pub fn all<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Vec<Box<dyn Solver + 'a>>, Box<dyn Error>> {
    Ok(vec![
        Box::new(Platewash::new(robot, &problems.targets)?),
        Box::new(Opw::new(robot, &problems.targets)),
        Box::new(KJacobian::new(robot, &problems.targets)?),
    ])
}
