//! The solvers under comparison: our own, then the peers.

mod ik_geo;
mod k_jacobian;
mod opw;
mod pick;

pub use ik_geo::IkGeo;
pub use k_jacobian::KJacobian;
pub use opw::{Opw, OpwContinuing};
pub use pick::nearest_within;

use platewash_kinematics::RobotModel;
use platewash_problems::ours;
use platewash_problems::problems::Problems;
use platewash_problems::solver::{Solver, Solvers};
use std::error::Error;

/// For a spiral: the whole path, then each point from the last answer.
///
/// # Errors
/// A peer that does not read the arm's description.
pub fn warm<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    let mut all = ours::warm(robot, problems)?;
    all.push(Box::new(OpwContinuing::new(robot, &problems.targets)));
    all.append(&mut all_peers(robot, problems)?);
    Ok(all)
}

/// For poses that have nothing to do with each other.
///
/// # Errors
/// A peer that does not read the arm's description.
pub fn cold<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    let mut all = ours::cold(robot, problems)?;
    all.append(&mut all_peers(robot, problems)?);
    Ok(all)
}

/// Closed forms only, asked for the branch nearest to the start.
///
/// # Errors
/// An arm without a closed form.
pub fn nearest<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    let mut all = ours::nearest(robot, problems)?;
    all.append(&mut analytic_peers(robot, problems)?);
    Ok(all)
}

/// The same for an arm with parallel axes 2, 3 and 4.
///
/// # Errors
/// An arm without a closed form.
pub fn nearest_three_parallel<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    let mut all = ours::nearest(robot, problems)?;
    all.push(Box::new(IkGeo::three_parallel(robot, &problems.targets)?));
    Ok(all)
}

fn analytic_peers<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    Ok(vec![
        Box::new(Opw::new(robot, &problems.targets)),
        Box::new(IkGeo::spherical(robot, &problems.targets)?),
    ])
}

fn all_peers<'a>(robot: &'a RobotModel, problems: &Problems) -> Result<Solvers<'a>, Box<dyn Error>> {
    let mut all = analytic_peers(robot, problems)?;
    all.push(Box::new(KJacobian::new(robot, problems)?));
    Ok(all)
}
