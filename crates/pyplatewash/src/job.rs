//! `WashJob` and `PaperJob`: resolved jobs.

use crate::layout::LayoutObject;
use crate::plate::{PlateFields, plates};
use crate::robot::Robot;
use crate::simulation::SettingsObject;
use crate::value::{to_python, to_record};
use crate::{argument, arrays, errors, exception};
use numpy::PyArrayDyn;
use platewash::workcell::words::{count_with_noun, quoted};
use platewash::{Failure, JobTerms, Layout, PaperJob, WashJob};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple, PyType};
use serde::{Deserialize, Serialize};

/// A washing that is asked for, resolved: the arm loaded, the plates placed, no default left. `Scenario.job` makes one, `plan` plans it.
/// Immutable.
#[pyclass(frozen, eq, module = "pyplatewash", name = "WashJob")]
pub struct WashJobObject {
    inner: WashJob,
    layout: Layout,
    robot: Py<Robot>,
}

impl PartialEq for WashJobObject {
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (&self.inner, &other.inner);
        (a.name(), a.terms(), &self.layout) == (b.name(), b.terms(), &other.layout)
    }
}

/// State of a pickled job without its arm, which is pickled beside it.
#[derive(Serialize, Deserialize)]
struct PickledJob {
    name: String,
    terms: JobTerms,
    layout: Layout,
}

impl PickledJob {
    /// Returns the call that restores a job: `_restore` of its class, with this state as text and the arm as its arguments.
    fn reduced<'py>(&self, job: &Bound<'py, PyAny>, robot: Py<Robot>) -> PyResult<Reduction<'py>> {
        let text = serde_json::to_string(self).map_err(|e| exception::internal(job.py(), &e.to_string()))?;
        Ok((
            job.get_type().getattr("_restore")?,
            (text, robot).into_pyobject(job.py())?,
        ))
    }

    /// Reads it back.
    fn restored<'a, 'py>(
        text: &Bound<'py, PyAny>,
        robot: &'a Bound<'py, PyAny>,
    ) -> PyResult<(Self, &'a Bound<'py, Robot>)> {
        let read = argument::text("text", text, "a pickled job")?;
        let robot = argument::object::<Robot>("robot", robot, argument::ROBOT)?;
        let pickled = serde_json::from_str(&read).map_err(|e| exception::input(text.py(), "text", &e.to_string()))?;
        Ok((pickled, robot))
    }
}

/// Return value of `__reduce__`: a callable and its arguments.
type Reduction<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

impl WashJobObject {
    /// A job on a layout.
    #[must_use]
    pub fn new(inner: WashJob, layout: Layout, robot: Py<Robot>) -> Self {
        Self { inner, layout, robot }
    }

    /// The job.
    #[must_use]
    pub fn inner(&self) -> &WashJob {
        &self.inner
    }

    /// The plates, and where they come from.
    #[must_use]
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The arm.
    #[must_use]
    pub fn robot(&self, py: Python<'_>) -> Py<Robot> {
        self.robot.clone_ref(py)
    }
}

#[pymethods]
impl WashJobObject {
    /// Name of the scenario.
    #[getter]
    fn name(&self) -> &str {
        self.inner.name()
    }

    /// Seed of every random stream.
    #[getter]
    fn seed(&self) -> u64 {
        self.inner.terms().seed
    }

    /// The arm.
    #[getter(robot)]
    fn py_robot(&self, py: Python<'_>) -> Py<Robot> {
        self.robot(py)
    }

    /// The plates, with what is to be said about them.
    #[getter(layout)]
    fn py_layout(&self) -> LayoutObject {
        self.layout.clone().into()
    }

