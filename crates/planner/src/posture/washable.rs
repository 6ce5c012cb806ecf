//! Whether a plate can be washed whole where it lies; if not, which part of it not, why, and where it could lie instead.

use super::error::{Reason, reasons};
use super::inverse::Start;
use super::obstacle::Obstacle;
use super::search::Graph;
use super::task::{Task, overlap};
use super::washing::{by_policy, search_starts};
use super::{Cell, PostureError, PostureSettings};
use crate::clearance::ClearanceModel;
use crate::layout::Plate;
use crate::robot::base_footprint;
use crate::scenario::ToolSection;
use crate::stroke::Stroke;
use crate::trig::sin_cos;
use nalgebra::{Vector2, Vector3};
use platewash_kinematics::{JointVector, RobotModel};
use std::f64::consts::TAU;

/// Distance of the rings on which other positions are tried \[m\].
pub const RING_M: f64 = 0.02;

/// Rings tried.
pub const RINGS: u32 = 30;

/// Positions tried on a ring.
const DIRECTIONS: u32 = 24;

/// Halvings between a ring and the one within it.
const HALVINGS: u32 = 6;

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
    /// The least of the obstacles there.
    pub least: Obstacle,
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
        let vertices = graph.layer(task, k, None, &here);
        if let Some(vertex) = vertices.iter().flatten().next() {
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
    for (r, least) in each {
        match found.iter_mut().find(|cause| cause.least.filter() == least.filter()) {
            Some(cause) => {
                cause.share += 1.0 / tried;
                cause.from_axis_m = [cause.from_axis_m[0].min(r), cause.from_axis_m[1].max(r)];
                if least.shortfall() < cause.least.shortfall() {
                    cause.least = least;
                }
            }
            None => found.push(Cause {
                share: 1.0 / tried,
                from_axis_m: [r, r],
                least,
            }),
        }
    }
    found.sort_by(|a, b| b.share.total_cmp(&a.share));
    found
}

/// Where to look for a better position of a plate.
#[derive(Debug, Clone, Copy)]
pub struct Move<'a> {
    /// The arm.
    pub robot: &'a RobotModel,
    /// Its tool.
    pub tool: &'a ToolSection,
    /// All plates.
    pub plates: &'a [Plate],
    /// Index of the one to move.
    pub plate: usize,
    /// The stroke on it.
    pub stroke: &'a Stroke,
    /// Height of the tip above its washing surface \[m\].
    pub height_m: f64,
    /// What a posture must keep.
    pub settings: &'a PostureSettings,
    /// The configuration it starts not far from \[rad\].
    pub near: &'a JointVector,
}

impl Move<'_> {
    /// The nearest centre (x, y) \[m\] at which the plate can be washed whole by a policy of tilts and overlaps neither another
    /// plate nor the base; `None` within [`RINGS`] × [`RING_M`] of where it lies. Tried in 24 directions on growing rings, then
    /// halved towards where it lies: right to about a tenth of its distance.
    ///
    /// # Errors
    /// [`PostureError`] for numbers out of range, and for an arm of which no clearance model can be made.
    pub fn nearest_washable(&self) -> Result<Option<Vector2<f64>>, PostureError> {
        let count = self.plates.len();
        let missing = PostureError::Plate {
            plate: self.plate,
            count,
        };
        let here = self.plates.get(self.plate).ok_or(missing)?;
        let here = Vector2::new(here.x_m, here.y_m);
        if self.suits(&here)? {
            return Ok(Some(here));
        }
        for ring in 1..=RINGS {
            let mut best: Option<f64> = None;
            let mut found = None;
            for k in 0..DIRECTIONS {
                let (s, c) = sin_cos(TAU * f64::from(k) / f64::from(DIRECTIONS));
                let away = Vector2::new(c, s);
                if !self.suits(&(here + away * (RING_M * f64::from(ring))))? {
                    continue;
                }
                let distance = self.halve(&here, &away, ring)?;
                if best.is_none_or(|least| distance < least) {
                    best = Some(distance);
                    found = Some(here + away * distance);
                }
            }
            if found.is_some() {
                return Ok(found);
            }
        }
        Ok(None)
    }

    /// The least distance from `here` in a direction that suits, between a ring that does and the one within it \[m\].
    fn halve(&self, here: &Vector2<f64>, away: &Vector2<f64>, ring: u32) -> Result<f64, PostureError> {
        let [mut bad, mut good] = [ring - 1, ring].map(|ring| RING_M * f64::from(ring));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (bad + good);
            if self.suits(&(here + away * middle))? {
                good = middle;
            } else {
                bad = middle;
            }
        }
        Ok(good)
    }

    /// Whether the plate can be washed whole with its centre there, and has room there.
    fn suits(&self, centre: &Vector2<f64>) -> Result<bool, PostureError> {
        let mut plates = self.plates.to_vec();
        (plates[self.plate].x_m, plates[self.plate].y_m) = (centre.x, centre.y);
        let moved = plates[self.plate];
        let others = plates.iter().enumerate().filter(|(i, _)| *i != self.plate);
        if others.into_iter().any(|(_, other)| overlap(&moved, other)) || self.meets_base(&moved) {
            return Ok(false);
        }
        let clearance = ClearanceModel::new(self.robot, self.tool, &plates)?;
        let cell = Cell::new(self.robot, self.tool, &clearance, &plates)?;
        let centre = Vector3::new(centre.x, centre.y, moved.z_m + self.height_m);
        let task = Task::new(&cell, self.stroke, centre, self.plate, self.settings, self.near)?;
        Ok(by_policy(&task, self.settings, self.near).is_some())
    }

    fn meets_base(&self, plate: &Plate) -> bool {
        let foot = base_footprint(self.robot);
        let beside = |[least, most]: [f64; 2], at: f64| (least - at).max(at - most).max(0.0);
        let (dx, dy) = (beside(foot.x_m, plate.x_m), beside(foot.y_m, plate.y_m));
        dx * dx + dy * dy < plate.radius_m * plate.radius_m
    }
}
