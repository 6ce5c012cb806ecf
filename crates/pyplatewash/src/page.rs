//! Pages in three dimensions.
//!
//! Figures of a plan, and arguments of the methods that show it on a page: checked before any work is done.

use crate::certificate::CertificateObject;
use crate::errors::{self, FileKind, SystemWord};
use crate::plan::PlanObject;
use crate::plate::PlateFields;
use crate::robot::Robot;
use crate::scenario::{self, ScenarioObject};
use crate::simulation::{ExecutionObject, FinishedSimulation, Question};
use crate::tool::ToolFields;
use crate::work::patiently;
use crate::{argument, arrays, exception};
use platewash::motion::plan::Process;
use platewash::viewer::bundle::Bundle;
use platewash::viewer::figures::{Figure, FigureData, draw};
use platewash::viewer::page;
use platewash::viewer::view::{ExecutedMotion, Plate, View, ViewExtras};
use platewash::workcell::ArmId;
use platewash::{Certificate, Failure, JointVector, SimulationError, SimulationReport, paper_spirals};
use pyo3::prelude::*;
use std::sync::Arc;

/// Least and largest accepted height of a page in a notebook \[px\].
const HEIGHTS_PX: [u64; 2] = [100, 10_000];

const MISSING: &str = "this build of pyplatewash is without the page that shows plans: where its sources are, `cargo xtask page` makes \
                       it, which needs a network once, and `pip install .` takes it along";

/// The bundle that all pages share.
///
/// # Errors
/// `MissingError` in a build without it.
pub fn bundle(py: Python<'_>) -> PyResult<Bundle> {
    Bundle::embedded().ok_or_else(|| exception::missing(py, "page", MISSING))
}

/// The argument called `height` \[px\], 640 where it is not given.
///
/// # Errors
/// `InputTypeError`; `InputError` out of range.
pub fn height_px(value: Option<&Bound<'_, PyAny>>) -> PyResult<usize> {
    value.map_or(Ok(640), |value| argument::count("height", value, HEIGHTS_PX))
}

/// Checks the field of Python's `Figure`.
///
/// # Errors
/// `InputTypeError` for a figure that is no text.
pub fn check_figure(figure: &Bound<'_, PyAny>) -> PyResult<()> {
    argument::text("svg", &figure.getattr("svg")?, "a figure's text").map(|_| ())
}

/// Checks the fields of Python's `Page`.
///
/// # Errors
/// As [`height_px`]; `InputTypeError` for a page that is no text.
pub fn check(page: &Bound<'_, PyAny>) -> PyResult<()> {
    argument::text("html", &page.getattr("html")?, "a page's text")?;
    height_px(Some(&page.getattr("height")?)).map(|_| ())
}

/// HTML page of a view.
fn html(py: Python<'_>, view: &View, bundle: &Bundle) -> PyResult<String> {
    page::html(view, bundle).map_err(|e| exception::internal(py, &e.to_string()))
}

/// Returns the certificate and the execution that are given, after a check that both belong to the plan.
///
/// # Errors
/// `InputError` for those of another plan.
pub fn of_the_plan(
    py: Python<'_>,
    plan: &PlanObject,
    execution: Option<&ExecutionObject>,
    certificate: Option<&CertificateObject>,
) -> PyResult<(Option<Certificate>, Option<Arc<FinishedSimulation>>)> {
    let certificate = certificate.map(|certificate| certificate.inner().clone());
    let hash = plan.inner().seal().ok();
    if certificate.as_ref().is_some_and(|c| c.hash.computed != hash) {
        return Err(exception::input(py, "certificate", "is one of another plan"));
    }
    let done = execution.map(ExecutionObject::done);
    if done.as_ref().is_some_and(|done| done.question.plan != *plan.inner()) {
        return Err(exception::input(py, "execution", "is one of another plan"));
    }
    Ok((certificate, done))
}

