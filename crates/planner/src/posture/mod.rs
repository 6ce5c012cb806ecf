//! The posture of the arm while it washes: tilt of the tool and configuration of the arm at every contact point.
//!
//! # What is sought
//!
//! A configuration for each contact point of a [`Stroke`], such that the tip is exactly there, the tool within `tilt_max`
//! of the plate's normal, the joints within their limits, the bodies clear of each other by the margin, and the joint path
//! continuous, on one branch of the arm.
//!
//! # Freedom
//!
//! The sponge is round, so yaw is free: it is chosen such that joints 4 and 6 rest, which takes the least joint travel
//! ([`Cell::tip_pose`]). Of the two directions in which the tool can tilt, the one in the arm's own vertical plane is
//! the useful one; only next to plates so near that the sponge comes over them does the tool lean away from them
//! ([`neighbours`]).
//!
//! # How
//!
//! 1. [`policy`]: a tilt by the distance from axis 1 alone. It mostly suffices, and costs one pass over the points.
//! 2. `search`: the cheapest path through a graph of tilts along the stroke, near the policy where that will do, smoothed
//!    (`spline`) as far as it stays within what will do.
//!
//! Each is tried on every branch of the arm, elbow up in front first. Whatever answers has been checked at every
//! contact point. Where nothing answers, the error names contact points and what stands in the way there.

mod cell;
mod error;
pub mod exhaustive;
mod inverse;
mod neighbours;
mod obstacle;
pub mod policy;
mod samples;
mod search;
pub mod settings;
mod spline;
mod task;
#[cfg(test)]
mod tests;
pub mod washable;

pub use cell::Cell;
pub use error::{DeadEnd, MOST_DEAD_ENDS, PostureError, Reason};
pub use obstacle::{Filter, Obstacle};
pub use policy::TiltPolicy;
pub use settings::PostureSettings;

use crate::layout::Plate;
use crate::stroke::Stroke;
use inverse::{Start, merge_starts};
use nalgebra::Vector3;
use neighbours::Neighbours;
use platewash_kinematics::JointVector;
use samples::Samples;
use search::{Graph, GraphPath};
use settings::check_input;
use spline::{TiltSpline, smoothed};
use task::{Profile, Stop, Task};

/// Passes of smoothing tried on a searched path, the smoothest first.
const SMOOTHING: [usize; 6] = [256, 64, 16, 4, 1, 0];

/// How a plate is washed.
#[derive(Debug, Clone, PartialEq)]
pub struct Washing {
    /// Parameters of the stroke, from 0 to its end, as [`Stroke::parameters`] gives them for
    /// [`settings::CHORD_ERROR_M`] \[rad\].
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
#[derive(Debug, Clone, Copy, PartialEq)]
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
    let task = task(cell, stroke, centre, plate, settings, near)?;
    if let Some(washing) = by_policy(&task, settings, near) {
        return Ok(washing);
    }
    by_search(&task, plate, settings, near)
}

/// The task, if the input makes sense.
fn task<'a>(
    cell: &'a Cell<'a>,
    stroke: &Stroke,
    centre: Vector3<f64>,
    plate: usize,
    settings: &PostureSettings,
    near: &JointVector,
) -> Result<Task<'a>, PostureError> {
    settings.validate()?;
    check_input(stroke, &centre, near)?;
    let count = cell.plates.len();
    let here = cell.plates.get(plate).ok_or(PostureError::Plate { plate, count })?;
    let touches = |other: &Plate| std::ptr::eq(other, here) || overlap(here, other);
    let (radius, most) = (stroke.radius_m, settings.tilt_max_rad);
    let spared = cell.plates.iter().filter(|other| !touches(other));
    Ok(Task {
        cell,
        samples: Samples::new(stroke, centre),
        working: (0..count).filter(|&i| touches(&cell.plates[i])).collect(),
        neighbours: Neighbours::reached(spared, &centre, radius, cell.sponge_radius_m, most),
        required_m: settings.required_m(),
    })
}