    /// The plates.
    #[getter]
    fn plates<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        plates(py, &self.inner.terms().plates)
    }

    /// Joint positions at the start and at the end, shape (2, 6) [rad].
    #[getter]
    fn home_rad<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::joint_rows(py, &self.inner.terms().home_rad)
    }

    /// The world: arm, tool, obstacles, pairs of bodies that need not keep clear of each other.
    #[getter]
    fn workcell<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.terms().workcell, None)
    }

    /// Requirements of the washing.
    #[getter]
    fn requirements<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.terms().requirements, None)
    }

    /// Limits of joints and tip, beyond those of the arm's description.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.terms().limits, None)
    }

    /// Settings of the simulation, unless `simulate` is given others.
    #[getter]
    fn simulation(&self) -> SettingsObject {
        self.inner.terms().simulation.clone().into()
    }

    /// The same job on other plates.
    ///
    /// Raises InputError for plates that are none.
    fn on_plates(&self, py: Python<'_>, plates: &Bound<'_, PyAny>) -> PyResult<Self> {
        let read = |name: &str, plate: &Bound<'_, PyAny>| PlateFields::read(name, plate)?.plate(py);
        let plates = argument::each("plates", plates, "a list of Plates", read)?;
        let inner = self.inner.on_plates(plates.clone());
        Ok(Self {
            inner: inner.map_err(|e| errors::failure(py, &e.into()))?,
            layout: Layout::from_plates(plates),
            robot: self.robot(py),
        })
    }

    /// Everything but the arm as plain dictionaries and lists, as a plan file states it.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, self.inner.terms())
    }

    fn __repr__(&self) -> String {
        let terms = self.inner.terms();
        let plates = count_with_noun(terms.plates.len(), "plate");
        format!("WashJob({}, seed={}, {plates})", quoted(self.inner.name()), terms.seed)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduction<'py>> {
        let job = slf.get();
        let pickled = PickledJob {
            name: job.inner.name().to_owned(),
            terms: job.inner.terms().clone(),
            layout: job.layout.clone(),
        };
        pickled.reduced(slf, job.robot(slf.py()))
    }

    /// Restores a pickled job.
    #[classmethod]
    fn _restore(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &Bound<'_, PyAny>,
        robot: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let (pickled, robot) = PickledJob::restored(text, robot)?;
        let job = WashJob::new(robot.get().model().clone(), pickled.terms);
        Ok(Self {
            inner: job.map_err(|e| errors::failure(py, &e.into()))?.named(&pickled.name),
            layout: pickled.layout,
            robot: robot.clone().unbind(),
        })
    }
}

/// A run of the paper's program that is asked for, resolved: `Scenario.paper_job` makes one, `run_paper` carries it out. Immutable.
#[pyclass(frozen, eq, module = "pyplatewash", name = "PaperJob")]
pub struct PaperJobObject {
    inner: PaperJob,
    robot: Py<Robot>,
}

impl PartialEq for PaperJobObject {
    fn eq(&self, other: &Self) -> bool {
        let (a, b) = (&self.inner, &other.inner);
        (&a.name, &a.layout, a.terms().ok()) == (&b.name, &b.layout, b.terms().ok())
    }
}

impl PaperJobObject {
    /// A job with its arm.
    #[must_use]
    pub fn new(inner: PaperJob, robot: Py<Robot>) -> Self {
        Self { inner, robot }
    }

    /// The job.
    #[must_use]
    pub fn inner(&self) -> &PaperJob {
        &self.inner
    }

    /// The arm.
    #[must_use]
    pub fn robot(&self, py: Python<'_>) -> Py<Robot> {
        self.robot.clone_ref(py)
    }

    /// The job as a plan file states it.
    ///
    /// # Errors
    /// `PlanFileError` for a number that is not finite.
    pub fn terms(&self, py: Python<'_>) -> PyResult<JobTerms> {
        self.inner.terms().map_err(|e| errors::failure(py, &Failure::from(e)))
    }
}

#[pymethods]
impl PaperJobObject {
    /// Name of the scenario.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// The seed that the plates were drawn with.
    #[getter]
    fn seed(&self) -> u64 {
        self.inner.seed
    }

    /// The arm.
    #[getter(robot)]
    fn py_robot(&self, py: Python<'_>) -> Py<Robot> {
        self.robot(py)
    }

    /// The plates, with what is to be said about them.
    #[getter]
    fn layout(&self) -> LayoutObject {
        self.inner.layout.clone().into()
    }

    /// Joint positions at the start, shape (6,) [rad].
    #[getter]
    fn start_rad<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::array(py, &[6], self.inner.start_rad.as_slice())
    }

    /// Settings of the paper's program.
    #[getter]
    fn settings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.settings, None)
    }

    /// The control law and its settings.
    #[getter]
    fn simulation(&self) -> SettingsObject {
        self.inner.simulation.clone().into()
    }

    /// Everything but the arm as plain dictionaries and lists, as a plan file states it.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &self.terms(py)?)
    }

    fn __repr__(&self) -> String {
        let plates = count_with_noun(self.inner.layout.plates.len(), "plate");
        format!(
            "PaperJob({}, seed={}, {plates})",
            quoted(&self.inner.name),
            self.inner.seed
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduction<'py>> {
        let job = slf.get();
        let pickled = PickledJob {
            name: job.inner.name.clone(),
            terms: job.terms(slf.py())?,
            layout: job.inner.layout.clone(),
        };
        pickled.reduced(slf, job.robot(slf.py()))
    }

    /// Restores a pickled job.
    #[classmethod]
    fn _restore(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        text: &Bound<'_, PyAny>,
        robot: &Bound<'_, PyAny>,
    ) -> PyResult<Self> {
        let (pickled, robot) = PickledJob::restored(text, robot)?;
        let job = PaperJob::of_terms(pickled.name, pickled.terms, pickled.layout, robot.get().model().clone());
        let inner = job.map_err(|e| errors::failure(py, &e.into()))?;
        let robot = robot.clone().unbind();
        Ok(Self { inner, robot })
    }
}