/// Document that a page shows of a plan.
fn view(
    py: Python<'_>,
    plan: &PlanObject,
    robot: &Robot,
    execution: Option<&ExecutionObject>,
    certificate: Option<&CertificateObject>,
    scenario: Option<&ScenarioObject>,
) -> PyResult<View> {
    let (certificate, done) = of_the_plan(py, plan, execution, certificate)?;
    let region = scenario.map(|scenario| scenario.inner().task_region(robot.model()));
    let (plan, arm) = (plan.inner().clone(), robot.model().clone());
    let made = patiently(py, move |_| {
        let executed = done.map(|done| executed(&done)).transpose()?;
        let beside = ViewExtras {
            certificate: certificate.as_ref(),
            executed: executed.as_ref(),
            region: region.as_ref(),
            events: None,
        };
        Ok::<_, SimulationError>(View::of_plan(&plan, &arm, &beside))
    })?;
    let made = made.map_err(|error| errors::failure(py, &error.into()))?;
    made.map_err(|error| exception::keyed(py, "plan", &error.to_string()))
}

/// The executed motion with its report, for a page.
fn executed(finished: &FinishedSimulation) -> Result<ExecutedMotion, SimulationError> {
    let Question { plan, arm, settings } = &finished.question;
    let report = SimulationReport::new(plan, arm, settings, &finished.execution)?;
    Ok(ExecutedMotion::simulated(&finished.execution, &report))
}

/// The page of a plan.
#[pyfunction]
pub fn _plan_page(
    py: Python<'_>,
    plan: &PlanObject,
    robot: &Robot,
    execution: Option<&ExecutionObject>,
    certificate: Option<&CertificateObject>,
    scenario: Option<&ScenarioObject>,
) -> PyResult<String> {
    let bundle = bundle(py)?;
    let view = view(py, plan, robot, execution, certificate, scenario)?;
    html(py, &view, &bundle)
}

/// The page of one configuration of an arm, and its height.
#[pyfunction]
pub fn _configuration_page(
    robot: &Robot,
    q: &Bound<'_, PyAny>,
    tool: Option<&Bound<'_, PyAny>>,
    plates: Option<&Bound<'_, PyAny>>,
    height: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, usize)> {
    let (py, height) = (q.py(), height_px(height)?);
    let q: JointVector = arrays::joint_vector("q", q)?;
    if !q.iter().all(|v| v.is_finite()) {
        return Err(exception::input(py, "q", "is not finite"));
    }
    let tool = tool.map(|tool| ToolFields::read(tool)?.on(py, robot.model()));
    let tool = tool.transpose()?;
    let read = |name: &str, plate: &Bound<'_, PyAny>| PlateFields::read(name, plate)?.plate(py);
    let plates = plates.map(|plates| argument::each("plates", plates, "a list of Plates", read));
    let plates = plates.transpose()?.unwrap_or_default();
    let bundle = bundle(py)?;
    let mut view = View::of_configuration(robot.model(), tool.as_ref(), &q);
    view.plates = plates
        .iter()
        .enumerate()
        .map(|(k, plate)| Plate::new(k, plate))
        .collect();
    Ok((html(py, &view, &bundle)?, height))
}

/// Writes a page or a figure to a file.
#[pyfunction]
pub fn _save(py: Python<'_>, text: &Bound<'_, PyAny>, path: &Bound<'_, PyAny>) -> PyResult<()> {
    let path = argument::path("path", path)?;
    let text = argument::text("text", text, "a text")?;
    std::fs::write(&path, text).map_err(|e| {
        let filename = path.display().to_string();
        let message = format!("{filename}: cannot be written: {e}");
        errors::system_file(py, FileKind::Page, SystemWord::from(&e), &filename, &message)
    })
}

/// An argument that may be left out.
type OptionalArgument<'py> = Option<Bound<'py, PyAny>>;

/// The arm, and a scenario.
type Surroundings = (Py<Robot>, Option<ScenarioObject>);

/// The arm and the scenario of arguments.
fn surroundings(
    plan: &Bound<'_, PlanObject>,
    scenario: Option<&Bound<'_, PyAny>>,
    robot: Option<&Bound<'_, PyAny>>,
) -> PyResult<Surroundings> {
    let robot = plan.get().robot_for(plan.py(), Robot::given(robot)?)?;
    let scenario = scenario.map(scenario::given).transpose()?;
    Ok((robot, scenario.map(ScenarioObject::from)))
}

