//! How a plate is washed: the policies in turn, then the search.

use super::blocked::blocked;
use super::inverse::{Start, Width, merge_starts};
use super::policy::GENTLE_TILT_RAD;
use super::search::{Graph, GraphPath};
use super::spline::{TiltSpline, smoothed};
use super::task::{Profile, Stop, Task};
use super::{Cell, Obstacle, PostureError, PostureSettings, TiltPolicy, error};
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::stroke::Stroke;
use serde::Serialize;
use std::fmt;

/// Passes of smoothing tried on a searched path, the smoothest first.
const SMOOTHING: [usize; 6] = [256, 64, 16, 4, 1, 0];

/// How a plate is washed.
#[derive(Debug, Clone, PartialEq)]
pub struct Washing {
    /// Parameters of the stroke, from 0 to its end, as [`Stroke::parameters`] gives them for
    /// [`super::settings::CHORD_ERROR_M`] \[rad\].
    pub theta: Vec<f64>,
    /// Tilt of the tool at each: its angle from the plate's normal, positive where the flange leans away from axis 1 \[rad\].
    pub tilt_rad: Vec<f64>,
    /// Configuration of the arm at each \[rad\].
    pub q: Vec<JointVector>,
    /// dq/dθ at the first and at the last.
    pub end_slopes: [JointVector; 2],
    /// How the tilt was chosen.
    pub how: How,
}

/// How the tilt was chosen.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum How {
    /// By the distance from axis 1.
    Policy(TiltPolicy),
    /// By a search along the stroke.
    Search {
        /// Passes of smoothing that its path bore.
        smoothing: usize,
    },
}

impl fmt::Display for How {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Policy(policy) => write!(f, "tilt by distance, up to {:.1}°", policy.tilt_rad.to_degrees()),
            Self::Search { .. } => f.write_str("tilt searched along the path"),
        }
    }
}

impl Washing {
    /// Joint travel `Σ_k Σ_i |q_i(k+1) − q_i(k)|` \[rad\].
    #[must_use]
    pub fn travel_rad(&self) -> f64 {
        self.q.windows(2).map(|pair| (pair[1] - pair[0]).abs().sum()).sum()
    }
}

/// How to wash plate number `plate` along `stroke` around `centre` (base frame, at the height of the tip \[m\]), from a
/// configuration not far from `near` \[rad\].
///
/// # Errors
/// [`PostureError`]: a number out of range; or the contact points where nothing will do, and why.
pub fn washing(
    cell: &Cell<'_>,
    stroke: &Stroke,
    centre: Vector3<f64>,
    plate: usize,
    settings: &PostureSettings,
    near: &JointVector,
) -> Result<Washing, PostureError> {
    let task = Task::new(cell, stroke, centre, plate, settings, near)?;
    match by_policy(&task, settings, near, Width::Everywhere) {
        Some(washing) => Ok(washing),
        None => by_search(&task, plate, settings, near),
    }
}

/// The policies worth trying, the best first: those that slope over the plate take the least joint travel, those that stay
/// upright keep the most clearance.
pub(super) fn policies(task: &Task<'_>, settings: &PostureSettings) -> Vec<TiltPolicy> {
    let most = settings.tilt_max_rad;
    let gentle = most.min(GENTLE_TILT_RAD);
    let mut amplitudes = vec![gentle];
    amplitudes.extend((most > gentle).then_some(most));
    let (centre, radius) = (task.samples.centre, task.samples.stroke.radius_m);
    let both = |&tilt: &f64| {
        let sloping = TiltPolicy::sloping(tilt, task.cell.seen(&centre).r, radius);
        [sloping, TiltPolicy::upright(tilt)].map(|policy| within(policy, task, settings))
    };
    amplitudes.iter().flat_map(both).collect()
}

/// The policy, with less amplitude where on this stroke it would come nearer to the largest tilt than what follows may need.
fn within(policy: TiltPolicy, task: &Task<'_>, settings: &PostureSettings) -> TiltPolicy {
    let most = settings.planned_tilt_rad();
    let tilt = |point: &Vector3<f64>| policy.tilt(task.cell.seen(point).r).abs();
    let keeps = task.samples.contact.iter().all(|point| tilt(point) <= most);
    TiltPolicy {
        tilt_rad: if keeps {
            policy.tilt_rad
        } else {
            policy.tilt_rad.min(most)
        },
        ..policy
    }
}

/// The washing by the first policy that will do. Where branches are searched for, at most as widely as `widest`: first on
/// those that are found from nearby.
pub(super) fn by_policy(
    task: &Task<'_>,
    settings: &PostureSettings,
    near: &JointVector,
    widest: Width,
) -> Option<Washing> {
    let all = policies(task, settings);
    let with = |width| all.iter().find_map(|policy| with_policy(task, policy, near, width));
    with(Width::Near).or_else(|| {
        let more = widest == Width::Everywhere && !task.cell.inverse.knows_all_branches();
        more.then(|| with(Width::Everywhere)).flatten()
    })
}

/// The washing by one policy, on the first branch that will do.
fn with_policy(task: &Task<'_>, policy: &TiltPolicy, near: &JointVector, width: Width) -> Option<Washing> {
    let profile = Profile::Policy(*policy);
    let tilts = task.tilts(&profile);
    if !may_do(task, &tilts, near) {
        return None;
    }
    let first = task.cell.tip_rigid(&task.samples.contact[0], tilts[0]);
    let starts = task.cell.inverse.starts(&first, near, width).unwrap_or_default();
    let q = starts.iter().find_map(|start| task.follow(&tilts, start).ok())?;
    Some(finish(task, &profile, tilts, q, How::Policy(*policy)))
}

