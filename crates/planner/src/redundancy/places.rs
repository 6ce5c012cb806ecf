//! Check of a plate at another place than its own, with the others in place.
//!
//! Search for the nearest place at which a plate can be washed whole.
//!
//! Outlook for a plate, in milliseconds: an estimate to show while a user edits.

use crate::placed_arm::{PlacedArm, Width};
use crate::redundancy::error::RedundancyError;
use crate::redundancy::stuck::is_blocked;
use crate::redundancy::task::Task;
use crate::redundancy::washing::by_policy;
use nalgebra::Vector2;
use platewash_bodies::clearance::{ClearanceModel, gap_of_plates};
use platewash_kinematics::JointVector;
use platewash_kinematics::trig::sin_cos;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::layout::base_footprint;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;
use serde::Serialize;
use std::f64::consts::TAU;
use ts_rs::TS;

/// Plate for which another place is checked.
#[derive(Debug, Clone, Copy)]
pub struct MovedPlate<'a> {
    /// The placed arm, with the plates as they lie.
    pub placed: &'a PlacedArm<'a>,
    /// Bodies around the arm; the plate is moved among them.
    pub clearance: &'a ClearanceModel,
    /// The wash path on the plate to move.
    pub path: &'a WashPath,
    /// Clearance that must be kept \[m\].
    pub clearance_m: f64,
    /// The configuration it starts not far from \[rad\].
    pub near: &'a JointVector,
}

/// One place after the other, with the plate moved there.
#[derive(Debug, Clone)]
pub struct Trial<'a> {
    moved: MovedPlate<'a>,
    plates: Vec<Plate>,
    clearance: ClearanceModel,
}

impl<'a> Trial<'a> {
    /// Trials with the plate of the wash path.
    #[must_use]
    pub fn new(moved: &MovedPlate<'a>) -> Self {
        Self {
            moved: *moved,
            plates: moved.placed.plates.to_vec(),
            clearance: moved.clearance.clone(),
        }
    }

    /// The bodies, with the plate where it last had room.
    pub fn bodies(&self) -> &ClearanceModel {
        &self.clearance
    }

    /// Checks that a policy of tilts washes the plate whole with its centre at `centre` \[m\], and that the plate has room there:
    /// it overlaps neither another plate nor the base.
    ///
    /// # Errors
    /// [`RedundancyError`] for numbers out of range, or where the search was given up.
    pub fn is_suitable(&mut self, centre: &Vector2<f64>) -> Result<bool, RedundancyError> {
        let (asked, placed, path) = (self.moved, self.moved.placed, self.moved.path);
        placed.check_cancelled()?;
        let (plate, count) = (path.plate, self.plates.len());
        let lies = self
            .plates
            .get_mut(plate)
            .ok_or(RedundancyError::Plate { plate, count })?;
        let moved = placed.moved(lies, (*centre).into());
        *lies = moved;
        let mut others = self.plates.iter().enumerate().filter(|(i, _)| *i != path.plate);
        let meets = |gap_m: f64| gap_m < 0.0;
        let over_base = base_footprint(placed.robot).gap_m(&moved).is_some_and(meets);
        if over_base || others.any(|(_, other)| meets(gap_of_plates(placed.robot, &moved, other))) {
            return Ok(false);
        }
        self.clearance.lay(&self.plates);
        if self.clearance.plate_in_base(path.plate).is_some() {
            return Ok(false);
        }
        let placed = placed.among(&self.clearance, &self.plates);
        let task = Task::new(&placed, path, asked.clearance_m, asked.near)?;
        Ok(by_policy(&task, Width::Near)?.is_some())
    }
}

/// Distance of the rings on which other positions are tried \[m\].
pub const RING_M: f64 = 0.02;

/// Rings tried.
pub const RINGS: u32 = 30;

/// Greatest distance from a plate's own place at which another place is searched for \[m\].
pub const SEARCHED_M: f64 = 0.6;

/// Places of the grid in a metre; its answers can be printed in full.
const PER_METRE: f64 = 1000.0;

/// Positions tried on a ring.
const DIRECTIONS: u32 = 24;

/// Halvings between a ring and the one within it.
const HALVINGS: u32 = 6;

/// Steps outwards from the least distance that suits, tried until one holds on the grid \[m\].
const FURTHER_M: [f64; 7] = [0.0, 1e-3, 2e-3, 3e-3, 5e-3, 9e-3, 17e-3];

/// Greatest number of calls of the caller's check: it may plan a whole job.
pub const MOST_CHECKS: usize = 32;

