//! Generators of the tip's curves: spiral, stroke, transition, cubic.

use crate::arrays;
use crate::errors;
use nalgebra::Vector3;
use numpy::PyArrayDyn;
use platewash::planner::cubic;
use platewash::planner::scenario::Interpolation;
use platewash::planner::spiral::Spiral;
use platewash::planner::stroke::Stroke;
use platewash::planner::transition::{self, Arc};
use pyo3::prelude::*;

/// Most points of a curve.
const MOST_POINTS: usize = 10_000_000;
/// Most turns of a spiral.
const MOST_TURNS: f64 = 1000.0;

type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

fn points(py: Python<'_>, name: &str, count: usize) -> PyResult<()> {
    if (2..=MOST_POINTS).contains(&count) {
        return Ok(());
    }
    Err(errors::input(
        py,
        name,
        &format!("must be from 2 to {MOST_POINTS}; found {count}"),
    ))
}

fn within(py: Python<'_>, name: &str, value: f64, [least, most]: [f64; 2]) -> PyResult<()> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(errors::input(
        py,
        name,
        &format!("must be from {least} to {most}; found {value}"),
    ))
}

fn finite(py: Python<'_>, name: &str, values: &[f64]) -> PyResult<()> {
    match values.iter().find(|v| !v.is_finite()) {
        None => Ok(()),
        Some(found) => Err(errors::input(py, name, &format!("must be finite; found {found}"))),
    }
}

/// Waypoints of the paper's spiral, shape (N, 2); see `Spiral`.
#[pyfunction]
pub fn _spiral<'py>(
    py: Python<'py>,
    count: usize,
    turns: f64,
    radius_m: f64,
    closing_ring: bool,
    centre: &Bound<'py, PyAny>,
) -> PyResult<Array<'py>> {
    points(py, "points", count)?;
    within(py, "turns", turns, [1e-3, MOST_TURNS])?;
    within(py, "radius_m", radius_m, [0.0, 100.0])?;
    let centre = arrays::fixed::<2>("centre", centre)?;
    finite(py, "centre", &centre)?;
    let spiral = Spiral {
        points: count,
        turns,
        radius_m,
        closing_ring,
    };
    let all = spiral.waypoints(centre);
    arrays::array(py, &[all.len(), 2], all.as_flattened())
}

fn stroke(py: Python<'_>, radius_m: f64, turns: f64, start_angle_rad: f64, closing_ring: bool) -> PyResult<Stroke> {
    within(py, "radius_m", radius_m, [1e-6, 100.0])?;
    within(py, "turns", turns, [0.25, MOST_TURNS])?;
    within(py, "start_angle_rad", start_angle_rad, [-1e3, 1e3])?;
    Ok(Stroke {
        radius_m,
        turns,
        start_angle_rad,
        closing_ring,
    })
}

/// Points of a stroke whose chords leave it by at most `chord_error_m`: parameters (N,), points (N, 2); see `Stroke`.
#[pyfunction]
pub fn _stroke<'py>(
    py: Python<'py>,
    radius_m: f64,
    turns: f64,
    start_angle_rad: f64,
    closing_ring: bool,
    chord_error_m: f64,
) -> PyResult<(Array<'py>, Array<'py>)> {
    let stroke = stroke(py, radius_m, turns, start_angle_rad, closing_ring)?;
    within(py, "chord_error_m", chord_error_m, [1e-8 * radius_m, radius_m])?;
    let theta = stroke.parameters(chord_error_m);
    let all: Vec<f64> = theta
        .iter()
        .flat_map(|&t| <[f64; 2]>::from(stroke.at(t).position))
        .collect();
    Ok((
        arrays::array(py, &[theta.len()], &theta)?,
        arrays::array(py, &[theta.len(), 2], &all)?,
    ))
}

/// Waypoints from `start` to `end`, shape (3,) [m]: up to an arc round the base at `radius_m` and `height_m`, the shorter way
/// round, and down; shape (points + 2, 3).
#[pyfunction]
#[pyo3(signature = (start, end, *, points=5, radius_m=0.35, height_m=0.25))]
pub fn transition_waypoints<'py>(
    py: Python<'py>,
    start: &Bound<'py, PyAny>,
    end: &Bound<'py, PyAny>,
    points: usize,
    radius_m: f64,
    height_m: f64,
) -> PyResult<Array<'py>> {
    self::points(py, "points", points)?;
    within(py, "radius_m", radius_m, [0.0, 100.0])?;
    within(py, "height_m", height_m, [-100.0, 100.0])?;
    let (start, end) = (arrays::fixed::<3>("start", start)?, arrays::fixed::<3>("end", end)?);
    finite(py, "start", &start)?;
    finite(py, "end", &end)?;
    let arc = Arc {
        points,
        radius_m,
        height_m,
    };
    let all = transition::waypoints(start.into(), end.into(), &arc);
    vectors(py, &all)
}

/// A curve through `waypoints`, shape (K, 3), at equally spaced times, sampled at `samples` equally spaced times: shape
/// (samples, 3).
///
/// `"zero_velocity"` stops at every waypoint, as MATLAB's `cubicpolytraj` does by default; `"c2_spline"` is the clamped cubic
/// spline, at rest at both ends only.
#[pyfunction]
#[pyo3(signature = (waypoints, samples, interpolation="zero_velocity"))]
pub fn cubic_samples<'py>(
    py: Python<'py>,
    waypoints: &Bound<'py, PyAny>,
    samples: usize,
    interpolation: &str,
) -> PyResult<Array<'py>> {
    points(py, "samples", samples)?;
    let interpolation = match interpolation {
        "zero_velocity" => Interpolation::ZeroVelocity,
        "c2_spline" => Interpolation::C2Spline,
        _ => {
            return Err(errors::input(
                py,
                "interpolation",
                "must be \"zero_velocity\" or \"c2_spline\"",
            ));
        }
    };
    let waypoints = arrays::rows::<3>("waypoints", waypoints)?;
    finite(py, "waypoints", waypoints.as_flattened())?;
    if waypoints.len() < 2 {
        return Err(errors::input(py, "waypoints", "at least two are needed"));
    }
    let waypoints: Vec<_> = waypoints.into_iter().map(Vector3::from).collect();
    vectors(py, &cubic::sample(&waypoints, interpolation, samples))
}

fn vectors<'py>(py: Python<'py>, all: &[Vector3<f64>]) -> PyResult<Array<'py>> {
    arrays::array(py, &[all.len(), 3], bytemuck::cast_slice(all))
}
