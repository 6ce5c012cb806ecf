//! What stands in the way where a search finds nothing.

use super::error::{DeadEnd, MOST_DEAD_ENDS, Reason, RedundancyError};
use super::search::Graph;
use super::task::{Stop, Task, check_step};
use crate::scene::{Filter, Hindrance, Start};

/// Hindrances by filter: the most frequent filter first, each with the least of its hindrances.
pub(super) fn reasons(hindrances: impl IntoIterator<Item = Hindrance>) -> Vec<Reason> {
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
pub(super) fn no_tilt(task: &Task<'_>, graph: &Graph, layer: usize, start: &Start) -> RedundancyError {
    let (plate, mut here) = (task.path.plate, *start);
    let (mut dead, mut at_layer) = (Vec::new(), here);
    for k in graph.surveyed() {
        if let Err(cancelled) = task.scene.check_cancelled() {
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
pub(super) fn between(task: &Task<'_>, stop: Stop) -> RedundancyError {
    let plate = task.path.plate;
    let end = DeadEnd {
        theta: task.samples.theta[stop.sample],
        position_m: task.scene.in_world(&task.samples.contact[stop.sample].point),
        reasons: reasons([stop.hindrance]),
    };
    RedundancyError::Between { plate, end }
}

/// What stands in the way of every tilt of a layer.
pub(super) fn dead_end(task: &Task<'_>, graph: &Graph, layer: usize, near: &Start) -> DeadEnd {
    let theta = graph.theta[layer];
    let contact = task.samples.at(theta);
    let hindrance = |&tilt: &f64| {
        let target = task.scene.tip_rigid(&contact, tilt);
        match task.configuration(&target, near) {
            Ok(q) => check_step(&near.q, &q, graph.spacing_m).err(),
            Err(hindrance) => Some(hindrance),
        }
    };
    DeadEnd {
        theta,
        position_m: task.scene.in_world(&contact.point),
        reasons: reasons(graph.tilts.iter().filter_map(hindrance)),
    }
}
