//! Extent to which a plate can be washed in its place: the part that cannot be washed, and the cause.
//!
//! Conclusion from a search that found no configuration: a proof that there is none, or no conclusion.

use crate::redundancy::search::Graph;
use crate::redundancy::stuck::{anywhere, reasons};
use crate::redundancy::task::{Reason, Task};
use crate::redundancy::washing::{by_policy, search_starts};
use crate::scene::{Filter, Hindrance, Scene, Start, Width};
use nalgebra::Vector3;
use platewash_kinematics::{AXES, Axes, JointVector};
use platewash_workcell::cancel::Cancelled;
use serde::Serialize;
use std::f64::consts::TAU;
use std::fmt;

/// Extent to which a plate can be washed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Washability {
    /// Each contact point on its own. (That they connect is for [`crate::redundancy::washing()`] to find; it always did.)
    Whole,
    /// Not all of it.
    Part {
        /// Share of the wash path for which configurations were found, on the best branch of the arm.
        share: f64,
        /// The parts of the rest, by their obstruction, the largest first: they add up to the rest.
        causes: Vec<Cause>,
        /// Conclusion about the rest: proved unwashable, or only not found to be washable.
        conclusion: Conclusion,
        /// The contact points that were checked.
        points: Points,
    },
}

/// Contact points that were checked one by one, in the order of the wash path, world frame \[m\].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Points {
    /// Contact points with a configuration, on the best branch of the arm.
    pub free_m: Vec<[f64; 3]>,
    /// Contact points without a configuration.
    pub dead_m: Vec<[f64; 3]>,
}

/// Obstruction that keeps a part of a wash path from being washed.
#[derive(Debug, Clone, PartialEq)]
pub struct Cause {
    /// Share of the wash path.
    pub share: f64,
    /// Least and greatest distance of that part from axis 1 \[m\].
    pub from_axis_m: [f64; 2],
    /// Greatest hindrance of each filter that, together with the others, leaves no tilt there. At each point the hindrance counts
    /// at the best tilt.
    pub worst: Vec<Hindrance>,
}

/// A [`Cause`] in words: the part in percent, where it lies, and by how much it is missed at most, rounded to the worse.
struct CauseText<'a>(&'a Cause, Conclusion);

impl fmt::Display for CauseText<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(cause, conclusion) = self;
        let [near, far] = cause.from_axis_m;
        let share = 100.0 * cause.share;
        let verdict = if conclusion.is_proved() {
            "cannot"
        } else {
            "no configuration found"
        };
        write!(f, "{share:.1} %, {near:.3} to {far:.3} m from axis 1, {verdict} (")?;
        for (k, worst) in cause.worst.iter().enumerate() {
            f.write_str(match k {
                0 if cause.worst.len() == 1 => "",
                0 => "at some tilts ",
                _ => ", at others ",
            })?;
            worst.fmt_worst(f)?;
        }
        f.write_str(")")
    }
}

impl Cause {
    /// It in words: the part in percent, where it lies, that it cannot be washed or was not found to be, and by how much it is
    /// missed at most, rounded up.
    #[must_use]
    pub fn words(&self, conclusion: Conclusion) -> String {
        CauseText(self, conclusion).to_string()
    }
}

/// Determines the extent to which a plate can be washed.
///
/// # Errors
/// [`Cancelled`].
pub fn washable(task: &Task<'_>) -> Result<Washability, Cancelled> {
    match by_policy(task, Width::Everywhere)? {
        Some(_) => Ok(Washability::Whole),
        None => washable_part(task),
    }
}

/// Determines the part that can be washed of a plate that no policy of tilts washes whole.
///
/// # Errors
/// [`Cancelled`].
pub fn washable_part(task: &Task<'_>) -> Result<Washability, Cancelled> {
    let graph = Graph::new(task);
    let mut starts = search_starts(task, &graph)?;
    starts.push(task.anywhere_near());
    let mut best: Option<Vec<EmptyLayer>> = None;
    for start in &starts {
        let fewer_than = best.as_ref().map_or(usize::MAX, Vec::len);
        best = survey(task, &graph, start, fewer_than)?.or(best);
    }
    let best = best.unwrap_or_default();
    if best.is_empty() {
        return Ok(Washability::Whole);
    }
    let tried = graph.surveyed().len() as f64;
    let dead: Vec<f64> = best.iter().map(|(k, _)| graph.theta[*k]).collect();
    let conclusion = conclude(task, &dead)?;
    let mut unwashed = Vec::with_capacity(best.len());
    for (k, here) in &best {
        task.scene.check_cancelled()?;
        let contact = task.samples.at(graph.theta[*k]);
        let hindrance = |&tilt: &f64| task.configuration(&task.scene.tip_rigid(&contact, tilt), here).err();
        let reasons = reasons(graph.tilts.iter().filter_map(hindrance));
        unwashed.push((task.scene.distance(&contact.point), reasons));
    }
    Ok(Washability::Part {
        share: 1.0 - best.len() as f64 / tried,
        causes: causes(unwashed, tried),
        conclusion,
        points: points(task, &graph, &best),
    })
}

