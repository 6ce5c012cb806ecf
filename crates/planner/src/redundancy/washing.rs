//! Washing of a plate: the policies in turn, then the search, both across the arm's plane too where obstacles beside the arm ask for it.
//!
//! A tilt in the arm's plane moves forearm and wrist towards axis 1 or away from it, along obstacles beside them. Where these are
//! in the way of every such tilt, the tool leans across the plane besides, by as much all along the wash path; both together stay
//! within the path's cone.

use crate::placed_arm::tilt_policy::GENTLE_TILT_RAD;
use crate::placed_arm::{Contact, Hindrance, Start, TiltPolicy, Width, merge_starts};
use crate::redundancy::error::RedundancyError;
use crate::redundancy::lean_aside::leans;
use crate::redundancy::lean_aside::obstacle_blocks;
use crate::redundancy::samples::{TiltSpline, smoothed};
use crate::redundancy::search::{Graph, GraphPath};
use crate::redundancy::stuck::{self, blocked};
use crate::redundancy::task::{Profile, Stop, Task};
use platewash_kinematics::JointVector;
use platewash_workcell::cancel::Cancelled;
use serde::Serialize;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Passes of smoothing tried on a searched path, the smoothest first.
const SMOOTHING: [usize; 6] = [256, 64, 16, 4, 1, 0];

/// Shares of the gentle tilt that are tried on faces that are not flat, the least first.
const PROFILE_STEPS: [f64; 4] = [0.0, 0.3, 0.6, 1.0];

/// Configurations and tilts that wash a plate.
#[derive(Debug, Clone, PartialEq)]
pub struct Washing {
    /// Parameters of the wash path, from 0 to its end, as
    /// [`WashCurve::parameters`](platewash_workcell::wash_path::WashCurve::parameters) gives them for
    /// [`crate::redundancy::samples::CHORD_ERROR_M`] \[rad\].
    pub theta: Vec<f64>,
    /// Tilt of the tool in the arm's plane at each: its angle from the plate's normal there, positive where the flange leans away from axis 1 \[rad\].
    pub tilt_rad: Vec<f64>,
    /// Lean of the tool across the arm's plane, the same all along: [`Stance::aside_rad`](crate::placed_arm::Stance::aside_rad)
    /// \[rad\].
    pub aside_rad: f64,
    /// Configuration of the arm at each \[rad\].
    pub q: Vec<JointVector>,
    /// The contact points at both ends.
    pub feet: [Contact; 2],
    /// dq/dθ at the first and at the last.
    pub end_slopes: [JointVector; 2],
    /// Source of the tilt.
    pub choice: TiltChoice,
}

/// Source of the tilt.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum TiltChoice {
    /// Tilt by the distance from axis 1.
    Policy(TiltPolicy),
    /// Tilt by a search along the wash path.
    Search {
        /// Passes of smoothing that its path bore.
        smoothing: usize,
    },
}

impl fmt::Display for TiltChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Policy(policy) => write!(f, "tilt up to {:.1}°", policy.tilt_rad.to_degrees()),
            Self::Search { .. } => f.write_str("tilt found by search along the path"),
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

/// Finds configurations and tilts that wash a plate.
///
/// # Errors
/// [`RedundancyError`]: the contact points without a feasible configuration, and the reason; or the search was cancelled.
pub fn washing(task: &Task<'_>) -> Result<Washing, RedundancyError> {
    let found = washing_by_any(task);
    let Err(error) = &found else {
        return found;
    };
    if obstacle_blocks(task, error) {
        for aside_rad in leans(task) {
            let placed = task.placed.clone().leaning_aside(aside_rad);
            match washing_by_any(&task.with_arm(&placed)) {
                Err(RedundancyError::Cancelled(cancelled)) => return Err(cancelled.into()),
                Err(_) => {}
                washing => return washing,
            }
        }
    }
    // The caller that plans the lines reports their obstructions.
    let is_blocked = |blocked: &Arc<AtomicBool>| blocked.load(Ordering::Relaxed);
    if task.blocked_line.as_ref().is_some_and(is_blocked) {
        return washing_by_any(&task.with_any_lines());
    }
    found
}

