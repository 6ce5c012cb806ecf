//! `Plan`: the plan file.

use crate::argument;
use crate::certificate::{self, CertificateObject};
use crate::errors::{self, FileOf, SystemWord};
use crate::layout::plates;
use crate::robot::Robot;
use crate::scenario::ScenarioObject;
use crate::trajectory::TrajectoryObject;
use crate::value::{to_python, to_record};
use platewash::kinematics::urdf::file;
use platewash::planner::plan::PlanFileError;
use platewash::workcell::trajectory::KnotError;
use platewash::{Plan, RobotModel, Trajectory};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyString, PyTuple, PyType};
use serde::Serialize;
use std::sync::Arc;

/// Longest plan file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 30;

/// A plan: everything that a verifier needs besides the URDF, sealed with a hash. Immutable.
///
/// A plan that was made in this process knows its arm (`robot`), so that `verify`, `simulate` and `tune` need no other; a pickle takes
/// the arm along. A plan file holds no arm: a plan that is read from one knows the built-in arm only.
#[pyclass(frozen, eq, module = "pyplatewash", name = "Plan")]
pub struct PlanObject {
    inner: Plan,
    robot: Option<Py<Robot>>,
}

impl PartialEq for PlanObject {
    /// A plan is what its file says.
    fn eq(&self, other: &Self) -> bool {
        self.inner == other.inner
    }
}

/// An unreadable or unwritable plan.
pub fn file_error(py: Python<'_>, error: &PlanFileError) -> PyErr {
    errors::named(py, "PlanFileError", &error.to_string())
}

impl PlanObject {
    /// A plan, with its arm where that is at hand.
    #[must_use]
    pub fn new(mut inner: Plan, robot: Option<Py<Robot>>) -> Self {
        // Waypoints are no part of the file: a plan and what is read back from its file are equal.
        inner.tool_path.iter_mut().for_each(|segment| segment.waypoints.clear());
        Self { inner, robot }
    }

    /// The plan of an argument: a plan, or the path of a plan file.
    ///
    /// # Errors
    /// `InputTypeError`; `PlanFileError` for a file that is no plan.
    pub fn given<'py>(name: &str, value: &Bound<'py, PyAny>) -> PyResult<Bound<'py, Self>> {
        if let Ok(plan) = value.cast::<Self>() {
            return Ok(plan.clone());
        }
        const NEEDED: &str = "a Plan or the path of a plan file";
        if !(value.is_instance_of::<PyString>() || value.hasattr("__fspath__")?) {
            return Err(argument::wrong_type(name, value, NEEDED));
        }
        Bound::new(value.py(), Self::read(name, value)?)
    }

    fn read(name: &str, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        let (py, path) = (path.py(), argument::path(name, path)?);
        let text = file::read_text(&path, MAX_BYTES).map_err(|e| errors::unread(py, FileOf::Plan, &path, &e))?;
        let plan = Plan::from_json(&text).map_err(|e| {
            let message = format!("{}: {e}", path.display());
            errors::named(py, "PlanFileError", &message)
        })?;
        Ok(Self::new(plan, None))
    }

    /// The plan.
    #[must_use]
    pub fn inner(&self) -> &Plan {
        &self.inner
    }

    /// The arm to judge the plan with: the one given, else its own; `None` leaves the built-in one.
    #[must_use]
    pub fn arm(&self, given: Option<&Bound<'_, Robot>>) -> Option<Arc<RobotModel>> {
        let given = given.map(|robot| robot.get().model().clone());
        given.or_else(|| self.robot.as_ref().map(|robot| robot.get().model().clone()))
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
    fn from_json(_class: &Bound<'_, PyType>, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text = argument::text("text", text, "a plan file's text")?;
        Ok(Self::new(Plan::from_json(&text).map_err(|e| file_error(py, &e))?, None))
    }

    /// Restores a pickled plan with its arm.
    #[classmethod]
    fn _restore(
        class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &Bound<'_, PyAny>,
        robot: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let Self { inner, .. } = Self::from_json(class, py, text)?;
        let robot = Robot::given(robot)?.map(|robot| robot.clone().unbind());
        Ok(Self { inner, robot })
    }

    /// A plan from its file. The hash is not checked: see `is_sealed`.
    ///
    /// Raises PlanFileError; for a file that cannot be read it is a FileError, too.
    #[classmethod]
    fn load(_class: &Bound<'_, PyType>, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::read("path", path)
    }

    /// Writes the plan file.
    ///
    /// Raises PlanFileError, which is a FileError, too.
    fn save(&self, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<()> {
        let path = argument::path("path", path)?;
        std::fs::write(&path, self.to_json(py)?).map_err(|e| {
            let filename = path.display().to_string();
            let message = format!("{filename}: cannot be written: {e}");
            errors::system_file(py, FileOf::Plan, SystemWord::from(&e), &filename, &message)
        })
    }

    /// The arm that the plan was made for, where it is known; None for a plan from a file that names another arm than the built-in
    /// one.
    #[getter]
    fn robot(&self, py: Python<'_>) -> PyResult<Option<Py<Robot>>> {
        match (&self.robot, &self.inner.scenario.robot.urdf) {
            (Some(robot), _) => Ok(Some(robot.clone_ref(py))),
            (None, Some(_)) => Ok(None),
            (None, None) => Robot::built_in(py).map(Some),
        }
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
        let motion = motion.map_err(|e| match e {
            KnotError::Count { .. } => errors::keyed(py, "knots", &e.to_string()),
            _ => errors::input(py, "knots", &e.to_string()),
        });
        Ok(motion?.into())
    }

    /// The certificate of the plan: see `pyplatewash.verify`.
    #[pyo3(signature = (robot=None))]
    fn verify(slf: &Bound<'_, Self>, py: Python<'_>, robot: Option<&Bound<'_, PyAny>>) -> PyResult<CertificateObject> {
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
        let (py, plan) = (slf.py(), slf.get());
        let arguments = (plan.to_json(py)?, plan.robot.as_ref().map(|robot| robot.clone_ref(py)));
        Ok((slf.get_type().getattr("_restore")?, arguments.into_pyobject(py)?))
    }
}