/// The contact points of a survey, by whether their layer is among the `unwashed`.
fn points(task: &Task<'_>, graph: &Graph, unwashed: &[EmptyLayer]) -> Points {
    let dead = |k: &usize| unwashed.binary_search_by_key(k, |(layer, _)| *layer).is_ok();
    let place = |k: usize| task.scene.in_world(&task.samples.at(graph.theta[k]).point).into();
    let (dead, free): (Vec<usize>, Vec<usize>) = graph.surveyed().partition(dead);
    Points {
        free_m: free.into_iter().map(place).collect(),
        dead_m: dead.into_iter().map(place).collect(),
    }
}

/// A layer without a vertex, and where the arm was before.
type EmptyLayer = (usize, Start);

/// The layers of a graph without a vertex on the branch of `start`; `None` as soon as they are not fewer than asked.
fn survey(
    task: &Task<'_>,
    graph: &Graph,
    start: &Start,
    fewer_than: usize,
) -> Result<Option<Vec<EmptyLayer>>, Cancelled> {
    let mut here = *start;
    let mut unwashed = Vec::new();
    for k in graph.surveyed() {
        task.scene.check_cancelled()?;
        match graph.least_tilt(task, k, &here) {
            Some(q) => here.q = q,
            None => unwashed.push((k, here)),
        }
        if unwashed.len() >= fewer_than {
            return Ok(None);
        }
    }
    Ok(Some(unwashed))
}

/// Groups points, each with its distance from axis 1 \[m\], by the set of filters that stand in their way.
fn causes(unwashed: Vec<(f64, Vec<Reason>)>, tried: f64) -> Vec<Cause> {
    let mut found: Vec<(Vec<Filter>, Cause)> = Vec::new();
    for (r, reasons) in unwashed.into_iter().filter(|(_, reasons)| !reasons.is_empty()) {
        let mut filters: Vec<Filter> = reasons.iter().map(|reason| reason.least.filter()).collect();
        filters.sort_unstable();
        let here = reasons.into_iter().map(|reason| reason.least);
        match found.iter_mut().find(|(others, _)| *others == filters) {
            Some((_, cause)) => {
                cause.share += 1.0 / tried;
                cause.from_axis_m = [cause.from_axis_m[0].min(r), cause.from_axis_m[1].max(r)];
                for hindrance in here {
                    let worst = cause
                        .worst
                        .iter_mut()
                        .find(|worst| worst.filter() == hindrance.filter());
                    if let Some(worst) = worst.filter(|worst| hindrance.shortfall() > worst.shortfall()) {
                        *worst = hindrance;
                    }
                }
            }
            None => {
                let cause = Cause {
                    share: 1.0 / tried,
                    from_axis_m: [r, r],
                    worst: here.collect(),
                };
                found.push((filters, cause));
            }
        }
    }
    found.sort_by(|(_, a), (_, b)| b.share.total_cmp(&a.share));
    found.into_iter().map(|(_, cause)| cause).collect()
}

/// Greatest number of contact points that are checked closely before the conclusion that a configuration may exist.
const MOST_LOOKED_AT: usize = 4;

/// Tolerance within which the tip lies on axis 6, so that its yaw is joint 6 alone (m, and sine of the angle).
const ON_AXIS_6: f64 = 1e-9;

/// Conclusion about a plate for which no configurations were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Conclusion {
    /// It cannot be washed whole: a contact point is farther away than the lengths of the arm's links add up to
    /// ([`platewash_kinematics::RobotModel::reach_bound`]).
    BeyondReach,
    /// It cannot be washed whole: at a contact point every branch of the arm, in closed form, at tilts 1° and directions 5° apart
    /// ([`crate::redundancy::stuck`]), is out of reach, beyond a limit or not clear.
    EveryBranchRefused,
    /// Nothing was found, and nothing is proved: branches were only searched for, or every contact point has a configuration and
    /// nothing was found that connects them.
    NotFound,
}

impl Conclusion {
    /// Returns true where it is proved that there are none.
    #[must_use]
    pub fn is_proved(self) -> bool {
        self != Self::NotFound
    }
}

/// Draws the conclusion from contact points, by their θ \[rad\], that have no configuration in the arm's plane.
///
/// # Errors
/// [`Cancelled`].
pub(crate) fn conclude(task: &Task<'_>, dead: &[f64]) -> Result<Conclusion, Cancelled> {
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

/// Checks that a point \[m\] is farther away than the lengths of the links add up to: no configuration puts the tip there.
pub(crate) fn is_beyond_reach(task: &Task<'_>, point: &Vector3<f64>) -> bool {
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

/// Checks that joint 6 alone turns the tool about its own axis, and can go all the way round: then every yaw reaches the same
/// points.
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