/// The washing by the cheapest path through the graph of tilts.
pub(super) fn by_search(
    task: &Task<'_>,
    plate: usize,
    settings: &PostureSettings,
    near: &JointVector,
) -> Result<Washing, PostureError> {
    let graph = Graph::new(task, settings);
    if let Some(error) = blocked(task, &graph, plate, near) {
        return Err(error);
    }
    let starts = search_starts(task, &graph, near);
    let mut furthest: Option<(usize, Start)> = None;
    let mut between = None;
    for start in starts {
        match graph.cheapest(task, &start) {
            Ok(path) => match smooth(task, &graph, &path, &start, settings) {
                Ok(washing) => return Ok(washing),
                Err(stop) => between = between.or(Some(stop)),
            },
            Err(layer) if furthest.is_none_or(|(other, _)| layer > other) => furthest = Some((layer, start)),
            Err(_) => {}
        }
    }
    Err(match (between, furthest) {
        (Some(stop), _) => error::between(task, plate, stop),
        (None, Some((layer, start))) => error::no_tilt(task, &graph, plate, layer, &start),
        (None, None) => {
            let start = Start { q: *near, sides: None };
            error::no_tilt(task, &graph, plate, 0, &start)
        }
    })
}

/// Whether some branch reaches the contact points nearest to axis 1 and farthest from it, where every branch is known: it spares
/// the way there.
fn may_do(task: &Task<'_>, tilts: &[f64], near: &JointVector) -> bool {
    let inverse = &task.cell.inverse;
    if !inverse.knows_all_branches() {
        return true;
    }
    let contact = &task.samples.contact;
    let mut extremes = [(0, f64::INFINITY), (0, f64::NEG_INFINITY)];
    for (k, point) in contact.iter().enumerate() {
        let r = task.cell.distance(point);
        if r < extremes[0].1 {
            extremes[0] = (k, r);
        }
        if r > extremes[1].1 {
            extremes[1] = (k, r);
        }
    }
    let reached = |k: usize| {
        let target = task.cell.tip_rigid(&contact[k], tilts[k]);
        inverse.starts(&target, near, Width::Near).is_ok()
    };
    extremes.iter().all(|(k, _)| reached(*k))
}

/// The branches on which some tilt reaches the first contact point, those of the smallest tilts first.
pub(super) fn search_starts(task: &Task<'_>, graph: &Graph, near: &JointVector) -> Vec<Start> {
    let mut tilts = graph.tilts.clone();
    tilts.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let inverse = &task.cell.inverse;
    if !inverse.knows_all_branches() {
        // A search for branches costs too much to be made at each.
        tilts = [tilts.first(), graph.tilts.first(), graph.tilts.last()]
            .into_iter()
            .flatten()
            .copied()
            .collect();
    }
    let mut starts = Vec::new();
    for tilt in tilts {
        let target = task.cell.tip_rigid(&task.samples.contact[0], tilt);
        let found = inverse.starts(&target, near, Width::Everywhere);
        merge_starts(&mut starts, found.unwrap_or_default());
    }
    starts
}

/// The path's tilts, as smooth as they can be and still do.
fn smooth(
    task: &Task<'_>,
    graph: &Graph,
    path: &GraphPath,
    start: &Start,
    settings: &PostureSettings,
) -> Result<Washing, Stop> {
    // A spline stays between its control values: where those keep within what is planned, so do its tilts.
    let most = settings.planned_tilt_rad();
    let planned = |tilt: f64| tilt.clamp(-most, most);
    let rough: Vec<f64> = path.tilt.iter().map(|&j| planned(graph.tilts[j])).collect();
    let ranges: Vec<_> = path.ranges.iter().map(|range| range.map(planned)).collect();
    let start = Start {
        q: path.first,
        ..*start
    };
    let mut last_stop = None;
    for smoothing in SMOOTHING {
        let profile = Profile::Spline(TiltSpline {
            control_rad: smoothed(&rough, &ranges, smoothing),
            spacing_m: graph.spacing_m,
        });
        let tilts = task.tilts(&profile);
        match task.follow(&tilts, &start) {
            Ok(q) => return Ok(finish(task, &profile, tilts, q, How::Search { smoothing })),
            Err(stop) => last_stop = Some(stop),
        }
    }
    Err(last_stop.unwrap_or(Stop {
        sample: 0,
        obstacle: Obstacle::NotFinite,
    }))
}

/// The answer, with its slopes at the ends.
fn finish(task: &Task<'_>, profile: &Profile, tilt_rad: Vec<f64>, q: Vec<JointVector>, how: How) -> Washing {
    let theta = task.samples.theta.clone();
    let last = q.len() - 1;
    // At a singularity there is no slope; then the chord's.
    let chord = |a: usize, b: usize| (q[b] - q[a]) / (theta[b] - theta[a]);
    let slope = |k: usize, pair: [usize; 2]| task.slope(profile, k, &q[k]).unwrap_or_else(|| chord(pair[0], pair[1]));
    Washing {
        end_slopes: [slope(0, [0, 1]), slope(last, [last - 1, last])],
        theta,
        tilt_rad,
        q,
        how,
    }
}
