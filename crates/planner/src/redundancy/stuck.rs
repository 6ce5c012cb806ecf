//! Plates that cannot be washed, known from a few contact points before any search.
//!
//! A search along a wash path fails where some contact point has no configuration at all, on any branch and after any points. The
//! points farthest from the plate's centre are the likeliest: the farthest from axis 1 may be out of reach, the nearest too close
//! to the base. So the last turn is checked, on every branch and at every tilt that the search would try.
//!
//! Dead ends: the obstructions where a search finds nothing.

use crate::placed_arm::{Filter, Hindrance, Start, Width};
use crate::redundancy::error::{DeadEnd, MOST_DEAD_ENDS, Reason, RedundancyError};
use crate::redundancy::lean_aside::{leans, obstacle_blocks_at};
use crate::redundancy::search::Graph;
use crate::redundancy::task::{Stop, Task, check_step};
use platewash_kinematics::trig::atan2;
use platewash_workcell::cancel::Cancelled;
use std::f64::consts::TAU;

/// Number of contact points that are checked: even, so that the farthest from axis 1 and the nearest are among them.
const POINTS: u32 = 16;

/// Checks for a contact point of the last turn without a configuration among those that a search would try; `false` proves
/// nothing.
///
/// # Errors
/// [`Cancelled`].
pub fn is_blocked(task: &Task<'_>) -> Result<bool, Cancelled> {
    let graph = Graph::new(task);
    let Some(layer) = first_dead(task, &graph)? else {
        return Ok(false);
    };
    if !obstacle_blocks_at(task, &dead_end(task, &graph, layer, &task.anywhere_near())) {
        return Ok(true);
    }
    for aside_rad in leans(task) {
        let placed = task.placed.clone().leaning_aside(aside_rad);
        let leaning = task.with_arm(&placed);
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

/// Returns the reason that no search can find anything, if points of the last turn show it.
pub(crate) fn blocked(task: &Task<'_>, graph: &Graph) -> Result<Option<RedundancyError>, Cancelled> {
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

/// Returns the layers to check; none where not every branch of the arm is known.
fn last_turn(task: &Task<'_>, graph: &Graph) -> Vec<usize> {
    if !task.placed.inverse.knows_all_branches() {
        return Vec::new();
    }
    let curve = &task.path.curve;
    let out = task.placed.outward_direction(&task.centre());
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

/// Checks that a layer has no configuration at any tilt, on any branch.
fn at(task: &Task<'_>, graph: &Graph, layer: usize) -> Result<bool, Cancelled> {
    let contact = task.samples.at(graph.theta[layer]);
    for tilt in graph.tilts_by_preference(task, &contact) {
        task.placed.check_cancelled()?;
        let target = task.placed.tip_rigid(&contact, tilt);
        if task.check_cone(&contact, &target).is_err() {
            continue;
        }
        let starts = task.placed.inverse.starts(&target, &task.near, Width::Near);
        if starts.unwrap_or_default().iter().any(|start| task.is_allowed(&start.q)) {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Hindrances by filter: the most frequent filter first, each with the least of its hindrances.
pub(crate) fn reasons(hindrances: impl IntoIterator<Item = Hindrance>) -> Vec<Reason> {
    let mut found: Vec<(Filter, Reason)> = Vec::new();
    for hindrance in hindrances {
        let filter = hindrance.filter();
        match found.iter_mut().find(|(known, _)| *known == filter) {
            Some((_, reason)) => {
                reason.tilts += 1;
                if hindrance.shortfall() < reason.least.shortfall() {
                    reason.least = hindrance;
                }
            }
            None => found.push((
                filter,
                Reason {
                    tilts: 1,
                    least: hindrance,
                },
            )),
        }
    }
    found.sort_by(|(f, a), (g, b)| b.tilts.cmp(&a.tilts).then(f.cmp(g)));
    found.into_iter().map(|(_, reason)| reason).collect()
}

/// The failure of a search on the branch of `start`, whose first layer without a path to it is `layer`.
pub(crate) fn no_tilt(task: &Task<'_>, graph: &Graph, layer: usize, start: &Start) -> RedundancyError {
    let (plate, mut here) = (task.path.plate, *start);
    let (mut dead, mut at_layer) = (Vec::new(), here);
    for k in graph.surveyed() {
        if let Err(cancelled) = task.placed.check_cancelled() {
            return cancelled.into();
        }
        match graph.least_tilt(task, k, &here) {
            Some(q) => here.q = q,
            None => dead.push((k, here)),
        }
        if k < layer {
            at_layer = here;
        }
    }
    if dead.is_empty() {
        let end = dead_end(task, graph, layer, &at_layer);
        return RedundancyError::Disconnected { plate, end };
    }
    let every = dead.len().div_ceil(MOST_DEAD_ENDS);
    let ends = dead.iter().step_by(every);
    RedundancyError::NoTilt {
        plate,
        dead: dead.len(),
        tried: graph.surveyed().len(),
        ends: ends.map(|(k, near)| dead_end(task, graph, *k, near)).collect(),
    }
}

/// The failure of a searched path between its layers.
pub(crate) fn between(task: &Task<'_>, stop: Stop) -> RedundancyError {
    let plate = task.path.plate;
    let end = DeadEnd {
        theta: task.samples.theta[stop.sample],
        position_m: task.placed.in_world(&task.samples.contact[stop.sample].point),
        reasons: reasons([stop.hindrance]),
    };
    RedundancyError::Between { plate, end }
}

/// Returns the dead end of a layer: the hindrance at each of its tilts.
pub(crate) fn dead_end(task: &Task<'_>, graph: &Graph, layer: usize, near: &Start) -> DeadEnd {
    let theta = graph.theta[layer];
    let contact = task.samples.at(theta);
    let hindrance = |&tilt: &f64| {
        let target = task.placed.tip_rigid(&contact, tilt);
        match task.configuration(&target, near) {
            Ok(q) => check_step(&near.q, &q, graph.spacing_m).err(),
            Err(hindrance) => Some(hindrance),
        }
    };
    DeadEnd {
        theta,
        position_m: task.placed.in_world(&contact.point),
        reasons: reasons(graph.tilts.iter().filter_map(hindrance)),
    }
}
