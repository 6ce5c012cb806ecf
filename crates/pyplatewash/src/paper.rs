//! `PaperRun`: the paper's program, planned and followed.

use crate::job::PaperJobObject;
use crate::plan::PlanObject;
use crate::trajectory::TrajectoryObject;
use crate::value::to_record;
use crate::work::patiently;
use crate::{argument, arrays, errors, exception, scenario};
use nalgebra::SVector;
use numpy::{Element, PyArray1, PyArrayDyn};
use platewash::PaperRun;
use platewash::motion::csv;
use platewash::motion::trajectory::SegmentKind;
use platewash::paper::run_with;
use platewash::paper::tool_path::Segment;
use platewash::paper::tracking::Step;
use platewash::workcell::words::count_with_noun;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::Arc;

/// A run of the paper's program, planned and followed, before it is judged.
///
/// One step a waypoint; N is their number. See `report` for what it washes.
#[pyclass(frozen, module = "pyplatewash", name = "PaperRun")]
pub struct PaperRunObject {
    inner: Arc<PaperRun>,
    job: Py<PaperJobObject>,
}

impl PaperRunObject {
    /// Some numbers of each step, shape (N, count).
    fn rows<'py, const N: usize>(
        &self,
        py: Python<'py>,
        of: fn(&Step) -> &SVector<f64, N>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let steps = &self.inner.steps;
        let all: Vec<f64> = steps.iter().flat_map(of).copied().collect();
        arrays::array(py, &[steps.len(), N], &all)
    }

    /// A value of each step, shape (N,), from the segment that it belongs to.
    fn line<'py, T: Element>(&self, py: Python<'py>, of: impl Fn(&Segment) -> T) -> Bound<'py, PyArray1<T>> {
        let segments = &self.inner.tool_path.segments;
        let steps = self.inner.steps.iter();
        arrays::line(py, steps.map(|step| of(&segments[step.segment])).collect())
    }
}

#[pymethods]
impl PaperRunObject {
    /// The job.
    #[getter]
    fn job(&self, py: Python<'_>) -> Py<PaperJobObject> {
        self.job.clone_ref(py)
    }

    /// Plate indices in the order of washing.
    #[getter]
    fn order(&self) -> Vec<usize> {
        self.inner.tool_path.order.clone()
    }

    /// The commanded motion, from the start configuration on.
    #[getter]
    fn planned(&self) -> TrajectoryObject {
        self.inner.planned.clone().into()
    }

    /// The motion that the control law makes of it.
    #[getter]
    fn executed(&self) -> TrajectoryObject {
        self.inner.executed.clone().into()
    }

    /// Target positions of the tip, shape (N, 3) [m].
    #[getter]
    fn targets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |step| &step.target)
    }

    /// Positions of the tip after each step, shape (N, 3) [m].
    #[getter]
    fn executed_tip<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |step| &step.executed_tip)
    }

    /// Configurations commanded, shape (N, 6) [rad].
    #[getter]
    fn commanded_q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |step| &step.commanded)
    }

    /// Configurations after each step, shape (N, 6) [rad].
    #[getter]
    fn executed_q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |step| &step.executed)
    }

    /// True for each waypoint that the inverse kinematics solved, shape (N,).
    #[getter]
    fn reached<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        arrays::line(py, self.inner.steps.iter().map(|s| s.is_reached()).collect())
    }

    /// Plate of each waypoint (the one washed, or the one a transit leads to), shape (N,).
    #[getter]
    fn plate<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        self.line(py, |segment| segment.plate as i64)
    }

    /// True for each waypoint of a wash, false for those of transits, shape (N,).
    #[getter]
    fn washing<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.line(py, |segment| segment.kind == SegmentKind::Wash)
    }

    /// Judges the run: what was reached, how near it came, what it covered. A record; its text is the report that the command
    /// prints.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let run = self.inner.clone();
        let report = patiently(py, move |cancel| run.report_with(cancel))?;
        let report = report.map_err(|e| errors::failure(py, &e.into()))?;
        to_record(py, &report, Some(report.to_string()))
    }

    /// The plan file of the commanded motion, sealed. There is no certificate for it.
    fn plan(&self, py: Python<'_>) -> PyResult<PlanObject> {
        let plan = self.inner.plan().map_err(|e| errors::failure(py, &e.into()))?;
        Ok(PlanObject::new(plan, Some(self.job.get().robot(py))))
    }

    /// A motion as CSV text, the planned one or with `executed=True` the executed one, every `dt_s` [s], by default the
    /// job's.
    #[pyo3(signature = (dt_s=None, *, executed=None), text_signature = "($self, dt_s=None, *, executed=False)")]
    fn to_csv(
        &self,
        py: Python<'_>,
        dt_s: Option<&Bound<'_, PyAny>>,
        executed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let run = &self.inner;
        let dt_s = dt_s.map(|dt_s| argument::number("dt_s", dt_s)).transpose()?;
        let executed = executed.map_or(Ok(false), |executed| argument::flag("executed", executed))?;
        let motion = if executed { &run.executed } else { &run.planned };
        let tip = run.job.workcell.tool.tip_frame(&run.job.arm);
        let dt_s = dt_s.unwrap_or(run.job.simulation.control.dt_s);
        let segments = run.segments();
        let table = csv::table(motion, &segments, &run.job.arm, &tip, dt_s);
        table
            .map(|table| table.to_string())
            .map_err(|e| exception::input(py, "dt_s", &e.to_string()))
    }

    fn __len__(&self) -> usize {
        self.inner.steps.len()
    }

    fn __repr__(&self) -> String {
        let plates = count_with_noun(self.inner.job.layout.plates.len(), "plate");
        let steps = count_with_noun(self.inner.steps.len(), "waypoint");
        format!("PaperRun('{}', {plates}, {steps})", self.inner.job.name)
    }

    fn __eq__(&self, other: &Self) -> bool {
        let (a, b) = (&self.inner, &other.inner);
        self.job.get() == other.job.get() && (&a.steps, &a.planned, &a.executed) == (&b.steps, &b.planned, &b.executed)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        // The same job gives the same run, to the bit.
        let run = slf.py().import("pyplatewash")?.getattr("run_paper")?;
        Ok((run, (&slf.get().job,).into_pyobject(slf.py())?))
    }
}

/// Plans and follows a job of the paper's program: that of `Scenario.paper_job`, or of a scenario, a shipped scenario's name or a
/// scenario file.
///
/// Raises PlanError, LayoutError or ScenarioError; InputError for a scenario of the other program. A run that does not wash is no error: see `PaperRun.report`.
#[pyfunction]
pub fn run_paper(py: Python<'_>, job: &Bound<'_, PyAny>) -> PyResult<PaperRunObject> {
    let job = scenario::paper_job(job)?;
    let asked = job.get().inner().clone();
    let run = patiently(py, move |cancel| run_with(&asked, cancel))?;
    Ok(PaperRunObject {
        inner: Arc::new(run.map_err(|e| errors::failure(py, &e.into()))?),
        job: job.unbind(),
    })
}