/// Whether two plates share a place.
fn overlap(a: &Plate, b: &Plate) -> bool {
    let apart = Vector3::new(a.x_m - b.x_m, a.y_m - b.y_m, 0.0).norm();
    let above = |top: &Plate, bottom: &Plate| top.z_m - top.thickness_m > bottom.z_m;
    apart < a.radius_m + b.radius_m && !above(a, b) && !above(b, a)
}

/// The policies worth trying, the best first: those that slope over the plate take the least joint travel, those that stay
/// upright keep the most clearance.
fn policies(task: &Task<'_>, settings: &PostureSettings) -> Vec<TiltPolicy> {
    let most = settings.tilt_max_rad;
    let gentle = most.min(policy::GENTLE_TILT_RAD);
    let mut amplitudes = vec![gentle];
    amplitudes.extend((most > gentle).then_some(most));
    let (centre, radius) = (task.samples.centre, task.samples.stroke.radius_m);
    let both = |&tilt: &f64| {
        let sloping = TiltPolicy::sloping(tilt, task.cell.seen(&centre).r, radius);
        [sloping, TiltPolicy::upright(tilt)]
    };
    amplitudes.iter().flat_map(both).collect()
}

/// The washing by the first policy that will do.
fn by_policy(task: &Task<'_>, settings: &PostureSettings, near: &JointVector) -> Option<Washing> {
    policies(task, settings).into_iter().find_map(|policy| {
        let profile = Profile::Policy(policy);
        let tilts = task.tilts(&profile);
        let first = task.target(&task.samples.contact[0], tilts[0]);
        let starts = task.cell.inverse.starts(&first, near).unwrap_or_default();
        let q = starts.iter().find_map(|start| task.follow(&tilts, start).ok())?;
        Some(finish(task, &profile, tilts, q, How::Policy(policy)))
    })
}

/// The washing by the cheapest path through the graph of tilts.
fn by_search(
    task: &Task<'_>,
    plate: usize,
    settings: &PostureSettings,
    near: &JointVector,
) -> Result<Washing, PostureError> {
    let graph = Graph::new(task, settings);
    let starts = search_starts(task, &graph, near);
    let mut furthest: Option<(usize, Start)> = None;
    let mut between = None;
    for start in starts {
        match graph.cheapest(task, &start) {
            Ok(path) => match smooth(task, &graph, &path, &start) {
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

/// The branches on which some tilt reaches the first contact point, those of the smallest tilts first.
fn search_starts(task: &Task<'_>, graph: &Graph, near: &JointVector) -> Vec<Start> {
    let mut tilts = graph.tilts.clone();
    tilts.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let mut starts = Vec::new();
    for tilt in tilts {
        let target = task.target(&task.samples.contact[0], tilt);
        merge_starts(&mut starts, task.cell.inverse.starts(&target, near).unwrap_or_default());
    }
    starts
}

/// The path's tilts, as smooth as they can be and still do.
fn smooth(task: &Task<'_>, graph: &Graph, path: &GraphPath, start: &Start) -> Result<Washing, Stop> {
    let rough: Vec<f64> = path.tilt.iter().map(|&j| graph.tilts[j]).collect();
    let start = Start {
        q: path.first,
        ..*start
    };
    let mut last_stop = None;
    for smoothing in SMOOTHING {
        let profile = Profile::Spline(TiltSpline {
            control_rad: smoothed(&rough, &path.ranges, smoothing),
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
fn finish(task: &Task<'_>, profile: &Profile, tilts: Vec<f64>, q: Vec<JointVector>, how: How) -> Washing {
    let theta = task.samples.theta.clone();
    let last = q.len() - 1;
    let contacts = task.samples.contact.iter();
    let tilt_rad = contacts
        .zip(&tilts)
        .map(|(contact, &tilt)| task.whole_tilt(contact, tilt))
        .collect();
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
