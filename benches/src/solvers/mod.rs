//! The solvers under comparison, behind one interface.

mod ik_geo;
mod k_jacobian;
mod opw;
mod pick;
mod platewash;

pub use ik_geo::IkGeo;
pub use k_jacobian::KJacobian;
pub use opw::Opw;
pub use pick::nearest_within;
pub use platewash::{Nearest, Path, Solve};

use crate::problems::Problems;
use platewash_kinematics::{JointVector, RobotModel};
use std::error::Error;

/// A solver that has been given its targets in the form it likes best, so that no conversion is timed.
pub trait Solver {
    /// Name for tables.
    fn name(&self) -> &'static str;

    /// What the solver calls a solution for the target of that index, from `seed` \[rad\].
    fn solve(&mut self, target: usize, seed: &JointVector) -> Option<JointVector>;

    /// Answers for all targets in one call, from `start` \[rad\]; `None` for a solver that takes them one by one.
    fn path(&mut self, _start: &JointVector) -> Option<Vec<Option<JointVector>>> {
        None
    }
}

/// Solvers in the order of their rows, our own first.
pub type Solvers<'a> = Vec<Box<dyn Solver + 'a>>;

/// For a spiral: the whole path, then each point from the last answer.
///
/// # Errors
/// A peer that does not read the arm's description.
pub fn warm<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    let mut all: Solvers<'a> = vec![Box::new(Path::new(robot, problems)?)];
    all.append(&mut cold(robot, problems)?);
    Ok(all)
}

/// For poses that have nothing to do with each other.
///
/// # Errors
/// A peer that does not read the arm's description.
pub fn cold<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    Ok(vec![
        Box::new(Solve::new(robot, problems)?),
        Box::new(Opw::new(robot, &problems.targets)),
        Box::new(IkGeo::new(robot, &problems.targets)),
        Box::new(KJacobian::new(robot, problems)?),
    ])
}

/// Closed forms only, asked for the branch nearest to the start.
///
/// # Errors
/// An arm without a closed form.
pub fn nearest<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    Ok(vec![
        Box::new(Nearest::new(robot, problems)?),
        Box::new(Opw::new(robot, &problems.targets)),
        Box::new(IkGeo::new(robot, &problems.targets)),
    ])
}