/// The nearest centre (x, y) in whole millimetres \[m\] at which the plate can be washed whole by a policy of tilts,
/// overlaps neither another plate nor the base, and `holds` agrees; `None` if there is none within [`SEARCHED_M`] of the plate's
/// own place. Places are tried in 24 directions on growing rings, halved towards the plate's own place, put on the grid, and
/// stepped further out until the place on the grid itself passes: right to about a tenth of its distance. `holds` is called
/// [`MOST_CHECKS`] times at most; `tell` gets each ring before it is tried, from 1 to [`RINGS`].
///
/// # Errors
/// [`RedundancyError`] for numbers out of range, or where the search was given up.
pub fn nearest_washable(
    moved: &MovedPlate<'_>,
    holds: &mut dyn FnMut(&Vector2<f64>) -> bool,
    tell: &dyn Fn(u32),
) -> Result<Option<Vector2<f64>>, RedundancyError> {
    let (plate, plates) = (moved.path.plate, moved.placed.plates);
    let count = plates.len();
    let here = plates.get(plate).ok_or(RedundancyError::Plate { plate, count })?;
    let here = Vector2::from(moved.placed.centre_in_world(here));
    let mut trial = Trial::new(moved);
    let at_rest = on_grid(&here);
    if trial.is_suitable(&at_rest)? && holds(&at_rest) {
        return Ok(Some(at_rest));
    }
    let mut checks = 1;
    for ring in 1..=RINGS {
        tell(ring);
        for (distance, away) in on_ring(&mut trial, &here, ring)? {
            for further in FURTHER_M {
                let place = on_grid(&(here + away * (distance + further)));
                if !trial.is_suitable(&place)? {
                    continue;
                }
                if checks == MOST_CHECKS {
                    return Ok(None);
                }
                checks += 1;
                if holds(&place) {
                    return Ok(Some(place));
                }
            }
        }
    }
    Ok(None)
}

/// Directions in which a place on the ring suits, and the least distance there that does \[m\]; the nearest first.
fn on_ring(trial: &mut Trial<'_>, here: &Vector2<f64>, ring: u32) -> Result<Vec<(f64, Vector2<f64>)>, RedundancyError> {
    let mut found = Vec::new();
    for k in 0..DIRECTIONS {
        let (s, c) = sin_cos(TAU * f64::from(k) / f64::from(DIRECTIONS));
        let away = Vector2::new(c, s);
        if trial.is_suitable(&(here + away * (RING_M * f64::from(ring))))? {
            found.push((halve(trial, here, &away, ring)?, away));
        }
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(found)
}

/// The least distance from `here` in a direction that suits, between a ring that does and the one within it \[m\].
fn halve(trial: &mut Trial<'_>, here: &Vector2<f64>, away: &Vector2<f64>, ring: u32) -> Result<f64, RedundancyError> {
    let [mut bad, mut good] = [ring - 1, ring].map(|ring| RING_M * f64::from(ring));
    for _ in 0..HALVINGS {
        let middle = 0.5 * (bad + good);
        if trial.is_suitable(&(here + away * middle))? {
            good = middle;
        } else {
            bad = middle;
        }
    }
    Ok(good)
}

/// The nearest place of the grid, equal to the bit to the number that its three decimals print.
pub(crate) fn on_grid(place: &Vector2<f64>) -> Vector2<f64> {
    // Adding 0 makes −0 into 0.
    place.map(|at| (at * PER_METRE).round() / PER_METRE + 0.0)
}

/// Distance beyond the arm's reach that rounding may give \[m\].
const BOUND_SLACK_M: f64 = 1e-9;

/// The chance that a plate can be washed whole: nothing is planned, nothing proved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Chance {
    /// A policy of tilts washes it from end to end. The way of the arm there and back was not checked.
    Washable,
    /// No policy washes it, and a search along the wash path finds nothing: some contact point is without a configuration at any
    /// tilt that the search would try.
    Unwashable,
    /// Neither: a search may find a way.
    Unclear,
}

/// The chance of a plate, where branches are searched for on those found from nearby.
///
/// # Errors
/// [`Cancelled`].
pub fn chance(task: &Task<'_>) -> Result<Chance, Cancelled> {
    let (centre, bound_m) = task.placed.robot.reach_bound(&task.placed.tip);
    let mut contacts = task.samples.contact.iter();
    if contacts.any(|contact| (contact.point - centre.coords).norm() > bound_m + BOUND_SLACK_M) {
        return Ok(Chance::Unwashable);
    }
    if by_policy(task, Width::Near)?.is_some() {
        return Ok(Chance::Washable);
    }
    Ok(if is_blocked(task)? {
        Chance::Unwashable
    } else {
        Chance::Unclear
    })
}
