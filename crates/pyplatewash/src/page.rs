//! Pages in three dimensions.

use crate::certificate::CertificateObject;
use crate::errors::{self, FileOf, SystemWord};
use crate::plan::PlanObject;
use crate::plate::PlateFields;
use crate::robot::Robot;
use crate::scenario::ScenarioObject;
use crate::simulation::{Done, ExecutionObject, Question};
use crate::tool::ToolFields;
use crate::work::patiently;
use crate::{argument, arrays};
use platewash::viewer::bundle::Bundle;
use platewash::viewer::page;
use platewash::viewer::view::{Beside, Executed, Plate, View};
use platewash::{Certificate, JointVector, SimulationError, SimulationReport};
use pyo3::prelude::*;
use std::sync::Arc;

/// Heights of a page in a notebook that are believed \[px\].
const HEIGHTS_PX: [u64; 2] = [100, 10_000];

const MISSING: &str = "this build of pyplatewash is without the page that shows plans: where its sources are, `cargo xtask page` makes \
                       it, which needs a network once, and `pip install .` takes it along";

/// The bundle that all pages share.
///
/// # Errors
/// `MissingError` in a build without it.
pub fn bundle(py: Python<'_>) -> PyResult<Bundle> {
    Bundle::embedded().ok_or_else(|| errors::missing(py, "page", MISSING))
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

/// A document as a page.
fn html(py: Python<'_>, view: &View, bundle: &Bundle) -> PyResult<String> {
    page::html(view, bundle).map_err(|e| errors::internal(py, &e.to_string()))
}

/// What is proved of a plan and what an arm made of it, as they are given.
///
/// # Errors
/// `InputError` for those of another plan.
pub fn of_the_plan(
    py: Python<'_>,
    plan: &PlanObject,
    execution: Option<&ExecutionObject>,
    certificate: Option<&CertificateObject>,
) -> PyResult<(Option<Certificate>, Option<Arc<Done>>)> {
    let certificate = certificate.map(|certificate| certificate.inner().clone());
    let hash = plan.inner().seal().ok();
    if certificate.as_ref().is_some_and(|c| c.hash.computed != hash) {
        return Err(errors::input(py, "certificate", "is one of another plan"));
    }
    let done = execution.map(ExecutionObject::done);
    if done.as_ref().is_some_and(|done| done.question.plan != *plan.inner()) {
        return Err(errors::input(py, "execution", "is one of another plan"));
    }
    Ok((certificate, done))
}

/// What a page shows of a plan.
fn view(
    py: Python<'_>,
    plan: &PlanObject,
    robot: &Robot,
    execution: Option<&ExecutionObject>,
    certificate: Option<&CertificateObject>,
    scenario: Option<&ScenarioObject>,
) -> PyResult<View> {
    let (certificate, done) = of_the_plan(py, plan, execution, certificate)?;
    let region = scenario.map(|scenario| scenario.inner().task_region());
    let (plan, arm) = (plan.inner().clone(), robot.model().clone());
    let made = patiently(py, move |_| {
        let executed = done.map(|done| executed(&done)).transpose()?;
        let beside = Beside {
            certificate: certificate.as_ref(),
            executed: executed.as_ref(),
            region: region.as_ref(),
            events: None,
        };
        Ok::<_, SimulationError>(View::of_plan(&plan, &arm, &beside))
    })?;
    let made = made.map_err(|error| errors::failure(py, &error.into()))?;
    made.map_err(|error| errors::keyed(py, "plan", &error.to_string()))
}

/// An execution, judged.
fn executed(done: &Done) -> Result<Executed, SimulationError> {
    let Question { plan, arm, settings } = &done.question;
    let report = SimulationReport::new(plan, arm, settings, &done.execution)?;
    Ok(Executed::simulated(&done.execution, &report))
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
        return Err(errors::input(py, "q", "is not finite"));
    }
    let tool = tool.map(|tool| ToolFields::of(tool)?.tool(py)).transpose()?;
    let read = |name: &str, plate: &Bound<'_, PyAny>| PlateFields::of(name, plate)?.plate(py);
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
        errors::system_file(py, FileOf::Page, SystemWord::from(&e), &filename, &message)
    })
}
