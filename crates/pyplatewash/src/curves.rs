//! Generators of the tip's curves: wash curve, the paper's spiral, arc round the base, cubic.

use crate::argument;
use crate::arrays;
use crate::exception;
use crate::plate::PlateFields;
use nalgebra::Vector3;
use numpy::PyArrayDyn;
use platewash::paper::PaperSpiral;
use platewash::paper::cubic::{self, Interpolation};
use platewash::workcell::arc::{self, Arc};
use platewash::workcell::surface::Surface;
use platewash::workcell::wash_path::{
    LEAST_BLEND_RAD, MOST_LAPS, MOST_RINGS, MOST_TRIM_RAD, Rings, WashCurve, WashPattern,
};
use pyo3::prelude::*;
use std::f64::consts::TAU;

/// Largest number of points of a curve.
const MOST_POINTS: u64 = 10_000_000;
/// Largest number of turns of a spiral.
const MOST_TURNS: f64 = 1000.0;
/// Largest difference between the turns of a curve and those of its rings.
const SAME_TURNS: f64 = 1e-9;
/// Largest accepted length \[m\].
const LARGEST_M: f64 = 100.0;

type Array<'py> = Bound<'py, PyArrayDyn<f64>>;

fn points(name: &str, count: &Bound<'_, PyAny>) -> PyResult<usize> {
    argument::count(name, count, [2, MOST_POINTS])
}

fn finite(py: Python<'_>, name: &str, values: &[f64]) -> PyResult<()> {
    match values.iter().find(|v| !v.is_finite()) {
        None => Ok(()),
        Some(found) => Err(exception::input(py, name, &format!("must be finite; found {found}"))),
    }
}

/// The spiral of Python's `PaperSpiral`, field by field.
///
/// # Errors
/// `InputTypeError`, `InputError`.
pub fn spiral_of(value: &Bound<'_, PyAny>) -> PyResult<PaperSpiral> {
    let at = |field| ("spiral", field);
    let whole = ("spiral", "a PaperSpiral");
    Ok(PaperSpiral {
        points: argument::field(whole, value, at("points"), points)?,
        turns: argument::field(whole, value, at("turns"), |name, value| {
            argument::number_within(name, value, [1e-3, MOST_TURNS])
        })?,
        radius_m: argument::field(whole, value, at("radius_m"), |name, value| {
            argument::number_within(name, value, [0.0, LARGEST_M])
        })?,
        closing_ring: argument::field(whole, value, at("closing_ring"), argument::flag)?,
    })
}

/// The curve of Python's `WashCurve`, field by field.
///
/// # Errors
/// `InputTypeError`, `InputError`.
pub fn curve_of(value: &Bound<'_, PyAny>) -> PyResult<WashCurve> {
    let number = |field, range| {
        argument::field(("curve", "a WashCurve"), value, ("curve", field), |name, value| {
            argument::number_within(name, value, range)
        })
    };
    let whole = ("curve", "a WashCurve");
    let rings = argument::field(whole, value, ("curve", "rings"), |name, rings| {
        (!rings.is_none()).then(|| rings_of(name, rings)).transpose()
    });
    let curve = WashCurve {
        radius_m: number("radius_m", [1e-6, LARGEST_M])?,
        turns: number("turns", [0.25, MOST_TURNS])?,
        start_angle_rad: number("start_angle_rad", [-1e3, 1e3])?,
        closing_ring: argument::field(whole, value, ("curve", "closing_ring"), argument::flag)?,
        trim_rad: number("trim_rad", [0.0, MOST_TRIM_RAD])?,
        pattern: rings?.map_or(WashPattern::Spiral, WashPattern::Rings),
    };
    match curve.pattern {
        WashPattern::Rings(rings) if (rings.turns() - curve.turns).abs() > SAME_TURNS => {
            let problem = format!("must be those of its rings, {}; found {}", rings.turns(), curve.turns);
            Err(exception::input(value.py(), "curve.turns", &problem))
        }
        WashPattern::Rings(rings) if rings.inner_m >= curve.radius_m => {
            let problem = format!(
                "must be below curve.radius_m = {}; found {}",
                curve.radius_m, rings.inner_m
            );
            Err(exception::input(value.py(), "rings.inner_m", &problem))
        }
        _ => Ok(curve),
    }
}

/// The rings of Python's `Rings`, called `name`, field by field.
///
/// # Errors
/// `InputTypeError`, `InputError`.
pub fn rings_of(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Rings> {
    let whole = (name, "a Rings");
    let number = |field, range| {
        argument::field(whole, value, ("rings", field), |name, value| {
            argument::number_within(name, value, range)
        })
    };
    Ok(Rings {
        count: argument::field(whole, value, ("rings", "count"), |name, count| {
            argument::count(name, count, [2, MOST_RINGS as u64])
        })?,
        inner_m: number("inner_m", [0.0, LARGEST_M])?,
        lead_rad: number("lead_rad", [0.0, TAU])?,
        blend_rad: number("blend_rad", [LEAST_BLEND_RAD, TAU])?,
        laps: argument::field(whole, value, ("rings", "laps"), |name, laps| {
            argument::count(name, laps, [1, u64::from(MOST_LAPS)])
        })? as u32,
    })
}

/// Turns that rings take before the closing one; see `Rings`.
#[pyfunction]
pub fn _rings_turns(rings: &Bound<'_, PyAny>) -> PyResult<f64> {
    Ok(rings_of("rings", rings)?.turns())
}

/// A wash curve on the face of a plate, in its frame: parameters (N,), points (N, 3), normals (N, 3); see `WashCurve`.
#[pyfunction]
pub fn _wash_curve_on<'py>(
    py: Python<'py>,
    curve: &Bound<'py, PyAny>,
    plate: &Bound<'py, PyAny>,
    chord_error_m: &Bound<'py, PyAny>,
) -> PyResult<(Array<'py>, Array<'py>, Array<'py>)> {
    let curve = curve_of(curve)?;
    let surface = PlateFields::read("plate", plate)?.plate(py)?.surface;
    let range = [1e-8 * curve.radius_m, curve.radius_m];
    let theta = curve.parameters(
        &surface,
        argument::number_within("chord_error_m", chord_error_m, range)?,
    );
    let all: Vec<_> = theta.iter().map(|&t| curve.on(&surface, t)).collect();
    let points: Vec<_> = all.iter().map(|at| at.position).collect();
    let normals: Vec<_> = all.iter().map(|at| at.normal).collect();
    Ok((
        arrays::array(py, &[theta.len()], &theta)?,
        vectors(py, &points)?,
        vectors(py, &normals)?,
    ))
}

