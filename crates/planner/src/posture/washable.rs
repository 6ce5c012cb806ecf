//! Whether a plate can be washed whole where it lies; if not, which part of it not, and why.

use super::error::{Reason, reasons};
use super::inverse::Start;
use super::obstacle::Obstacle;
use super::search::Graph;
use super::task::Task;
use super::washing::{by_policy, search_starts};
use super::{Cell, PostureError, PostureSettings};
use crate::stroke::Stroke;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use std::fmt;

/// What of a plate can be washed.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Washable {
    /// Each contact point on its own. (That they connect is for [`super::washing`] to find; it always did.)
    Whole,
    /// Not all of it.
    Part {
        /// Share of the stroke that can be washed on the best branch of the arm.
        share: f64,
        /// What stands in the way of the rest, the most frequent first. Where several filters leave no tilt together, each
        /// is counted.
        causes: Vec<Cause>,
    },
}

/// What keeps a part of a stroke from being washed.
#[derive(Debug, Clone, PartialEq)]
pub struct Cause {
    /// Share of the stroke.
    pub share: f64,
    /// Least and greatest distance of that part from axis 1 \[m\].
    pub from_axis_m: [f64; 2],
    /// The greatest of the obstacles there, at each point that of the best tilt: without it all of the part could be washed.
    pub worst: Obstacle,
}

impl fmt::Display for Cause {
    /// The part in percent, where it lies, and by how much it is missed at most, rounded up.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [near, far] = self.from_axis_m;
        let share = 100.0 * self.share;
        write!(f, "{share:.1} %, {near:.3} to {far:.3} m from axis 1, cannot (")?;
        self.worst.fmt_worst(f)?;
        f.write_str(")")
    }
}

/// What of plate number `plate` can be washed along `stroke`. Arguments as for [`super::washing`].
///
/// # Errors
/// [`PostureError`] for numbers out of range.
pub fn washable(
    cell: &Cell<'_>,
    stroke: &Stroke,
    centre: Vector3<f64>,
    plate: usize,
    settings: &PostureSettings,
    near: &JointVector,
) -> Result<Washable, PostureError> {
    let task = Task::new(cell, stroke, centre, plate, settings, near)?;
    if by_policy(&task, settings, near).is_some() {
        return Ok(Washable::Whole);
    }
    let graph = Graph::new(&task, settings);
    let anywhere = Start { q: *near, sides: None };
    let mut starts = search_starts(&task, &graph, near);
    starts.push(anywhere);
    let surveys = starts.iter().map(|start| survey(&task, &graph, start));
    let best = surveys.min_by_key(Vec::len).unwrap_or_default();
    if best.is_empty() {
        return Ok(Washable::Whole);
    }
    let tried = graph.surveyed().len() as f64;
    Ok(Washable::Part {
        share: 1.0 - best.len() as f64 / tried,
        causes: causes(best, tried),
    })
}

/// A contact point that cannot be washed: its distance from axis 1 \[m\], and what stands in the way.
type Unwashed = (f64, Vec<Reason>);

/// The layers of a graph without a vertex on the branch of `start`.
fn survey(task: &Task<'_>, graph: &Graph, start: &Start) -> Vec<Unwashed> {
    let mut here = *start;
    let mut unwashed = Vec::new();
    for k in graph.surveyed() {
        if let Some(vertex) = graph.first(task, k, &here) {
            here.q = vertex.q;
            continue;
        }
        let contact = task.samples.at(graph.theta[k]);
        let obstacle = |&tilt: &f64| task.posture(&task.cell.tip_rigid(&contact, tilt), &here).err();
        let reasons = reasons(graph.tilts.iter().filter_map(obstacle));
        unwashed.push((task.cell.seen(&contact).r, reasons));
    }
    unwashed
}

/// Points gathered by what stands in their way.
fn causes(unwashed: Vec<Unwashed>, tried: f64) -> Vec<Cause> {
    let mut found: Vec<Cause> = Vec::new();
    let each = unwashed
        .into_iter()
        .flat_map(|(r, reasons)| reasons.into_iter().map(move |reason| (r, reason.least)));
    for (r, obstacle) in each {
        match found.iter_mut().find(|cause| cause.worst.filter() == obstacle.filter()) {
            Some(cause) => {
                cause.share += 1.0 / tried;
                cause.from_axis_m = [cause.from_axis_m[0].min(r), cause.from_axis_m[1].max(r)];
                if obstacle.shortfall() > cause.worst.shortfall() {
                    cause.worst = obstacle;
                }
            }
            None => found.push(Cause {
                share: 1.0 / tried,
                from_axis_m: [r, r],
                worst: obstacle,
            }),
        }
    }
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}
