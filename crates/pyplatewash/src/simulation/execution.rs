//! `Execution`: the simulated motion of the arm, sample by sample, and its report.

use crate::plan::PlanObject;
use crate::robot::Robot;
use crate::simulation::question::Question;
use crate::simulation::settings::SettingsObject;
use crate::value::to_record;
use crate::work::patiently;
use crate::{argument, arrays, errors, exception};
use numpy::{PyArray1, PyArrayDyn};
use platewash::simulator::plant::FoamLoad;
use platewash::simulator::simulate::{Sample, table as csv_table};
use platewash::simulator::simulate_with;
use platewash::workcell::words::quoted;
use platewash::{Execution, JointVector, SimulationError, SimulationReport};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::Arc;

/// A plan executed under a control law; the samples are N. Immutable.
///
/// The arm starts on the path, at its speed. The same plan, arm and settings give the same bits.
#[pyclass(frozen, module = "pyplatewash", name = "Execution")]
pub struct ExecutionObject {
    inner: Arc<FinishedSimulation>,
    arguments: (Py<PlanObject>, Option<Py<Robot>>, Py<SettingsObject>),
}

/// An execution, with the plan, arm and settings that it belongs to.
pub struct FinishedSimulation {
    /// Plan, arm and settings of the simulation.
    pub question: Question,
    /// Result of the simulation.
    pub execution: Execution,
}

impl ExecutionObject {
    /// The execution of the argument called `execution`, if it is given.
    ///
    /// # Errors
    /// `InputTypeError` for what is no execution.
    pub fn given<'a, 'py>(value: Option<&'a Bound<'py, PyAny>>) -> PyResult<Option<&'a Bound<'py, Self>>> {
        argument::maybe("execution", value, "an Execution, as simulate gives it,")
    }

    /// The execution, with the plan, arm and settings that it belongs to.
    #[must_use]
    pub fn done(&self) -> Arc<FinishedSimulation> {
        self.inner.clone()
    }

    fn samples(&self) -> &[Sample] {
        &self.inner.execution.samples
    }

    fn rows<'py>(&self, py: Python<'py>, of: impl Fn(&Sample) -> JointVector) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        arrays::joint_rows(py, &self.samples().iter().map(of).collect::<Vec<_>>())
    }

    fn felt<'py>(&self, py: Python<'py>, of: impl Fn(&FoamLoad) -> f64) -> Option<Bound<'py, PyArray1<f64>>> {
        let felt: Option<Vec<f64>> = self.samples().iter().map(|s| s.load.as_ref().map(&of)).collect();
        felt.map(|felt| arrays::line(py, felt))
    }
}

#[pymethods]
impl ExecutionObject {
    /// The plan that is executed.
    #[getter]
    fn plan(&self, py: Python<'_>) -> Py<PlanObject> {
        self.arguments.0.clone_ref(py)
    }

    /// Under which law, with which gains and on which plant.
    #[getter]
    fn settings(&self, py: Python<'_>) -> Py<SettingsObject> {
        self.arguments.2.clone_ref(py)
    }

    /// Time between samples [s].
    #[getter]
    fn period_s(&self) -> f64 {
        self.inner.execution.period_s
    }