/// Waypoints of the paper's spiral, shape (N, 2); see `PaperSpiral`.
#[pyfunction]
pub fn _paper_spiral<'py>(
    py: Python<'py>,
    spiral: &Bound<'py, PyAny>,
    centre: &Bound<'py, PyAny>,
) -> PyResult<Array<'py>> {
    let spiral = spiral_of(spiral)?;
    let centre = arrays::fixed::<2>("centre", centre)?;
    finite(py, "centre", &centre)?;
    let all = spiral.waypoints(centre);
    arrays::array(py, &[all.len(), 2], all.as_flattened())
}

/// Points of a wash curve whose chords leave it by at most `chord_error_m`: parameters (N,), points (N, 2); see `WashCurve`.
#[pyfunction]
pub fn _wash_curve<'py>(
    py: Python<'py>,
    curve: &Bound<'py, PyAny>,
    chord_error_m: &Bound<'py, PyAny>,
) -> PyResult<(Array<'py>, Array<'py>)> {
    let curve = curve_of(curve)?;
    let range = [1e-8 * curve.radius_m, curve.radius_m];
    let disc = Surface::Disc {
        radius_m: curve.radius_m,
    };
    let theta = curve.parameters(&disc, argument::number_within("chord_error_m", chord_error_m, range)?);
    let all: Vec<f64> = theta
        .iter()
        .flat_map(|&t| <[f64; 2]>::from(curve.at(t).position))
        .collect();
    Ok((
        arrays::array(py, &[theta.len()], &theta)?,
        arrays::array(py, &[theta.len(), 2], &all)?,
    ))
}

/// Waypoints from `start` to `end`, shape (3,) [m]: up to an arc round the base at `radius_m` and `height_m`, the shorter way
/// round, and down; shape (points + 2, 3).
#[pyfunction]
#[pyo3(
    signature = (start, end, *, points=None, radius_m=None, height_m=None),
    text_signature = "(start, end, *, points=5, radius_m=0.35, height_m=0.25)"
)]
pub fn transit_waypoints<'py>(
    py: Python<'py>,
    start: &Bound<'py, PyAny>,
    end: &Bound<'py, PyAny>,
    points: Option<&Bound<'py, PyAny>>,
    radius_m: Option<&Bound<'py, PyAny>>,
    height_m: Option<&Bound<'py, PyAny>>,
) -> PyResult<Array<'py>> {
    let points = points.map_or(Ok(5), |given| self::points("points", given))?;
    let radius_m = radius_m.map_or(Ok(0.35), |given| {
        argument::number_within("radius_m", given, [0.0, LARGEST_M])
    })?;
    let height_m = height_m.map_or(Ok(0.25), |given| {
        argument::number_within("height_m", given, [-LARGEST_M, LARGEST_M])
    })?;
    let (start, end) = (arrays::fixed::<3>("start", start)?, arrays::fixed::<3>("end", end)?);
    finite(py, "start", &start)?;
    finite(py, "end", &end)?;
    let arc = Arc {
        points,
        radius_m,
        height_m,
    };
    let all = arc::waypoints(start.into(), end.into(), &arc);
    vectors(py, &all)
}

/// A curve through `waypoints`, shape (K, 3), at equally spaced times, sampled at `samples` equally spaced times: shape
/// (samples, 3).
///
/// `"zero_velocity"` stops at every waypoint, as MATLAB's `cubicpolytraj` does by default; `"c2_spline"` is the clamped cubic
/// spline, at rest at both ends only.
#[pyfunction]
#[pyo3(
    signature = (waypoints, samples, interpolation=None),
    text_signature = "(waypoints, samples, interpolation='zero_velocity')"
)]
pub fn cubic_samples<'py>(
    py: Python<'py>,
    waypoints: &Bound<'py, PyAny>,
    samples: &Bound<'py, PyAny>,
    interpolation: Option<&Bound<'py, PyAny>>,
) -> PyResult<Array<'py>> {
    let samples = points("samples", samples)?;
    let words = [
        ("zero_velocity", Interpolation::ZeroVelocity),
        ("c2_spline", Interpolation::C2Spline),
    ];
    let read = |given| argument::word("interpolation", given, &words);
    let interpolation = interpolation.map_or(Ok(Interpolation::ZeroVelocity), read)?;
    let waypoints = arrays::rows::<3>("waypoints", waypoints)?;
    finite(py, "waypoints", waypoints.as_flattened())?;
    if waypoints.len() < 2 {
        return Err(exception::input(py, "waypoints", "at least two are needed"));
    }
    let waypoints: Vec<_> = waypoints.into_iter().map(Vector3::from).collect();
    vectors(py, &cubic::sample(&waypoints, interpolation, samples))
}

fn vectors<'py>(py: Python<'py>, all: &[Vector3<f64>]) -> PyResult<Array<'py>> {
    arrays::array(py, &[all.len(), 3], bytemuck::cast_slice(all))
}
