//! `Cycle`: a certified job, and the calls that lead to a plan.

use crate::argument;
use crate::errors;
use crate::layout::LayoutObject;
use crate::plan::{PlanObject, file_error, records};
use crate::robot::Robot;
use crate::scenario::{self, ScenarioObject};
use crate::trajectory::TrajectoryObject;
use crate::value::to_record;
use crate::work::patiently;
use platewash::planner::certificate;
use platewash::planner::plan::PlanFileError;
use platewash::planner::robot;
use platewash::planner::scenario::Program;
use platewash::planner::sweep::SweepRow;
use platewash::workcell::words::counted;
use platewash::workcell::{csv, tool};
use platewash::{Cycle, CycleReport, Job, Plan, PlanError, RobotModel, Scenario};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple, PyType};
use rayon::prelude::*;
use std::sync::Arc;

/// A certified job: the whole cycle, from home to home, planned before anything moves.
#[pyclass(frozen, module = "pyplatewash", name = "Cycle")]
pub struct CycleObject {
    inner: Arc<Cycle>,
    robot: Py<Robot>,
}

#[pymethods]
impl CycleObject {
    /// Plans the cycle of a scenario (or the shipped name or file of one), on a layout that was made before if one is given.
    ///
    /// Raises InputError for the paper's program, which is `Job.run`'s; ScenarioError, LayoutError or PlanError.
    #[classmethod]
    #[pyo3(signature = (scenario, layout=None))]
    fn plan(
        _class: &Bound<'_, PyType>,
        py: Python<'_>,
        scenario: &Bound<'_, PyAny>,
        layout: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let (scenario, layout) = (scenario::given(scenario)?, LayoutObject::given(layout)?);
        scenario::of_program(py, &scenario, Program::Certified)?;
        let planned = patiently(py, move |_| match layout {
            None => Cycle::plan(&scenario),
            Some(layout) => Cycle::on(&scenario, robot::load(&scenario.robot)?, layout),
        })?;
        let inner = Arc::new(planned.map_err(|e| errors::plan(py, &e))?);
        let robot = Robot::of_section(py, &inner.scenario.robot, &inner.robot)?;
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
        self.inner.order.clone()
    }

    /// The motion.
    #[getter]
    fn motion(&self) -> TrajectoryObject {
        self.inner.motion.clone().into()
    }

    /// The segments in time: `kind`, `plate`, `t_start_s`, `t_end_s`.
    #[getter]
    fn segments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.segments)
    }

    /// How each plate is washed, in the order of washing: `plate`, `posture`, `wash_s`.
    #[getter]
    fn visits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.visits)
    }

    /// How the crossings go, from home, between the plates, and home: `route`, `duration_s`.
    #[getter]
    fn crossings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        records(py, &self.inner.crossings)
    }

    /// What the order gains: `travel_s`, `nearest_next_s`, `optimality`.
    #[getter]
    fn tour<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_record(py, &self.inner.tour, None)
    }

    /// The plan file's contents, sealed. Nothing is proved: see `verify`.
    fn to_plan(&self, py: Python<'_>) -> PyResult<PlanObject> {
        let plan = self.inner.to_plan().map_err(|e| file_error(py, &e))?;
        Ok(PlanObject::new(plan, Some(self.robot.clone_ref(py))))
    }

    /// Proves the cycle and sums it up. A record; its text is the report that the command prints.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let cycle = self.inner.clone();
        let plan = cycle.to_plan().map_err(|e| file_error(py, &e))?;
        let judged = patiently(py, move |_| certificate::verify(&plan, &cycle.robot))?;
        let report = CycleReport::new(&self.inner, judged.map_err(|e| errors::verify(py, &e))?);
        to_record(py, &report, Some(report.to_string()))
    }

    /// The motion as CSV text, every `dt_s` [s], by default the scenario's.
    #[pyo3(signature = (dt_s=None))]
    fn to_csv(&self, py: Python<'_>, dt_s: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let cycle = &self.inner;
        let dt_s = dt_s.map(|dt_s| argument::number("dt_s", dt_s)).transpose()?;
        let tip = tool::tip_frame(&cycle.robot, &cycle.scenario.tool);
        let dt_s = dt_s.unwrap_or(cycle.scenario.control.dt_s);
        let table = csv::table(&cycle.motion, &cycle.segments, &cycle.robot, &tip, dt_s);
        table
            .map(|table| table.to_string())
            .map_err(|e| errors::input(py, "dt_s", &e.to_string()))
    }

    fn __repr__(&self) -> String {
        let (name, plates) = (&self.inner.scenario.name, counted(self.inner.order.len(), "plate"));
        format!("Cycle('{name}', {plates}, {:.2} s)", self.inner.motion.duration_s())
    }

    fn __eq__(&self, other: &Self) -> bool {
        let (a, b) = (&self.inner, &other.inner);
        (&a.scenario, &a.layout, &a.order, &a.motion) == (&b.scenario, &b.layout, &b.order, &b.motion)
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        // The same scenario on the same plates is the same cycle, to the bit.
        let arguments = (slf.get().scenario(), slf.get().layout()).into_pyobject(slf.py())?;
        Ok((slf.get_type().getattr("plan")?, arguments))
    }
}

