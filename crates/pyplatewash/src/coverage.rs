//! Swept share of a plate: as a number, and as a raster.

use crate::argument::{self, ANY_COUNT};
use crate::arrays::{self, line};
use crate::exception;
use crate::work::patiently;
use platewash::bodies::coverage::{CoverageError, RasterCell, coverage, raster};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

static COVERAGE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static RASTER: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// Names the argument that coverage cannot be measured with.
fn wrong(py: Python<'_>, error: &CoverageError) -> PyErr {
    let argument = match error {
        CoverageError::PathNotFinite { .. } => "polyline",
        CoverageError::CentreNotFinite => "centre",
        CoverageError::NotPositive { quantity, .. } => quantity,
        CoverageError::CellTooSmall { .. } => "cell_m",
        CoverageError::Cells { .. } => "cells",
        _ => "coverage",
    };
    match error {
        CoverageError::NotPositive { .. } | CoverageError::CellTooSmall { .. } => {
            exception::keyed(py, argument, &error.to_string())
        }
        _ => exception::input(py, argument, &error.to_string()),
    }
}

fn radii(radius_m: &Bound<'_, PyAny>, sponge_radius_m: &Bound<'_, PyAny>) -> PyResult<[f64; 2]> {
    Ok([
        argument::number("radius_m", radius_m)?,
        argument::number("sponge_radius_m", sponge_radius_m)?,
    ])
}

/// The part of a disc that a round sponge sweeps while its centre follows a polyline, shape (N, 2) [m], with proven bounds.
///
/// `centre`, shape (2,), is the disc's, in the polyline's frame; `cell_m` is the edge of the smallest cells.
#[pyfunction]
#[pyo3(
    name = "coverage",
    signature = (polyline, centre, radius_m, sponge_radius_m, *, cell_m=None),
    text_signature = "(polyline, centre, radius_m, sponge_radius_m, *, cell_m=0.001)"
)]
pub fn measure<'py>(
    py: Python<'py>,
    polyline: &Bound<'py, PyAny>,
    centre: &Bound<'py, PyAny>,
    radius_m: &Bound<'py, PyAny>,
    sponge_radius_m: &Bound<'py, PyAny>,
    cell_m: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let [radius_m, sponge_radius_m] = radii(radius_m, sponge_radius_m)?;
    let cell_m = cell_m.map_or(Ok(0.001), |cell_m| argument::number("cell_m", cell_m))?;
    let (polyline, centre) = (
        arrays::rows::<2>("polyline", polyline)?,
        arrays::fixed::<2>("centre", centre)?,
    );
    let found = patiently(py, move |_| {
        coverage(&polyline, centre, radius_m, sponge_radius_m, cell_m)
    })?;
    let found = found.map_err(|e| wrong(py, &e))?;
    let class = COVERAGE.import(py, "pyplatewash._values", "Coverage")?;
    class.call1((found.fraction, found.lower, found.upper))
}

/// The same as a raster of `cells` × `cells` over the square around the disc: which cells are outside the disc, missed, partly
/// swept, wholly swept.
#[pyfunction]
#[pyo3(
    name = "coverage_raster",
    signature = (polyline, centre, radius_m, sponge_radius_m, *, cells=None),
    text_signature = "(polyline, centre, radius_m, sponge_radius_m, *, cells=200)"
)]
pub fn picture<'py>(
    py: Python<'py>,
    polyline: &Bound<'py, PyAny>,
    centre: &Bound<'py, PyAny>,
    radius_m: &Bound<'py, PyAny>,
    sponge_radius_m: &Bound<'py, PyAny>,
    cells: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let [radius_m, sponge_radius_m] = radii(radius_m, sponge_radius_m)?;
    let cells = cells.map_or(Ok(200), |cells| argument::count("cells", cells, ANY_COUNT))?;
    let (polyline, centre) = (
        arrays::rows::<2>("polyline", polyline)?,
        arrays::fixed::<2>("centre", centre)?,
    );
    let made = patiently(py, move |_| raster(&polyline, centre, radius_m, sponge_radius_m, cells))?;
    let made = made.map_err(|e| wrong(py, &e))?;
    let code = |cell: &RasterCell| match cell {
        RasterCell::Outside => 0,
        RasterCell::Missed => 1,
        RasterCell::Partly => 2,
        RasterCell::Swept => 3,
    };
    let state: Vec<u8> = made.cells.iter().map(code).collect();
    let class = RASTER.import(py, "pyplatewash._records", "CoverageRaster")?;
    class.call1((
        arrays::array(py, &[cells, cells], &state)?,
        line(py, made.x_m),
        line(py, made.y_m),
    ))
}
