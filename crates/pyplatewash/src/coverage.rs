//! How much of a plate the sponge sweeps: as a number, and as a picture.

use crate::arrays::{self, line};
use crate::errors;
use crate::work::patiently;
use platewash::planner::coverage::{Cell, CoverageSettings, coverage, raster};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyType;

static COVERAGE: PyOnceLock<Py<PyType>> = PyOnceLock::new();
static RASTER: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// The part of a disc that a round sponge sweeps while its centre follows a polyline, shape (N, 2) [m], with proven bounds.
///
/// `centre`, shape (2,), is the disc's, in the polyline's frame; `cell_m` is the edge of the smallest cells.
#[pyfunction]
#[pyo3(name = "coverage", signature = (polyline, centre, radius_m, sponge_radius_m, *, cell_m=0.001))]
pub fn measure<'py>(
    py: Python<'py>,
    polyline: &Bound<'py, PyAny>,
    centre: &Bound<'py, PyAny>,
    radius_m: f64,
    sponge_radius_m: f64,
    cell_m: f64,
) -> PyResult<Bound<'py, PyAny>> {
    let (polyline, centre) = (
        arrays::rows::<2>("polyline", polyline)?,
        arrays::fixed::<2>("centre", centre)?,
    );
    let settings = CoverageSettings { cell_m };
    let found = patiently(py, move |_| {
        coverage(&polyline, centre, radius_m, sponge_radius_m, &settings)
    })?;
    let found = found.map_err(|e| errors::input(py, "coverage", &e.to_string()))?;
    let class = COVERAGE.import(py, "pyplatewash._values", "Coverage")?;
    class.call1((found.fraction, found.lower, found.upper))
}

/// The same as a raster of `cells` × `cells` over the square around the disc: which cells are outside the disc, missed, partly
/// swept, wholly swept.
#[pyfunction]
#[pyo3(name = "coverage_raster", signature = (polyline, centre, radius_m, sponge_radius_m, *, cells=200))]
pub fn picture<'py>(
    py: Python<'py>,
    polyline: &Bound<'py, PyAny>,
    centre: &Bound<'py, PyAny>,
    radius_m: f64,
    sponge_radius_m: f64,
    cells: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let (polyline, centre) = (
        arrays::rows::<2>("polyline", polyline)?,
        arrays::fixed::<2>("centre", centre)?,
    );
    let made = patiently(py, move |_| raster(&polyline, centre, radius_m, sponge_radius_m, cells))?;
    let made = made.map_err(|e| errors::input(py, "coverage_raster", &e.to_string()))?;
    let code = |cell: &Cell| match cell {
        Cell::Outside => 0,
        Cell::Missed => 1,
        Cell::Partly => 2,
        Cell::Swept => 3,
    };
    let state: Vec<u8> = made.cells.iter().map(code).collect();
    let class = RASTER.import(py, "pyplatewash._records", "CoverageRaster")?;
    class.call1((
        arrays::array(py, &[cells, cells], &state)?,
        line(py, made.x_m),
        line(py, made.y_m),
    ))
}