    /// Times of the samples, shape (N,) [s].
    #[getter]
    fn t_s<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        arrays::line(py, self.samples().iter().map(|s| s.t_s).collect())
    }

    /// Index of the plan's segment at each sample, shape (N,).
    #[getter]
    fn segment<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i64>> {
        arrays::line(py, self.samples().iter().map(|s| s.segment as i64).collect())
    }

    /// Positions that the plan asks for, shape (N, 6) [rad].
    #[getter]
    fn commanded_rad<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |s| s.commanded)
    }

    /// Positions, shape (N, 6) [rad].
    #[getter]
    fn q_rad<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |s| s.state.q)
    }

    /// Speeds, shape (N, 6) [rad/s].
    #[getter]
    fn qd_rad_s<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |s| s.state.qd)
    }

    /// Accelerations over the step that follows each sample, shape (N, 6) [rad/s²].
    #[getter]
    fn qdd_rad_s2<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |s| s.qdd)
    }

    /// Torques held until the next sample, within the limits, shape (N, 6) [N·m]; zeros under `"paper"` and `"exact"`.
    #[getter]
    fn torque_n_m<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.rows(py, |s| s.torque)
    }

    /// Force on the sponge along the tool's axis at each sample, of all plates together, shape (N,) [N]; None where it is not simulated: without
    /// foam (`contact_stiffness_pa`), and under `"paper"` and `"exact"`.
    #[getter]
    fn force_n<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.felt(py, |felt| felt.force_n)
    }

    /// Greatest compression of the sponge's foam at each sample, shape (N,) [m], 0 where nothing touches; None where force is not simulated.
    #[getter]
    fn compression_m<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.felt(py, |felt| felt.deepest_m)
    }

    /// Torque limits [N·m], None for a joint without; None under a law without a plant.
    #[getter]
    fn torque_limit_n_m(&self) -> Option<[Option<f64>; 6]> {
        self.inner.execution.limits.map(|limits| limits.0)
    }

    /// Samples at which a torque limit cut what the law asked for.
    #[getter]
    fn saturated(&self) -> usize {
        self.inner.execution.saturated
    }

    /// Judges the execution: errors, torques, contact, coverage and a verdict a plate. A record; its text is the report that the
    /// command prints.
    ///
    /// Raises SimulationError for plates or sponges that make no sense.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let done = self.inner.clone();
        let report = patiently(py, move |_| {
            let Question { plan, arm, settings } = &done.question;
            SimulationReport::new(plan, arm, settings, &done.execution)
        })?;
        let report = report.map_err(|e| errors::failure(py, &e.into()))?;
        to_record(py, &report, Some(report.to_string()))
    }

    /// The executed motion as CSV text, every `dt_s` [s], by default the plan's.
    #[pyo3(signature = (dt_s=None))]
    fn to_csv(&self, py: Python<'_>, dt_s: Option<&Bound<'_, PyAny>>) -> PyResult<String> {
        let (execution, Question { plan, arm, .. }) = (&self.inner.execution, &self.inner.question);
        let dt_s = dt_s.map(|dt_s| argument::number("dt_s", dt_s)).transpose()?;
        let dt_s = dt_s.unwrap_or(plan.job.simulation.control.dt_s);
        let table = csv_table(execution, plan, arm, dt_s);
        table
            .map(|table| table.to_string())
            .map_err(|e| exception::input(py, "dt_s", &e.to_string()))
    }

    fn __len__(&self) -> usize {
        self.samples().len()
    }

    fn __repr__(&self) -> String {
        let Question { plan, settings, .. } = &self.inner.question;
        let (name, law) = (quoted(&plan.provenance.scenario), settings.law.name());
        format!(
            "Execution({name} under {law}, {} samples, {:.2} s)",
            self.samples().len(),
            self.samples().last().map_or(0.0, |sample| sample.t_s)
        )
    }

    fn __eq__(&self, other: &Self) -> bool {
        let (a, b) = (&self.inner, &other.inner);
        let (asked, other) = (&a.question, &b.question);
        (&asked.plan, &asked.settings, &a.execution) == (&other.plan, &other.settings, &b.execution)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        // The same plan on the same arm with the same settings is the same execution, to the bit.
        let simulate = slf.py().import("pyplatewash")?.getattr("simulate")?;
        Ok((simulate, (&slf.get().arguments).into_pyobject(slf.py())?))
    }
}

/// Runs a plan, or the plan file of that path, on an arm, by default the one that it was made for, under a control law, by default
/// the one that it states.
///
/// Raises SimulationError for a plan that is no motion or for another arm, a law that is not stable with the limit that was
/// passed, or an arm that leaves all bounds; DynamicsError for an arm without dynamics; ProveError for a plan whose arm
/// must be given.
#[pyfunction]
#[pyo3(signature = (plan, robot=None, settings=None))]
pub fn simulate(
    py: Python<'_>,
    plan: &Bound<'_, PyAny>,
    robot: Option<&Bound<'_, PyAny>>,
    settings: Option<&Bound<'_, PyAny>>,
) -> PyResult<ExecutionObject> {
    let plan = PlanObject::given("plan", plan)?;
    let question = Question::new(&plan, robot, settings)?;
    let robot = Robot::given(robot)?.map(|robot| robot.clone().unbind());
    let settings = Py::new(py, SettingsObject::from(question.settings.clone()))?;
    let done = patiently(py, move |cancel| {
        let Question { plan, arm, settings } = &question;
        let execution = simulate_with(plan, arm, settings, cancel)?;
        Ok(FinishedSimulation { question, execution })
    })?;
    let inner = Arc::new(done.map_err(|e: SimulationError| errors::failure(py, &e.into()))?);
    let arguments = (plan.unbind(), robot, settings);
    Ok(ExecutionObject { inner, arguments })
}