/// Plans a scenario by the program that it names; with its arm.
fn planned(scenario: &Scenario) -> Result<(Result<Plan, PlanFileError>, RobotModel), PlanError> {
    match scenario.job.program {
        Program::Certified => {
            let cycle = Cycle::plan(scenario)?;
            Ok((cycle.to_plan(), cycle.robot))
        }
        Program::Paper => {
            let job = Job::run(scenario)?;
            let report = job.report()?;
            Ok((Plan::new(&job, &report), job.robot))
        }
    }
}

/// Plans a scenario (or the shipped name or file of one) with its own program: the plan, sealed. Nothing is proved: see
/// `verify`.
///
/// Raises ScenarioError, LayoutError or PlanError. A job of the paper's program that does not wash is no error: see
/// `Plan.summary`.
#[pyfunction]
#[pyo3(signature = (scenario, *, seed=None))]
pub fn plan(py: Python<'_>, scenario: &Bound<'_, PyAny>, seed: Option<&Bound<'_, PyAny>>) -> PyResult<PlanObject> {
    let mut scenario = scenario::given(scenario)?;
    if let Some(seed) = seed {
        scenario.seed = argument::seed("seed", seed)?;
    }
    let section = scenario.robot.clone();
    let (plan, model) = patiently(py, move |_| planned(&scenario))?.map_err(|e| errors::plan(py, &e))?;
    let robot = Robot::of_section(py, &section, &model)?;
    Ok(PlanObject::new(plan.map_err(|e| file_error(py, &e))?, Some(robot)))
}

/// Plans and proves a certified scenario once a seed: one record a seed with `seed`, `outcome` (`"proved"`, `"not_proved"`,
/// `"infeasible"`, `"not_found"`, `"error"`), `duration_s`, `crossings_s`, `coverage`, `clearance_m` and `reason`. Works on all processors.
///
/// Raises InputError for a scenario of the paper's program; ScenarioError or PlanError for one that is wrong for every seed.
#[pyfunction]
pub fn sweep<'py>(
    py: Python<'py>,
    scenario: &Bound<'_, PyAny>,
    seeds: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyList>> {
    let scenario = scenario::given(scenario)?;
    scenario::of_program(py, &scenario, Program::Certified)?;
    let seeds = argument::each("seeds", seeds, "a list of seeds", argument::seed)?;
    let rows = patiently(py, move |cancel| {
        let one = |&seed: &u64| match cancel.is_asked() {
            true => Err(PlanError::Stopped),
            false => platewash::planner::sweep::sweep(&scenario, seed..=seed),
        };
        seeds.par_iter().map(one).collect::<Result<Vec<Vec<SweepRow>>, _>>()
    })?;
    records(py, &rows.map_err(|e| errors::plan(py, &e))?.concat())
}
