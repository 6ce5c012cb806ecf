//! Extent to which configurations are found along a wash path, and the causes where none is. It says nothing of other paths.

use crate::placed_arm::{Filter, Hindrance, Start};
use crate::redundancy::error::Reason;
use crate::redundancy::search::Graph;
use crate::redundancy::stuck::reasons;
use crate::redundancy::task::Task;
use crate::redundancy::washing::search_starts;
use platewash_workcell::cancel::Cancelled;
use std::fmt;

/// The part of a plate that can be washed along a path, where it is not the whole.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WashablePart {
    /// Share of the wash path with a configuration at some tilt.
    pub share: f64,
    /// The parts of the rest, by their obstruction, the largest first: they add up to the rest.
    pub causes: Vec<Cause>,
    /// The contact points that were checked.
    pub points: Points,
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

/// The part in percent, where it lies, and by how much it is missed at most, rounded to the worse.
impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [near, far] = self.from_axis_m;
        let share = 100.0 * self.share;
        write!(
            f,
            "{share:.1} %, {near:.3} to {far:.3} m from axis 1, no configuration found ("
        )?;
        for (k, worst) in self.worst.iter().enumerate() {
            f.write_str(match k {
                0 if self.worst.len() == 1 => "",
                0 => "at some tilts ",
                _ => ", at others ",
            })?;
            worst.fmt_worst(f)?;
        }
        f.write_str(")")
    }
}

/// Determines the part of a wash path for which configurations are found, where no policy of tilts follows all of it. `None` where each contact
/// point on its own has one. (That they connect is for [`crate::redundancy::washing()`] to find; it always did.)
///
/// # Errors
/// [`Cancelled`].
pub fn washable_part(task: &Task<'_>) -> Result<Option<WashablePart>, Cancelled> {
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
        return Ok(None);
    }
    let tried = graph.surveyed().len() as f64;
    let mut unwashed = Vec::with_capacity(best.len());
    for (k, here) in &best {
        task.placed.check_cancelled()?;
        let contact = task.samples.at(graph.theta[*k]);
        let hindrance = |&tilt: &f64| task.configuration(&task.placed.tip_rigid(&contact, tilt), here).err();
        let reasons = reasons(graph.tilts.iter().filter_map(hindrance));
        unwashed.push((task.placed.distance(&contact.point), reasons));
    }
    Ok(Some(WashablePart {
        share: 1.0 - best.len() as f64 / tried,
        causes: causes(unwashed, tried),
        points: points(task, &graph, &best),
    }))
}

/// The contact points of a survey, by whether their layer is among the `unwashed`.
fn points(task: &Task<'_>, graph: &Graph, unwashed: &[EmptyLayer]) -> Points {
    let dead = |k: &usize| unwashed.binary_search_by_key(k, |(layer, _)| *layer).is_ok();
    let place = |k: usize| task.placed.in_world(&task.samples.at(graph.theta[k]).point).into();
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
        task.placed.check_cancelled()?;
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
