//! The live cell: the answers to a page in a notebook. Threads, messages and traits are Python's (`python/pyplatewash/_cell.py`).

use crate::certificate::CertificateObject;
use crate::page::{bundle, height_px};
use crate::plan::PlanObject;
use crate::robot::Robot;
use crate::scenario::ScenarioObject;
use crate::warnings::warn;
use crate::work::{alone, aside};
use crate::{argument, errors, exception};
use platewash::editor::{Editor, EditorError};
use platewash::scenario::Draft;
use platewash::{CancelToken, Scenario};
use pyo3::prelude::*;
use std::sync::Arc;

/// Text, scenario, plan, certificate, and the first line of what came of them.
type LastResult = (
    String,
    ScenarioObject,
    Option<PlanObject>,
    Option<CertificateObject>,
    String,
);

/// Answers the page of a live cell.
#[pyclass(frozen, module = "pyplatewash._core", name = "CellEditor")]
pub struct CellEditorObject {
    inner: Arc<Editor>,
}

/// Exception for a scenario that cannot be edited.
fn refused(py: Python<'_>, error: &EditorError) -> PyErr {
    match error {
        EditorError::Scenario(error) => errors::scenario(py, error),
        EditorError::Failure(error) => errors::failure(py, error),
        _ => exception::internal(py, &error.to_string()),
    }
}

#[pymethods]
impl CellEditorObject {
    /// The scenario as it was opened.
    #[getter]
    fn text(&self) -> &str {
        self.inner.text()
    }

    /// The page of a scenario, which is the one that was opened with another text.
    ///
    /// Raises ScenarioError; PlanError for an arm that cannot be loaded.
    fn page(&self, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<String> {
        let text = argument::text("text", text, "TOML text")?;
        let (bundle, editor) = (bundle(py)?, self.inner.clone());
        let page = alone(py, move || match text == editor.text() {
            true => editor.framed_page(&bundle),
            false => Editor::of_text(editor.name(), &text, editor.folder())?.framed_page(&bundle),
        });
        page?.map_err(|error| refused(py, &error))
    }

    /// The scenario that a text states; its paths are relative to the folder of the one that was opened.
    ///
    /// Raises ScenarioError.
    fn parse(&self, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<ScenarioObject> {
        let text = argument::text("text", text, "TOML text")?;
        let draft = Draft::new(&text).map_err(|error| errors::scenario(py, &error))?;
        let scenario = draft.scenario(self.inner.name(), self.inner.folder());
        let scenario = scenario.map_err(|error| errors::scenario(py, &error))?;
        warn(py, &scenario.notes())?;
        Ok(scenario.into())
    }

    /// A question of the page, to be answered.
    fn ask(&self, path: &Bound<'_, PyAny>, question: &Bound<'_, PyAny>) -> PyResult<CellQuestionObject> {
        Ok(CellQuestionObject {
            editor: self.inner.clone(),
            path: argument::text("path", path, "a question's path")?,
            question: argument::text("question", question, "a question in JSON")?,
            gone: CancelToken::new(),
        })
    }

    /// The latest answer: text, scenario, plan, certificate, and a line about it; None before the first.
    fn latest(&self, py: Python<'_>) -> PyResult<Option<LastResult>> {
        let Some(latest) = self.inner.latest() else {
            return Ok(None);
        };
        let robot = own_robot(py, &latest.scenario)?;
        let plan = latest.plan.map(|plan| PlanObject::new(plan.as_ref().clone(), robot));
        let certificate = latest.certificate.as_deref().cloned();
        let certificate = certificate.map(CertificateObject::from);
        Ok(Some((
            latest.text,
            latest.scenario.into(),
            plan,
            certificate,
            latest.headline,
        )))
    }
}

/// The arm of a scenario's files; `None` for the built-in arm, and where the files no longer exist. In the latter case a plan asks for its
/// arm, as a loaded plan does.
fn own_robot(py: Python<'_>, scenario: &Scenario) -> PyResult<Option<Py<Robot>>> {
    if scenario.robot.urdf.is_none() {
        return Ok(None);
    }
    let arm = alone(py, || scenario.arm())?;
    Ok(arm.ok().and_then(|arm| Robot::of_scenario(py, scenario, arm).ok()))
}

/// A question of the page.
#[pyclass(frozen, module = "pyplatewash._core", name = "CellQuestion")]
pub struct CellQuestionObject {
    editor: Arc<Editor>,
    path: String,
    question: String,
    gone: CancelToken,
}

#[pymethods]
impl CellQuestionObject {
    /// Answers it on this thread: `tell` gets line after line of JSON, and says whether anybody listens.
    ///
    /// Raises InternalError.
    fn answer(&self, py: Python<'_>, tell: Py<PyAny>) -> PyResult<()> {
        aside(py, || {
            let mut told = |line: String| Python::attach(|py| listens(py, &tell, line));
            let question = self.question.as_bytes();
            self.editor.answer(&self.path, question, &mut told, &self.gone);
        })
    }

    /// Gives it up, now or before it is begun.
    fn cancel(&self) {
        self.gone.cancel();
    }
}

/// Passes a line to the listener; false where it wants no more lines, or raises.
fn listens(py: Python<'_>, tell: &Py<PyAny>, line: String) -> bool {
    let answer = tell.call1(py, (line,)).and_then(|answer| answer.extract(py));
    answer.unwrap_or_else(|error| {
        error.write_unraisable(py, Some(tell.bind(py)));
        false
    })
}

/// Arguments of `edit`: what answers the page of the scenario, which is loaded, and the height of the page [px].
#[pyfunction]
pub fn _edit_arguments(scenario: &Bound<'_, PyAny>, height: &Bound<'_, PyAny>) -> PyResult<(CellEditorObject, usize)> {
    let py = scenario.py();
    let height_px = height_px(Some(height))?;
    bundle(py)?;
    let opened = match scenario.cast::<ScenarioObject>() {
        Ok(given) => Editor::of_text(&given.get().inner().name, &given.get().to_toml(py)?, None),
        Err(_) => Editor::open(&named(scenario)?),
    };
    let inner = Arc::new(opened.map_err(|error| refused(py, &error))?.with_memory());
    Ok((CellEditorObject { inner }, height_px))
}

/// The name or file of a scenario.
fn named(scenario: &Bound<'_, PyAny>) -> PyResult<String> {
    const NEEDED: &str = "a Scenario, the name of a shipped one or the path of a file";
    let path: std::path::PathBuf = scenario
        .extract()
        .map_err(|error| argument::refused("scenario", scenario, NEEDED, error))?;
    Ok(path.to_string_lossy().into_owned())
}