/// Arguments of `Plan.show` and `Plan.view`: the arm, the scenario, whether to prove and to simulate, and the height of a cell [px].
///
/// Raises what the methods raise before they prove or simulate.
#[pyfunction]
pub fn _show_arguments<'py>(
    plan: &Bound<'py, PlanObject>,
    beside: (
        OptionalArgument<'py>,
        OptionalArgument<'py>,
        OptionalArgument<'py>,
        OptionalArgument<'py>,
    ),
    prove: Option<&Bound<'py, PyAny>>,
    simulate: Option<&Bound<'py, PyAny>>,
    height: Option<&Bound<'py, PyAny>>,
    path: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Surroundings, [bool; 2], usize)> {
    let (execution, certificate, scenario, robot) = &beside;
    ExecutionObject::given(execution.as_ref())?;
    CertificateObject::given(certificate.as_ref())?;
    let surroundings = surroundings(plan, scenario.as_ref(), robot.as_ref())?;
    let flag = |name, value: Option<&Bound<'py, PyAny>>| value.map_or(Ok(true), |value| argument::flag(name, value));
    let (prove, simulate) = (flag("prove", prove)?, flag("simulate", simulate)?);
    path.map(|path| argument::path("path", path)).transpose()?;
    let height = height_px(height)?;
    bundle(plan.py())?;
    Ok((surroundings, [prove, simulate], height))
}

/// A figure of a plan as SVG, of an execution, a certificate, a scenario and an arm.
///
/// Raises what `Plan.figure` says.
#[pyfunction]
pub fn _plan_figure<'py>(
    plan: &Bound<'py, PlanObject>,
    kind: Option<&Bound<'py, PyAny>>,
    of: (
        OptionalArgument<'py>,
        OptionalArgument<'py>,
        OptionalArgument<'py>,
        OptionalArgument<'py>,
    ),
) -> PyResult<String> {
    let (py, (execution, certificate, scenario, robot)) = (plan.py(), &of);
    let execution = ExecutionObject::given(execution.as_ref())?.map(|execution| execution.get());
    let certificate = CertificateObject::given(certificate.as_ref())?.map(|certificate| certificate.get());
    let (robot, scenario) = surroundings(plan, scenario.as_ref(), robot.as_ref())?;
    let kind = kind.map_or(Ok("layout".to_owned()), |kind| {
        argument::text("kind", kind, "a figure's name")
    })?;
    let figure = Figure::named(&kind).map_err(|unknown| exception::input(py, "kind", &unknown.to_string()))?;
    let plan = plan.get();
    let (certificate, done) = of_the_plan(py, plan, execution, certificate)?;
    let (plan, arm) = (plan.inner().clone(), robot.get().model().clone());
    let known = &plan.job.workcell.arm;
    if ArmId::new(&arm).urdf_sha256 != known.urdf_sha256 {
        let words = format!(
            "the plan was made for another arm, '{}'; found '{}'",
            known.name,
            arm.name()
        );
        return Err(exception::input(py, "robot", &words));
    }
    let region = scenario.map(|scenario| scenario.inner().task_region(&arm));
    let drawn = patiently(py, move |cancel| {
        let report = done.as_ref().map(|done| {
            let Question { plan, arm, settings } = &done.question;
            SimulationReport::new(plan, arm, settings, &done.execution)
        });
        let report = report.transpose()?;
        let ideal = match plan.process {
            // The spirals are unknown for a plan that the program would not make again.
            Process::Paper => paper_spirals(&plan, &arm, cancel).ok(),
            Process::Wash => None,
        };
        let draw = || {
            let mut data = FigureData::new(&plan, &arm)?;
            if let (Some(done), Some(report)) = (&done, &report) {
                data = data.executed(&done.execution, report)?;
            }
            data.certificate = certificate.as_ref();
            data.region = region.unwrap_or_default();
            data.ideal = ideal.unwrap_or(data.ideal);
            draw(&data, figure)
        };
        Ok::<_, Failure>(draw())
    })?;
    let drawn = drawn.map_err(|error| errors::failure(py, &error))?;
    drawn.map_err(|error| exception::keyed(py, "plan", &error.to_string()))
}
