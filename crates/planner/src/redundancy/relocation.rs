//! Where else a plate could lie to be washed whole.

use super::elsewhere::{Elsewhere, Trial};
use super::error::RedundancyError;
use crate::trig::sin_cos;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Distance of the rings on which other positions are tried \[m\].
pub const RING_M: f64 = 0.02;

/// Rings tried.
pub const RINGS: u32 = 30;

/// How far from where a plate lies another place is looked for \[m\].
pub const SEARCHED_M: f64 = 0.6;

/// Places of the grid in a metre.
const PER_METRE: f64 = 1000.0;

/// Grid of the answers, so that they can be printed in full \[m\].
pub const GRID_M: f64 = 1.0 / PER_METRE;

/// Positions tried on a ring.
const DIRECTIONS: u32 = 24;

/// Halvings between a ring and the one within it.
const HALVINGS: u32 = 6;

/// Steps outwards from the least distance that suits, tried until one holds on the grid \[m\].
const FURTHER_M: [f64; 7] = [0.0, 1e-3, 2e-3, 3e-3, 5e-3, 9e-3, 17e-3];

/// Times that the caller's check is asked, at most: it may plan a whole job.
pub const MOST_CHECKS: usize = 32;

/// The nearest centre (x, y) on the grid of [`GRID_M`] \[m\] at which the plate can be washed whole by a policy of tilts,
/// overlaps neither another plate nor the base, and `holds` agrees; `None` within [`SEARCHED_M`] of where it lies. Tried in 24
/// directions on growing rings, halved towards where it lies, put on the grid, and stepped further out until the place on the
/// grid itself passes: right to about a tenth of its distance. `holds` is asked [`MOST_CHECKS`] times at most; `tell` hears of
/// each ring before it is tried, from 1 to [`RINGS`].
///
/// # Errors
/// [`RedundancyError`] for numbers out of range, or where the search was given up.
pub fn nearest_washable(
    asked: &Elsewhere<'_>,
    holds: &mut dyn FnMut(&Vector2<f64>) -> bool,
    tell: &dyn Fn(u32),
) -> Result<Option<Vector2<f64>>, RedundancyError> {
    let (plate, plates) = (asked.path.plate, asked.scene.plates);
    let count = plates.len();
    let here = plates.get(plate).ok_or(RedundancyError::Plate { plate, count })?;
    let here = Vector2::from(asked.scene.centre_in_world(here));
    let mut trial = Trial::new(asked);
    let at_rest = on_grid(&here);
    if trial.suits(&at_rest)? && holds(&at_rest) {
        return Ok(Some(at_rest));
    }
    let mut checks = 1;
    for ring in 1..=RINGS {
        tell(ring);
        for (distance, away) in on_ring(&mut trial, &here, ring)? {
            for further in FURTHER_M {
                let place = on_grid(&(here + away * (distance + further)));
                if !trial.suits(&place)? {
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
        if trial.suits(&(here + away * (RING_M * f64::from(ring))))? {
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
        if trial.suits(&(here + away * middle))? {
            good = middle;
        } else {
            bad = middle;
        }
    }
    Ok(good)
}

/// The nearest place of the grid; what three decimals print is it to the bit.
pub(super) fn on_grid(place: &Vector2<f64>) -> Vector2<f64> {
    // Adding 0 makes −0 into 0.
    place.map(|at| (at * PER_METRE).round() / PER_METRE + 0.0)
}
