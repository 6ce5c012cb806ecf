//! What follows from having found no configuration: that there is none, or nothing.

use super::exhaustive::anywhere;
use super::task::Task;
use crate::scene::Scene;
use nalgebra::Vector3;
use platewash_kinematics::{AXES, Axes, JointVector};
use platewash_workcell::cancel::Cancelled;
use serde::Serialize;
use std::f64::consts::TAU;

/// Contact points looked at closely before it is said that there may be a configuration after all.
const MOST_LOOKED_AT: usize = 4;

/// How exactly the tip must lie on axis 6 for its yaw to be joint 6 alone (m, and sine of the angle).
const ON_AXIS_6: f64 = 1e-9;

/// What is known of a plate for which no configurations were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Conclusion {
    /// It cannot be washed whole: a contact point is farther away than the lengths of the arm's links add up to
    /// ([`platewash_kinematics::RobotModel::reach_bound`]).
    BeyondReach,
    /// It cannot be washed whole: at a contact point every branch of the arm, in closed form, at tilts 1° and directions 5° apart
    /// ([`super::exhaustive`]), is out of reach, beyond a limit or not clear.
    EveryBranchRefused,
    /// Nothing was found, and nothing is proved: branches were only searched for, or every contact point has a configuration and
    /// nothing was found that connects them.
    NotFound,
}

impl Conclusion {
    /// Whether it is known that there are none.
    #[must_use]
    pub fn is_proved(self) -> bool {
        self != Self::NotFound
    }
}

/// What follows where contact points, by their θ \[rad\], are without a configuration in the arm's plane.
///
/// # Errors
/// [`Cancelled`].
pub(super) fn conclude(task: &Task<'_>, dead: &[f64]) -> Result<Conclusion, Cancelled> {
    let mut points = dead.iter().map(|&theta| task.samples.at(theta).point);
    if points.any(|point| is_beyond_reach(task, &point)) {
        return Ok(Conclusion::BeyondReach);
    }
    if task.scene.inverse.knows_all_branches() && yaw_is_joint_6(task.scene) {
        for theta in telling(task, dead) {
            if anywhere(task, theta)?.is_none() {
                return Ok(Conclusion::EveryBranchRefused);
            }
        }
    }
    Ok(Conclusion::NotFound)
}

/// Whether a point \[m\] is farther away than the lengths of the links add up to: no configuration puts the tip there.
pub(super) fn is_beyond_reach(task: &Task<'_>, point: &Vector3<f64>) -> bool {
    let (centre, bound_m) = task.scene.robot.reach_bound(&task.scene.tip);
    (point - centre.coords).norm() > bound_m + ON_AXIS_6
}

/// The points likeliest to have no configuration at all: the farthest from axis 1 and the nearest, then the first and the last.
fn telling(task: &Task<'_>, dead: &[f64]) -> Vec<f64> {
    let distance = |theta: &&f64| task.scene.distance(&task.samples.at(**theta).point);
    let farthest = dead.iter().max_by(|a, b| distance(a).total_cmp(&distance(b)));
    let nearest = dead.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let mut chosen: Vec<f64> = Vec::with_capacity(MOST_LOOKED_AT);
    for theta in [farthest, nearest, dead.first(), dead.last()].into_iter().flatten() {
        if !chosen.contains(theta) {
            chosen.push(*theta);
        }
    }
    chosen
}

/// Whether turning the tool about its own axis takes joint 6 alone, which can go all the way round: then no yaw reaches
/// what another one does not.
fn yaw_is_joint_6(scene: &Scene<'_>) -> bool {
    let limits = scene.robot.limits();
    let poses = scene.robot.fk(&JointVector::zeros());
    let jacobian = poses.jacobian(&scene.tip, Axes::Base);
    let (linear, axis) = (
        jacobian.fixed_view::<3, 1>(0, AXES - 1),
        jacobian.fixed_view::<3, 1>(3, AXES - 1),
    );
    let tool = poses.rigid(&scene.tip).rotation.column(2).into_owned();
    let round = limits.upper[AXES - 1] - limits.lower[AXES - 1] >= TAU;
    round && linear.norm() <= ON_AXIS_6 && axis.into_owned().cross(&tool).norm() <= ON_AXIS_6
}
