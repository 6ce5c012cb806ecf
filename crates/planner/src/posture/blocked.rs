//! Plates that cannot be washed, known from a few contact points before any search.
//!
//! A search along the stroke fails where some contact point has no posture at all, whatever the branch and the way there. The
//! points farthest from the plate's centre are the likeliest: the farthest from axis 1 may be out of reach, the nearest too
//! close to the base. So the last turn is looked at, on every branch and at every tilt that the search would try.

use super::Cell;
use super::error::{self, PostureError};
use super::inverse::{Start, Width};
use super::search::Graph;
use super::settings::PostureSettings;
use super::task::Task;
use crate::trig::atan2;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::stroke::Stroke;
use std::f64::consts::TAU;

/// Contact points looked at: even, so that the farthest from axis 1 and the nearest are among them.
const POINTS: u32 = 16;

/// Whether some contact point of the last turn has no posture among those that a search would try; `false` says nothing.
/// Arguments as for [`super::washing`].
///
/// # Errors
/// [`PostureError`] for numbers out of range.
pub(crate) fn is_blocked(
    cell: &Cell<'_>,
    stroke: &Stroke,
    centre: Vector3<f64>,
    plate: usize,
    settings: &PostureSettings,
    near: &JointVector,
) -> Result<bool, PostureError> {
    let task = Task::new(cell, stroke, centre, plate, settings, near)?;
    let graph = Graph::new(&task, settings);
    let blocked = last_turn(&task, &graph).into_iter().any(|k| at(&task, &graph, k, near));
    Ok(blocked)
}

/// Why no search can find a way, if points of the last turn show it.
pub(super) fn blocked(task: &Task<'_>, graph: &Graph, plate: usize, near: &JointVector) -> Option<PostureError> {
    let layers = last_turn(task, graph);
    let tried = layers.len();
    let dead: Vec<usize> = layers.into_iter().filter(|&k| at(task, graph, k, near)).collect();
    let anywhere = Start { q: *near, sides: None };
    let ends = dead.iter().map(|&k| error::dead_end(task, graph, k, &anywhere));
    (!dead.is_empty()).then(|| PostureError::NoTilt {
        plate,
        dead: dead.len(),
        tried,
        ends: ends.collect(),
    })
}

/// The layers to look at; none where not every branch of the arm is known.
fn last_turn(task: &Task<'_>, graph: &Graph) -> Vec<usize> {
    if !task.cell.inverse.knows_all_branches() {
        return Vec::new();
    }
    let stroke = &task.samples.stroke;
    let out = task.cell.seen(&task.samples.centre).out;
    // θ of the farthest point from axis 1 is this much before the end.
    let before = (stroke.start_angle_rad + stroke.end() - atan2(out.y, out.x)).rem_euclid(TAU);
    let theta = |k: u32| stroke.end() - (before + TAU * f64::from(k) / f64::from(POINTS)) % TAU;
    let nearest = |theta: f64| {
        let after = graph.theta.partition_point(|other| *other < theta);
        let nearer = |a: &usize, b: &usize| {
            let off = |k: usize| (graph.theta[k] - theta).abs();
            off(*a).total_cmp(&off(*b))
        };
        let beside = after.saturating_sub(1)..graph.theta.len().min(after + 1);
        beside.min_by(nearer)
    };
    let mut layers: Vec<_> = (0..POINTS).map(theta).filter_map(nearest).collect();
    layers.sort_unstable();
    layers.dedup();
    layers
}

/// Whether a layer has no posture at any tilt, on any branch.
fn at(task: &Task<'_>, graph: &Graph, layer: usize, near: &JointVector) -> bool {
    let contact = task.samples.at(graph.theta[layer]);
    let will_do = |tilt: f64| {
        let target = task.cell.tip_rigid(&contact, tilt);
        let starts = task.cell.inverse.starts(&target, near, Width::Near).unwrap_or_default();
        starts.iter().any(|start| task.check_clear(&start.q).is_ok())
    };
    !graph.likeliest_first(task, &contact).into_iter().any(will_do)
}
