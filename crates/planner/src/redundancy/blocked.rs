//! Plates that cannot be washed, known from a few contact points before any search.
//!
//! A search along a wash path fails where some contact point has no configuration at all, whatever the branch and the points
//! before it. The points farthest from the plate's centre are the likeliest: the farthest from axis 1 may be out of reach, the
//! nearest too close to the base. So the last turn is looked at, on every branch and at every tilt that the search would try.

use super::aside;
use super::dead_ends::dead_end;
use super::error::RedundancyError;
use super::search::Graph;
use super::task::Task;
use crate::scene::Width;
use crate::trig::atan2;
use platewash_workcell::cancel::Cancelled;
use std::f64::consts::TAU;

/// Contact points looked at: even, so that the farthest from axis 1 and the nearest are among them.
const POINTS: u32 = 16;

/// Whether some contact point of the last turn has no configuration among those that a search would try; `false` says nothing.
///
/// # Errors
/// [`Cancelled`].
pub fn is_blocked(task: &Task<'_>) -> Result<bool, Cancelled> {
    let graph = Graph::new(task);
    let Some(layer) = first_dead(task, &graph)? else {
        return Ok(false);
    };
    if !aside::may_help_at(task, &dead_end(task, &graph, layer, &task.anywhere_near())) {
        return Ok(true);
    }
    for aside_rad in aside::leans(task) {
        let scene = task.scene.clone().leaning_aside(aside_rad);
        let leaning = task.in_scene(&scene);
        if first_dead(&leaning, &Graph::new(&leaning))?.is_none() {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The first layer of the last turn without a configuration.
fn first_dead(task: &Task<'_>, graph: &Graph) -> Result<Option<usize>, Cancelled> {
    for layer in last_turn(task, graph) {
        if at(task, graph, layer)? {
            return Ok(Some(layer));
        }
    }
    Ok(None)
}

/// Why no search can find anything, if points of the last turn show it.
pub(super) fn blocked(task: &Task<'_>, graph: &Graph) -> Result<Option<RedundancyError>, Cancelled> {
    let layers = last_turn(task, graph);
    let (tried, mut dead) = (layers.len(), Vec::new());
    for layer in layers {
        if at(task, graph, layer)? {
            dead.push(layer);
        }
    }
    let anywhere = task.anywhere_near();
    let ends = dead.iter().map(|&layer| dead_end(task, graph, layer, &anywhere));
    Ok((!dead.is_empty()).then(|| RedundancyError::NoTilt {
        plate: task.path.plate,
        dead: dead.len(),
        tried,
        ends: ends.collect(),
    }))
}

/// The layers to look at; none where not every branch of the arm is known.
fn last_turn(task: &Task<'_>, graph: &Graph) -> Vec<usize> {
    if !task.scene.inverse.knows_all_branches() {
        return Vec::new();
    }
    let curve = &task.path.curve;
    let out = task.scene.out(&task.centre());
    let out = task.plate.pose.rotation.inverse_transform_vector(&out);
    // θ of the farthest point from axis 1 is this much before the end.
    let before = (curve.start_angle_rad + curve.end() - atan2(out.y, out.x)).rem_euclid(TAU);
    let theta = |k: u32| curve.end() - (before + TAU * f64::from(k) / f64::from(POINTS)) % TAU;
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

/// Whether a layer has no configuration at any tilt, on any branch.
fn at(task: &Task<'_>, graph: &Graph, layer: usize) -> Result<bool, Cancelled> {
    let contact = task.samples.at(graph.theta[layer]);
    for tilt in graph.likeliest_first(task, &contact) {
        task.scene.check_cancelled()?;
        let target = task.scene.tip_rigid(&contact, tilt);
        if task.check_cone(&contact, &target).is_err() {
            continue;
        }
        let starts = task.scene.inverse.starts(&target, &task.near, Width::Near);
        if starts.unwrap_or_default().iter().any(|start| task.is_allowed(&start.q)) {
            return Ok(false);
        }
    }
    Ok(true)
}
