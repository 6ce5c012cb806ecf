//! Why no posture was found.

use super::inverse::Start;
use super::obstacle::{Filter, Obstacle};
use super::search::Graph;
use super::task::{Stop, Task, check_step};
use nalgebra::Vector3;
use platewash_kinematics::ik::IkSettingsError;
use platewash_workcell::clearance::ClearanceError;
use std::fmt;

/// A contact point at which no tilt is left.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadEnd {
    /// Parameter of the stroke \[rad\].
    pub theta: f64,
    /// The contact point \[m\], base frame.
    pub position_m: Vector3<f64>,
    /// What stood in the way, one entry a filter: the most frequent first.
    pub reasons: Vec<Reason>,
}

/// A filter and what it rejected at one contact point.
#[derive(Debug, Clone, PartialEq)]
pub struct Reason {
    /// Tilts that it rejected.
    pub tilts: usize,
    /// The least of the obstacles.
    pub least: Obstacle,
}

/// Why no posture was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PostureError {
    /// A number that makes no sense.
    #[error("{name} must be in [{least}, {most}]; found {found}")]
    Input {
        /// Its name.
        name: &'static str,
        /// Least value.
        least: f64,
        /// Greatest value.
        most: f64,
        /// What was given.
        found: f64,
    },
    /// There is no such plate.
    #[error("there is no plate {plate}; there are {count}")]
    Plate {
        /// Index of the plate.
        plate: usize,
        /// How many there are.
        count: usize,
    },
    /// The inverse kinematics refused its settings.
    #[error(transparent)]
    Ik(#[from] IkSettingsError),
    /// No clearance model can be made of the arm.
    #[error(transparent)]
    Clearance(#[from] ClearanceError),
    /// At some contact points no tilt within the limit was found reachable, within the joint limits and clear.
    #[error("plate {plate}: no tilt was found at {dead} of {tried} points of the stroke; {}", at(.ends))]
    NoTilt {
        /// Index of the plate.
        plate: usize,
        /// Points without a tilt.
        dead: usize,
        /// Points tried.
        tried: usize,
        /// Those points, at most [`MOST_DEAD_ENDS`] of them, evenly chosen.
        ends: Vec<DeadEnd>,
    },
    /// Every contact point has a tilt, but no continuous sequence of them was found within the joint steps and tilt rate allowed.
    #[error("plate {plate}: no way was found that connects the tilts that will do; {}", at(std::slice::from_ref(.end)))]
    Disconnected {
        /// Index of the plate.
        plate: usize,
        /// Where the last of the sequences ends.
        end: DeadEnd,
    },
    /// The sequence of tilts found fails between the points searched.
    #[error("plate {plate}: {}", at(std::slice::from_ref(.end)))]
    Between {
        /// Index of the plate.
        plate: usize,
        /// Where.
        end: DeadEnd,
    },
}

/// The most dead ends that an error lists.
pub const MOST_DEAD_ENDS: usize = 24;

impl fmt::Display for DeadEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z]: [f64; 3] = self.position_m.into();
        write!(f, "at θ = {:.3} rad, ({x:.3}, {y:.3}, {z:.3}) m:", self.theta)?;
        for (k, reason) in self.reasons.iter().enumerate() {
            let separator = if k == 0 { "" } else { ";" };
            write!(f, "{separator} {} ({} of the tilts)", reason.least, reason.tilts)?;
        }
        Ok(())
    }
}

/// The first of some dead ends, in words.
fn at(ends: &[DeadEnd]) -> String {
    ends.first().map_or_else(String::new, ToString::to_string)
}

/// Obstacles by filter: the most frequent filter first, each with the least of its obstacles.
pub(super) fn reasons(obstacles: impl IntoIterator<Item = Obstacle>) -> Vec<Reason> {
    let mut found: Vec<(Filter, Reason)> = Vec::new();
    for obstacle in obstacles {
        let filter = obstacle.filter();
        match found.iter_mut().find(|(known, _)| *known == filter) {
            Some((_, reason)) => {
                reason.tilts += 1;
                if obstacle.shortfall() < reason.least.shortfall() {
                    reason.least = obstacle;
                }
            }
            None => found.push((
                filter,
                Reason {
                    tilts: 1,
                    least: obstacle,
                },
            )),
        }
    }
    found.sort_by(|(f, a), (g, b)| b.tilts.cmp(&a.tilts).then(f.cmp(g)));
    found.into_iter().map(|(_, reason)| reason).collect()
}

/// The failure of a search on the branch of `start`, whose first layer without a way is `layer`.
pub(super) fn no_tilt(task: &Task<'_>, graph: &Graph, plate: usize, layer: usize, start: &Start) -> PostureError {
    let mut here = *start;
    let (mut dead, mut at_layer) = (Vec::new(), here);
    for k in graph.surveyed() {
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
        return PostureError::Disconnected { plate, end };
    }
    let every = dead.len().div_ceil(MOST_DEAD_ENDS);
    let ends = dead.iter().step_by(every);
    PostureError::NoTilt {
        plate,
        dead: dead.len(),
        tried: graph.surveyed().len(),
        ends: ends.map(|(k, near)| dead_end(task, graph, *k, near)).collect(),
    }
}

/// The failure of a searched path between its layers.
pub(super) fn between(task: &Task<'_>, plate: usize, stop: Stop) -> PostureError {
    let end = DeadEnd {
        theta: task.samples.theta[stop.sample],
        position_m: task.samples.contact[stop.sample],
        reasons: reasons([stop.obstacle]),
    };
    PostureError::Between { plate, end }
}

/// What stands in the way of every tilt of a layer.
pub(super) fn dead_end(task: &Task<'_>, graph: &Graph, layer: usize, near: &Start) -> DeadEnd {
    let theta = graph.theta[layer];
    let position_m = task.samples.at(theta);
    let obstacle = |&tilt: &f64| {
        let target = task.cell.tip_rigid(&position_m, tilt);
        match task.posture(&target, near) {
            Ok(q) => check_step(&near.q, &q, graph.spacing_m).err(),
            Err(obstacle) => Some(obstacle),
        }
    };
    DeadEnd {
        theta,
        position_m,
        reasons: reasons(graph.tilts.iter().filter_map(obstacle)),
    }
}
