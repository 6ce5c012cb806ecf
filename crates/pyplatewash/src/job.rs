//! `Job`: the paper's program, planned and followed.

use crate::argument;
use crate::arrays;
use crate::errors;
use crate::layout::LayoutObject;
use crate::plan::{PlanObject, file_error};
use crate::robot::Robot;
use crate::scenario::{self, ScenarioObject};
use crate::trajectory::TrajectoryObject;
use crate::value::to_record;
use crate::work::patiently;
use numpy::{PyArray1, PyArrayDyn};
use platewash::planner::scenario::Program;
use platewash::planner::{plan, robot};
use platewash::workcell::tool;
use platewash::workcell::words::counted;
use platewash::{Job, JointVector, Layout, Plan, Scenario};
use pyo3::prelude::*;
use pyo3::types::{PyTuple, PyType};
use std::sync::Arc;

/// A job of the paper's program, planned and followed, before it is judged.
///
/// One step a waypoint; N is their number. See `report` for what it came to.
#[pyclass(frozen, module = "pyplatewash", name = "Job")]
pub struct JobObject {
    inner: Arc<Job>,
    robot: Py<Robot>,
}

/// Plans and follows, on plates that were placed before if there are any.
fn run(py: Python<'_>, scenario: Scenario, layout: Option<Layout>) -> PyResult<Job> {
    let work = move || match layout {
        None => Job::run(&scenario),
        Some(layout) => Job::on(&scenario, robot::load(&scenario.robot)?, layout),
    };
    patiently(py, move |_| work())?.map_err(|e| errors::plan(py, &e))
}

impl JobObject {
    fn positions<'py>(
        &self,
        py: Python<'py>,
        of: fn(&Job) -> Vec<JointVector>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::joint_rows(py, &of(&self.inner))
    }
}

#[pymethods]
impl JobObject {
    /// Plans and follows a scenario (or the shipped name or file of one), on a layout that was made before if one is given.
    ///
    /// Raises InputError for a certified job, which is `Cycle.plan`'s; ScenarioError, LayoutError or PlanError. A job that does not
    /// wash is no error: see `report`.
    #[classmethod]
    #[pyo3(name = "run", signature = (scenario, layout=None))]
    fn start(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        scenario: &Bound<'_, PyAny>,
        layout: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (scenario, layout) = (scenario::given(scenario)?, LayoutObject::given(layout)?);
        scenario::of_program(py, &scenario, Program::Paper)?;
        let job = run(py, scenario, layout)?;
        let robot = Robot::of_section(py, &job.scenario.robot, &job.robot)?;
        let inner = Arc::new(job);
        Ok(Self { inner, robot })
    }

    /// What was asked.
    #[getter]
    fn scenario(&self) -> ScenarioObject {
        self.inner.scenario.clone().into()
    }

    /// The plates.
    #[getter]
    fn layout(&self) -> LayoutObject {
        self.inner.layout.clone().into()
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

    /// Where the tip shall be, shape (N, 3) [m].
    #[getter]
    fn targets<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let all: Vec<f64> = self
            .inner
            .steps
            .iter()
            .flat_map(|s| <[f64; 3]>::from(s.target))
            .collect();
        arrays::array(py, &[self.inner.steps.len(), 3], &all)
    }

    /// Where the tip is after each step, shape (N, 3) [m].
    #[getter]
    fn executed_tip<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let all: Vec<f64> = self
            .inner
            .steps
            .iter()
            .flat_map(|s| <[f64; 3]>::from(s.executed_tip))
            .collect();
        arrays::array(py, &[self.inner.steps.len(), 3], &all)
    }

    /// Configurations commanded, shape (N, 6) [rad].
    #[getter]
    fn commanded_q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.positions(py, |job| job.steps.iter().map(|s| s.commanded).collect())
    }

    /// Configurations after each step, shape (N, 6) [rad].
    #[getter]
    fn executed_q<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.positions(py, |job| job.steps.iter().map(|s| s.executed).collect())
    }

    /// Whether the inverse kinematics solved each waypoint, shape (N,).
    #[getter]
    fn reached<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        arrays::line(py, self.inner.steps.iter().map(|s| s.reached()).collect())
    }

    /// Plate of each waypoint (the one washed, or the one a transition leads to), shape (N,).
    #[getter]
    fn plate<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        let segments = &self.inner.tool_path.segments;
        arrays::line(
            py,
            self.inner
                .steps
                .iter()
                .map(|s| segments[s.segment].plate as i64)
                .collect(),
        )
    }

    /// Whether each waypoint washes (as opposed to crossing over), shape (N,).
    #[getter]
    fn washing<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        let segments = &self.inner.tool_path.segments;
        let washes = |segment: usize| segments[segment].kind.name() == "wash";
        arrays::line(py, self.inner.steps.iter().map(|s| washes(s.segment)).collect())
    }

    /// Judges the job: what was reached, how near it came, what it covered. A record; its text is the report that the command
    /// prints.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let job = self.inner.clone();
        let report = patiently(py, move |_| job.report())?.map_err(|e| errors::plan(py, &e))?;
        to_record(py, &report, Some(report.to_string()))
    }

    /// The plan file of the commanded motion, sealed.
    fn plan(&self, py: Python<'_>) -> PyResult<PlanObject> {
        let job = self.inner.clone();
        let report = patiently(py, move |_| job.report())?.map_err(|e| errors::plan(py, &e))?;
        let plan = Plan::new(&self.inner, &report).map_err(|e| file_error(py, &e))?;
        Ok(PlanObject::new(plan, Some(self.robot.clone_ref(py))))
    }

    /// A motion as CSV text, the planned one or with `executed=True` the executed one, every `dt_s` [s], by default the
    /// scenario's.
    #[pyo3(signature = (dt_s=None, *, executed=None), text_signature = "($self, dt_s=None, *, executed=False)")]
    fn to_csv(
        &self,
        py: Python<'_>,
        dt_s: Option<&Bound<'_, PyAny>>,
        executed: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<String> {
        let job = &self.inner;
        let dt_s = dt_s.map(|dt_s| argument::number("dt_s", dt_s)).transpose()?;
        let executed = executed.map_or(Ok(false), |executed| argument::flag("executed", executed))?;
        let motion = if executed { &job.executed } else { &job.planned };
        let tip = tool::tip_frame(&job.robot, &job.scenario.tool);
        let dt_s = dt_s.unwrap_or(job.scenario.control.dt_s);
        let segments = plan::segments(job);
        let table = platewash::workcell::csv::table(motion, &segments, &job.robot, &tip, dt_s);
        table
            .map(|table| table.to_string())
            .map_err(|e| errors::input(py, "dt_s", &e.to_string()))
    }

    fn __len__(&self) -> usize {
        self.inner.steps.len()
    }

    fn __repr__(&self) -> String {
        let plates = counted(self.inner.layout.plates.len(), "plate");
        let steps = counted(self.inner.steps.len(), "waypoint");
        format!("Job('{}', {plates}, {steps})", self.inner.scenario.name)
    }

    fn __eq__(&self, other: &Self) -> bool {
        let (a, b) = (&self.inner, &other.inner);
        (&a.scenario, &a.layout, &a.steps) == (&b.scenario, &b.layout, &b.steps)
            && (&a.planned, &a.executed) == (&b.planned, &b.executed)
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        // The same scenario on the same plates is the same job, to the bit.
        let arguments = (slf.get().scenario(), slf.get().layout()).into_pyobject(slf.py())?;
        Ok((slf.get_type().getattr("run")?, arguments))
    }
}
