//! Whether a plate can be washed whole where it lies; if not, which part of it not, and why.

use super::conclusion::{Conclusion, conclude};
use super::dead_ends::reasons;
use super::error::Reason;
use super::search::Graph;
use super::task::Task;
use super::washing::{by_policy, search_starts};
use crate::scene::{Filter, Hindrance, Start, Width};
use platewash_workcell::cancel::Cancelled;
use std::fmt;

/// What of a plate can be washed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Washable {
    /// Each contact point on its own. (That they connect is for [`super::washing()`] to find; it always did.)
    Whole,
    /// Not all of it.
    Part {
        /// Share of the wash path for which configurations were found, on the best branch of the arm.
        share: f64,
        /// The parts of the rest, by what stands in their way, the largest first: they add up to the rest.
        causes: Vec<Cause>,
        /// Whether the rest cannot be washed, or was only not found to be.
        conclusion: Conclusion,
        /// The contact points looked at.
        points: Points,
    },
}

/// Contact points looked at one by one, in the order of the wash path, world frame \[m\].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Points {
    /// Those for which configurations were found, on the best branch of the arm.
    pub free_m: Vec<[f64; 3]>,
    /// Those for which none were.
    pub dead_m: Vec<[f64; 3]>,
}

/// What keeps a part of a wash path from being washed.
#[derive(Debug, Clone, PartialEq)]
pub struct Cause {
    /// Share of the wash path.
    pub share: f64,
    /// Least and greatest distance of that part from axis 1 \[m\].
    pub from_axis_m: [f64; 2],
    /// Of each filter that leaves no tilt there, together with the others, the greatest of its hindrances, at each point that of the
    /// best tilt.
    pub worst: Vec<Hindrance>,
}

/// A [`Cause`] in words: the part in percent, where it lies, and by how much it is missed at most, rounded to the worse.
struct Words<'a>(&'a Cause, Conclusion);

impl fmt::Display for Words<'_> {
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
        Words(self, conclusion).to_string()
    }
}

/// What of a plate can be washed.
///
/// # Errors
/// [`Cancelled`].
pub fn washable(task: &Task<'_>) -> Result<Washable, Cancelled> {
    match by_policy(task, Width::Everywhere)? {
        Some(_) => Ok(Washable::Whole),
        None => washable_part(task),
    }
}

/// What of a plate can be washed that no policy of tilts washes.
///
/// # Errors
/// [`Cancelled`].
pub fn washable_part(task: &Task<'_>) -> Result<Washable, Cancelled> {
    let graph = Graph::new(task);
    let mut starts = search_starts(task, &graph)?;
    starts.push(task.anywhere_near());
    let mut best: Option<Vec<Unwashed>> = None;
    for start in &starts {
        let fewer_than = best.as_ref().map_or(usize::MAX, Vec::len);
        best = survey(task, &graph, start, fewer_than)?.or(best);
    }
    let best = best.unwrap_or_default();
    if best.is_empty() {
        return Ok(Washable::Whole);
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
    Ok(Washable::Part {
        share: 1.0 - best.len() as f64 / tried,
        causes: causes(unwashed, tried),
        conclusion,
        points: points(task, &graph, &best),
    })
}

/// The contact points of a survey, by whether their layer is among the `unwashed`.
fn points(task: &Task<'_>, graph: &Graph, unwashed: &[Unwashed]) -> Points {
    let dead = |k: &usize| unwashed.binary_search_by_key(k, |(layer, _)| *layer).is_ok();
    let place = |k: usize| task.scene.in_world(&task.samples.at(graph.theta[k]).point).into();
    let (dead, free): (Vec<usize>, Vec<usize>) = graph.surveyed().partition(dead);
    Points {
        free_m: free.into_iter().map(place).collect(),
        dead_m: dead.into_iter().map(place).collect(),
    }
}

/// A layer without a vertex, and where the arm was before.
type Unwashed = (usize, Start);

/// The layers of a graph without a vertex on the branch of `start`; `None` as soon as they are not fewer than asked.
fn survey(
    task: &Task<'_>,
    graph: &Graph,
    start: &Start,
    fewer_than: usize,
) -> Result<Option<Vec<Unwashed>>, Cancelled> {
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

/// Points, each with its distance from axis 1 \[m\], gathered by what stands in their way: by the set of the filters.
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