/// Finds a washing by a policy, or by the search.
fn washing_by_any(task: &Task<'_>) -> Result<Washing, RedundancyError> {
    match by_policy(task, Width::Everywhere)? {
        Some(washing) => Ok(washing),
        None => by_search(task),
    }
}

/// The policies worth trying, the best first: those that slope over the plate take the least joint travel, those that stay
/// upright keep the most clearance.
pub(crate) fn policies(task: &Task<'_>) -> Vec<TiltPolicy> {
    let most = task.tilt_max_rad();
    let gentle = most.min(GENTLE_TILT_RAD);
    // Where the axis follows the slope, the less it leans besides the better the sponge presses.
    let steps: &[f64] = if task.plate.surface.is_flat() {
        &[1.0]
    } else {
        &PROFILE_STEPS
    };
    let mut amplitudes: Vec<f64> = steps.iter().map(|share| share * gentle).collect();
    amplitudes.extend((most > gentle).then_some(most));
    let centre_m = task.placed.distance(&task.centre().point);
    let both = |&tilt: &f64| {
        let sloping = TiltPolicy::sloping(tilt, centre_m, task.path.curve.radius_m);
        [sloping, TiltPolicy::upright(tilt, &task.placed.reach)].map(|policy| within(policy, task))
    };
    amplitudes.iter().flat_map(both).collect()
}

/// The policy, with less amplitude where this wash path would otherwise bring it nearer to the largest tilt than the later steps
/// allow.
fn within(policy: TiltPolicy, task: &Task<'_>) -> TiltPolicy {
    let most = task.planned_tilt_rad();
    let tilt = |contact: &Contact| policy.tilt(task.placed.distance(&contact.point)).abs();
    let keeps = task.samples.contact.iter().all(|contact| tilt(contact) <= most);
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
pub(crate) fn by_policy(task: &Task<'_>, widest: Width) -> Result<Option<Washing>, Cancelled> {
    let all = policies(task);
    let near = first_of(task, &all, Width::Near)?;
    let more = widest == Width::Everywhere && !task.placed.inverse.knows_all_branches();
    if near.is_some() || !more {
        return Ok(near);
    }
    first_of(task, &all, Width::Everywhere)
}

fn first_of(task: &Task<'_>, policies: &[TiltPolicy], width: Width) -> Result<Option<Washing>, Cancelled> {
    for policy in policies {
        let washing = with_policy(task, policy, width)?;
        if washing.is_some() {
            return Ok(washing);
        }
    }
    Ok(None)
}

/// The washing by one policy, on the first feasible branch.
fn with_policy(task: &Task<'_>, policy: &TiltPolicy, width: Width) -> Result<Option<Washing>, Cancelled> {
    let profile = Profile::Policy(*policy);
    let tilts = task.tilts(&profile);
    if !extremes_are_reachable(task, &tilts) {
        return Ok(None);
    }
    let first = task.placed.tip_rigid(&task.samples.contact[0], tilts[0]);
    let starts = task.placed.inverse.starts(&first, &task.near, width);
    for start in starts.unwrap_or_default() {
        if let Ok(q) = task.follow(&tilts, &start)? {
            let choice = TiltChoice::Policy(*policy);
            return Ok(Some(finish(task, &profile, tilts, q, choice)));
        }
    }
    Ok(None)
}

/// The washing by the cheapest path through the graph of tilts.
pub(crate) fn by_search(task: &Task<'_>) -> Result<Washing, RedundancyError> {
    let graph = Graph::new(task);
    if let Some(error) = blocked(task, &graph)? {
        return Err(error);
    }
    let mut furthest: Option<(usize, Start)> = None;
    let mut between = None;
    for start in search_starts(task, &graph)? {
        match graph.cheapest(task, &start)? {
            Ok(path) => match smooth(task, &graph, &path, &start)? {
                Ok(washing) => return Ok(washing),
                Err(stop) => between = between.or(Some(stop)),
            },
            Err(layer) if furthest.is_none_or(|(other, _)| layer > other) => furthest = Some((layer, start)),
            Err(_) => {}
        }
    }
    Err(match (between, furthest) {
        (Some(stop), _) => stuck::between(task, stop),
        (None, Some((layer, start))) => stuck::no_tilt(task, &graph, layer, &start),
        (None, None) => stuck::no_tilt(task, &graph, 0, &task.anywhere_near()),
    })
}

/// Checks that some branch reaches the contact points nearest to axis 1 and farthest from it, on arms with every branch known: a
/// quick test before the whole path is tried.
fn extremes_are_reachable(task: &Task<'_>, tilts: &[f64]) -> bool {
    let inverse = &task.placed.inverse;
    if !inverse.knows_all_branches() {
        return true;
    }
    let contact = &task.samples.contact;
    let distance = |contact: &Contact| task.placed.distance(&contact.point);
    let distances: Vec<f64> = contact.iter().map(distance).collect();
    let farther = |a: &usize, b: &usize| distances[*a].total_cmp(&distances[*b]);
    let nearest = (0..contact.len()).min_by(farther);
    let farthest = (0..contact.len()).rev().max_by(farther);
    let reached = |k: usize| {
        let target = task.placed.tip_rigid(&contact[k], tilts[k]);
        inverse.starts(&target, &task.near, Width::Near).is_ok()
    };
    nearest.into_iter().chain(farthest).all(reached)
}

/// The branches on which some tilt reaches the first contact point, those of the smallest tilts first.
///
/// # Errors
/// [`Cancelled`].
pub(crate) fn search_starts(task: &Task<'_>, graph: &Graph) -> Result<Vec<Start>, Cancelled> {
    let mut tilts = graph.tilts.clone();
    tilts.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let inverse = &task.placed.inverse;
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
        task.placed.check_cancelled()?;
        let target = task.placed.tip_rigid(&task.samples.contact[0], tilt);
        let found = inverse.starts(&target, &task.near, Width::Everywhere);
        merge_starts(&mut starts, found.unwrap_or_default());
    }
    Ok(starts)
}

