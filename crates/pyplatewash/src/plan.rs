//! `Plan`: the plan file.

use crate::certificate::{self, CertificateObject};
use crate::errors;
use crate::layout::plates;
use crate::robot::Robot;
use crate::scenario::ScenarioObject;
use crate::trajectory::TrajectoryObject;
use crate::value::{to_python, to_record};
use platewash::kinematics::urdf::file;
use platewash::planner::plan::PlanFileError;
use platewash::{Plan, Trajectory};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple, PyType};
use serde::Serialize;
use std::path::PathBuf;

/// Longest plan file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 30;

/// A plan: everything that a verifier needs besides the URDF, sealed with a hash. Immutable.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Plan")]
#[derive(PartialEq)]
pub struct PlanObject {
    inner: Plan,
}

impl From<Plan> for PlanObject {
    fn from(mut inner: Plan) -> Self {
        // Waypoints are no part of the file: a plan and what is read back from its file are equal.
        inner.tool_path.iter_mut().for_each(|segment| segment.waypoints.clear());
        Self { inner }
    }
}

/// An unreadable or unwritable plan.
pub fn file_error(py: Python<'_>, error: &PlanFileError) -> PyErr {
    errors::named(py, "PlanFileError", &error.to_string())
}

impl PlanObject {
    /// The plan.
    #[must_use]
    pub fn inner(&self) -> &Plan {
        &self.inner
    }
}

/// Serialisable things as records.
///
/// # Errors
/// Out of memory.
pub fn records<'py, T: Serialize>(py: Python<'py>, all: &[T]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for one in all {
        list.append(to_record(py, one, None)?)?;
    }
    Ok(list)
}

#[pymethods]
impl PlanObject {
    /// A plan from its file's text. The hash is not checked: see `is_sealed`.
    ///
    /// Raises PlanFileError.
    #[classmethod]
    fn from_json(_class: &Bound<'_, PyType>, py: Python<'_>, text: &str) -> PyResult<Self> {
        Ok(Plan::from_json(text).map_err(|e| file_error(py, &e))?.into())
    }

    /// A plan from its file. The hash is not checked: see `is_sealed`.
    ///
    /// Raises PlanFileError.
    #[classmethod]
    fn load(class: &Bound<'_, PyType>, py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let unreadable = |e: file::FileError| {
            errors::named(py, "PlanFileError", &format!("{}: cannot be read: {e}", path.display()))
        };
        Self::from_json(class, py, &file::read_text(&path, MAX_BYTES).map_err(unreadable)?)
    }

    /// Writes the plan file.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        Ok(std::fs::write(path, self.to_json(py)?)?)
    }

    /// The plan file's text: canonical JSON, one line.
    fn to_json(&self, py: Python<'_>) -> PyResult<String> {
        self.inner.to_json().map_err(|e| file_error(py, &e))
    }

    /// Everything as plain dictionaries and lists.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.inner)
    }

    /// SHA-256 over the contents, None for a plan that was never sealed.
    #[getter]
    fn hash(&self) -> Option<&str> {
        self.inner.hash.as_deref()
    }

    /// Whether the hash is that of the contents.
    fn is_sealed(&self) -> bool {
        self.inner.is_sealed()
    }

    /// The scenario, resolved, with its seed.
    #[getter]
    fn scenario(&self) -> ScenarioObject {
        self.inner.scenario.clone().into()
    }

    /// The plates.
    #[getter]
    fn plates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        plates(py, &self.inner.plates)
    }

    /// Plate indices in the order of washing.
    #[getter]
    fn order(&self) -> Vec<usize> {
        self.inner.order.clone()
    }

    /// The segments in time: `kind`, `plate`, `t_start_s`, `t_end_s`.
    #[getter]
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.segments)
    }

    /// What the tip must do, as parameters.
    #[getter]
    fn tool_path<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.tool_path)
    }

    /// Limits that hold for the motion.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.limits, None)
    }

    /// What a reader wants to know first: `headline`, `plates_washed`, `duration_s`, `waypoints_reached`.
    #[getter]
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.summary, Some(self.inner.summary.headline.clone()))
    }

    /// The motion.
    ///
    /// Raises InputError for a file whose knots are no motion.
    #[getter]
    fn trajectory(&self, py: Python<'_>) -> PyResult<TrajectoryObject> {
        let knots = &self.inner.knots;
        let motion = Trajectory::from_knots(knots.t_s.clone(), knots.q_rad.clone(), knots.qd_rad_s.clone());
        Ok(motion.map_err(|e| errors::input(py, "knots", &e.to_string()))?.into())
    }

    /// The certificate of the plan: see `pyplatewash.verify`.
    #[pyo3(signature = (robot=None))]
    fn verify(slf: &Bound<'_, Self>, py: Python<'_>, robot: Option<&Bound<'_, Robot>>) -> PyResult<CertificateObject> {
        certificate::verify(py, slf, robot)
    }

    fn __repr__(&self) -> String {
        let hash = self.inner.hash.as_deref().and_then(|h| h.get(..8)).unwrap_or("none");
        let (name, seed) = (&self.inner.scenario.name, self.inner.scenario.seed);
        let duration_s = self.inner.summary.duration_s;
        format!("Plan('{name}', seed={seed}, {duration_s:.2} s, hash {hash}…)")
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let text = slf.get().to_json(slf.py())?;
        Ok((slf.get_type().getattr("from_json")?, (text,).into_pyobject(slf.py())?))
    }
}
