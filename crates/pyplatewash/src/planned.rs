//! `Planned`: a planned washing, with facts about the plan.

use crate::job::WashJobObject;
use crate::plan::PlanObject;
use crate::value::{records, to_record};
use crate::work::patiently;
use crate::{arrays, errors, scenario};
use numpy::PyArrayDyn;
use platewash::certificate::prove_with;
use platewash::planner::{Watch, plan_with};
use platewash::workcell::words::{count_with_noun, quoted};
use platewash::{PlannedJob, WashReport};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};
use std::sync::Arc;

/// A washing, from home to home, planned before anything moves: the `plan`, and how it came about. Immutable.
#[pyclass(frozen, module = "pyplatewash", name = "Planned")]
pub struct PlannedObject {
    inner: Arc<PlannedJob>,
    job: Py<WashJobObject>,
}

#[pymethods]
impl PlannedObject {
    /// The job.
    #[getter]
    fn job(&self, py: Python<'_>) -> Py<WashJobObject> {
        self.job.clone_ref(py)
    }

    /// The plan, sealed. Nothing is proved: see `prove`.
    #[getter]
    fn plan(&self, py: Python<'_>) -> PlanObject {
        PlanObject::new(self.inner.plan.clone(), Some(self.job.get().robot(py)))
    }

    /// The visits of the plates, in the order of washing: `plate`, `tilt`, `cone_rad`, `curve`, `wash_s`, `pace`.
    #[getter]
    fn visits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.visits)
    }

    /// The transits, from home, between the plates, and home: `kind`, `duration_s`.
    #[getter]
    fn transits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.transits)
    }

    /// Travel time saved by the order: `travel_s`, `nearest_next_s`, `optimality`.
    #[getter]
    fn tour<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.tour, None)
    }

    /// Largest jerk of each joint between knots, shape (6,) [rad/s³]: no plan keeps a limit of it. At knots the acceleration may
    /// jump.
    #[getter]
    fn largest_jerk_rad_s3<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::array(py, &[6], self.inner.largest_jerk.as_slice())
    }

    /// Proves the plan and sums it up. A record; its text is the report that the command prints.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let (planned, arm) = (self.inner.clone(), self.job.get().inner().shared_arm());
        let proved = patiently(py, move |cancel| prove_with(&planned.plan, &arm, cancel))?;
        let certificate = proved.map_err(|e| errors::failure(py, &e.into()))?;
        let report = WashReport::new(&self.inner, &self.job.get().layout().findings, certificate);
        to_record(py, &report, Some(report.to_string()))
    }

    fn __repr__(&self) -> String {
        let plan = &self.inner.plan;
        let (name, plates) = (
            quoted(&plan.provenance.scenario),
            count_with_noun(plan.order.len(), "plate"),
        );
        format!("Planned({name}, {plates}, {:.2} s)", plan.duration_s())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.job.get() == other.job.get() && self.inner.plan == other.inner.plan
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        // The same job gives the same plan, to the bit.
        let plan = slf.py().import("pyplatewash")?.getattr("plan")?;
        Ok((plan, (&slf.get().job,).into_pyobject(slf.py())?))
    }
}

/// Plans a job: that of `Scenario.job`, or of a scenario, a shipped scenario's name or a scenario file, with another `seed` if one is
/// given. Nothing is proved: see `prove`.
///
/// Raises PlanError, with the plate at fault where it is one, LayoutError, or ScenarioError; InputError for a scenario of the paper's
/// program.
#[pyfunction]
#[pyo3(signature = (job, *, seed=None))]
pub fn plan(py: Python<'_>, job: &Bound<'_, PyAny>, seed: Option<&Bound<'_, PyAny>>) -> PyResult<PlannedObject> {
    let job = scenario::wash_job(job, seed)?;
    let asked = job.get().inner().clone();
    let planned = patiently(py, move |cancel| plan_with(&asked, &Watch::silent(cancel)))?;
    Ok(PlannedObject {
        inner: Arc::new(planned.map_err(|e| errors::failure(py, &e.into()))?),
        job: job.unbind(),
    })
}