/// The path's tilts, as smooth as they can be and still do.
fn smooth(task: &Task<'_>, graph: &Graph, path: &GraphPath, start: &Start) -> Result<Result<Washing, Stop>, Cancelled> {
    // A spline stays between its control values: where those keep within the planned tilt, so does the spline.
    let most = task.planned_tilt_rad();
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
        match task.follow(&tilts, &start)? {
            Ok(q) => return Ok(Ok(finish(task, &profile, tilts, q, TiltChoice::Search { smoothing }))),
            Err(stop) => last_stop = Some(stop),
        }
    }
    Ok(Err(last_stop.unwrap_or(Stop {
        sample: 0,
        hindrance: Hindrance::NotFinite,
    })))
}

/// The answer, with its slopes at the ends.
fn finish(task: &Task<'_>, profile: &Profile, tilt_rad: Vec<f64>, q: Vec<JointVector>, choice: TiltChoice) -> Washing {
    let theta = task.samples.theta.clone();
    let last = q.len() - 1;
    // At a singularity there is no slope; then the chord's.
    let chord = |a: usize, b: usize| (q[b] - q[a]) / (theta[b] - theta[a]);
    let slope = |k: usize, pair: [usize; 2]| task.slope(profile, k, &q[k]).unwrap_or_else(|| chord(pair[0], pair[1]));
    let contact = &task.samples.contact;
    Washing {
        feet: [contact[0], contact[contact.len() - 1]],
        end_slopes: [slope(0, [0, 1]), slope(last, [last - 1, last])],
        theta,
        tilt_rad,
        aside_rad: task.placed.stance.aside_rad,
        q,
        choice,
    }
}
