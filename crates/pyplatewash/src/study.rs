//! `Study`: many scenarios as one value, and the text of a study file from the arguments of a call. Its rows are worked on by
//! `study_journal` and `study_worker`, which Python's engines drive (`python/pyplatewash/_studies/`).

use crate::scenario::ScenarioObject;
use crate::value::{from_mapping, to_record};
use crate::work::{ask, patiently};
use crate::{argument, errors, exception};
use platewash::kinematics::urdf::Files;
use platewash::scenario::Draft;
use platewash::study::{self, Study, StudyError, StudyParts};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyFrozenSet, PyMapping, PyRange, PyRangeMethods, PySet, PyString, PyTuple, PyType};
use serde_json::{Map, Value, json};
use std::path::Path;
use std::sync::Arc;

/// Name, in messages, of a study that comes from no file.
const UNSAVED: &str = "study";

/// Many scenarios, each to be planned and proved: the rows of a study file (docs/studies.md), as a value that travels to whoever
/// works on it. Everything that it names is read when it is made: rows do not depend on what becomes of files later.
///
/// `scenario` is a Scenario, the name of a shipped one, a file, or a list of them. `axes` maps keys of scenarios to their values, as
/// `{"tool.length_m": [0.1, 0.15], "seed": range(1, 501)}`: they multiply, the last one is the fastest. `rows` states keys and values
/// row by row instead (`samples` draws some). `plans` says whose plans are kept: "none", "failed" (planned, but not proved) or "all".
///
/// Raises StudyError for what is no study; ScenarioError does not arise: a scenario's fault is told as the study's.
#[pyclass(frozen, module = "pyplatewash", name = "Study")]
pub struct StudyObject {
    inner: Arc<Study>,
}

impl StudyObject {
    /// The study of the argument `study`.
    ///
    /// # Errors
    /// `InputTypeError`.
    pub fn given(value: &Bound<'_, PyAny>) -> PyResult<Arc<Study>> {
        Ok(argument::object::<Self>("study", value, "a Study")?.get().inner.clone())
    }

    /// The object of a study that was read.
    ///
    /// # Errors
    /// `StudyError`, for a study that could not be read.
    fn from_result(py: Python<'_>, study: Result<Study, StudyError>) -> PyResult<Self> {
        let inner = study.map(Arc::new).map_err(|error| errors::study(py, error))?;
        Ok(Self { inner })
    }

    /// An index of a row.
    fn index(&self, index: &Bound<'_, PyAny>) -> PyResult<u64> {
        Ok(argument::count("index", index, [0, self.inner.rows() - 1])? as u64)
    }
}

#[pymethods]
impl StudyObject {
    #[new]
    #[pyo3(signature = (scenario, axes=None, rows=None, *, name=None, plans=None), text_signature = "(scenario, axes=None, rows=None, *, name='study', plans='none')")]
    fn new(
        py: Python<'_>,
        scenario: &Bound<'_, PyAny>,
        axes: Option<&Bound<'_, PyAny>>,
        rows: Option<&Bound<'_, PyAny>>,
        name: Option<&Bound<'_, PyAny>>,
        plans: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let text = text(py, scenario, axes, rows, name, plans)?;
        let study = Study::parse(&text, UNSAVED, Path::new(""));
        Self::from_result(py, study.map_err(without_line))
    }

    /// The study of a file, or the one that a folder keeps the rows of, which needs no other file.
    ///
    /// Raises StudyError with the line and the key; where the file cannot be read, it is a FileError, too.
    #[classmethod]
    fn load(_class: &Bound<'_, PyType>, py: Python<'_>, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path = argument::path("path", path)?;
        Self::from_result(py, Study::load(&path))
    }

    /// A study from TOML text; files that it names are relative to the working folder.
    ///
    /// Raises StudyError.
    #[classmethod]
    fn parse(_class: &Bound<'_, PyType>, py: Python<'_>, text: &Bound<'_, PyAny>) -> PyResult<Self> {
        let text = argument::text("text", text, "TOML text")?;
        Self::from_result(py, Study::parse(&text, UNSAVED, Path::new("")))
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.inner.name
    }

    /// The scenarios, as the study names them.
    #[getter]
    fn scenarios(&self) -> Vec<&str> {
        self.inner.bases.iter().map(|base| base.name.as_str()).collect()
    }

    /// Number of values of each axis, by its key; empty where rows are listed.
    #[getter]
    fn axes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let axes = PyDict::new(py);
        for axis in &self.inner.axes {
            axes.set_item(&axis.key, axis.count())?;
        }
        Ok(axes)
    }

    /// The study as a TOML file's text, which the command takes too: `platewash study run FILE --out DIR`.
    fn to_toml(&self) -> &str {
        &self.inner.text
    }

    fn __len__(&self) -> usize {
        usize::try_from(self.inner.rows()).unwrap_or(usize::MAX)
    }

    /// Facts about a row before it is worked on: `index`, `key`, `scenario` and the values of the `axes`.
    fn row<'py>(&self, py: Python<'py>, index: &Bound<'_, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let index = self.index(index)?;
        let row = self.inner.row(index).map_err(|error| errors::study(py, error))?;
        let base = &self.inner.bases[row.base].name;
        let known = serde_json::json!({"index": index, "key": row.key, "scenario": base, "axes": row.axes});
        to_record(py, &known, None)
    }

    /// The scenario of a row, to plan it alone, with the files that the study names as they were.
    ///
    /// Raises StudyError where the row's values do not go together.
    fn scenario(&self, py: Python<'_>, index: &Bound<'_, PyAny>) -> PyResult<ScenarioObject> {
        let index = self.index(index)?;
        let text = self
            .inner
            .scenario_text(index)
            .map_err(|error| errors::study(py, error))?;
        let row = self.inner.row(index).map_err(|error| errors::study(py, error))?;
        let base = &self.inner.bases[row.base];
        let scenario = Draft::new(&text).and_then(|draft| draft.scenario(&base.name, base.folder.as_deref()));
        let mut scenario = scenario.map_err(|error| errors::scenario(py, &error))?;
        if !self.inner.files.is_empty() {
            scenario.files = Files::held(self.inner.files.clone());
        }
        Ok(scenario.into())
    }

    /// Works on the rows that are missing in the folder `out`, and keeps each as soon as it is done: ended by whatever, the same call goes
    /// on where it was. The answer is what was found.
    ///
    /// `engine` is "threads" (of this process), "processes" (of this machine), "dask" or "ray" (a cluster); the rows are the same
    /// for each. `workers` says how many, all processors without it, and is refused with a cluster that is there, which is named by
    /// `client` (a `distributed.Client`) or `address`, or is the process's Ray session. `progress` draws a bar, by tqdm where it is
    /// installed, or is called with (done, rows).
    ///
    /// Raises StudyError where the folder keeps another study, or another process works on it; EngineError where workers cannot be had;
    /// MissingError without the package of an engine.
    #[pyo3(signature = (out, *, engine=None, workers=None, client=None, address=None, progress=None), text_signature = "($self, out, *, engine='threads', workers=None, client=None, address=None, progress=True)")]
    #[allow(clippy::too_many_arguments)]
    fn run<'py>(
        slf: &Bound<'py, Self>,
        out: &Bound<'py, PyAny>,
        engine: Option<&Bound<'py, PyAny>>,
        workers: Option<&Bound<'py, PyAny>>,
        client: Option<&Bound<'py, PyAny>>,
        address: Option<&Bound<'py, PyAny>>,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = slf.py();
        let out = argument::path("out", out)?;
        let names = ["threads", "processes", "dask", "ray"].map(|name| (name, name));
        let engine = engine.map_or(Ok("threads"), |engine| argument::word("engine", engine, &names))?;
        let workers = workers
            .map(|workers| argument::count("workers", workers, [1, 1 << 16]))
            .transpose()?;
        let address = address.map(|address| argument::text("address", address, "the address of a cluster"));
        let address = address.transpose()?;
        let arguments = (slf, out, engine, workers, client, address, progress);
        ask(py, "_studies.run", "run", arguments)
    }

    /// All of it, for workers without its files.
    fn _parts<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, self.inner.parts().to_json().as_bytes())
    }

    #[classmethod]
    fn _restored(_class: &Bound<'_, PyType>, py: Python<'_>, parts: &Bound<'_, PyBytes>) -> PyResult<Self> {
        Self::from_result(py, restored(parts))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let other = other.cast::<Self>();
        other.is_ok_and(|other| other.get().inner.parts() == self.inner.parts())
    }

    fn __hash__(&self) -> u64 {
        self.inner.rows() ^ self.inner.text.len() as u64
    }

    fn __repr__(&self) -> String {
        format!("Study('{}', {} rows)", self.inner.name, self.inner.rows())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let parts = slf.get()._parts(slf.py());
        Ok((slf.get_type().getattr("_restored")?, PyTuple::new(slf.py(), [parts])?))
    }
}

/// Looks at each row in a folder, those of a finished study are refused where it was finished with others. The answer is their indices,
/// growing, and where each begins in the file \[bytes\]: 8 bytes a number, the lowest first.
#[pyfunction]
pub fn _study_check<'py>(py: Python<'py>, folder: &Bound<'_, PyAny>) -> PyResult<[Bound<'py, PyBytes>; 2]> {
    let folder = argument::path("folder", folder)?;
    let rows = patiently(py, move |_| study::check(&folder))?.map_err(|error| errors::study(py, error))?;
    let (indices, places): (Vec<u64>, Vec<u64>) = rows.into_iter().unzip();
    let bytes = |values: Vec<u64>| values.into_iter().flat_map(u64::to_le_bytes).collect::<Vec<_>>();
    Ok([indices, places].map(|values| PyBytes::new(py, &bytes(values))))
}

/// Summary of the rows in a folder.
#[pyfunction]
pub fn _study_summary<'py>(py: Python<'py>, folder: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let folder = argument::path("folder", folder)?;
    let summary = patiently(py, move |_| study::summary(&folder))?;
    to_record(py, &summary.map_err(|error| errors::study(py, error))?, None)
}

/// A study from its parts.
pub fn restored(parts: &Bound<'_, PyBytes>) -> Result<Study, StudyError> {
    let text = String::from_utf8_lossy(parts.as_bytes());
    StudyParts::from_json(&text).and_then(Study::from_parts)
}

/// The keys of `plans`.
const PLANS: [(&str, &str); 3] = [("none", "none"), ("failed", "failed"), ("all", "all")];
/// Expected forms of a scenario, in messages.
const SCENARIO: &str = "a Scenario, the name of a shipped one, the path of a file or a list of them";

/// The TOML text of a study.
///
/// # Errors
/// `InputTypeError` and `InputError`, naming the argument and the key.
pub fn text(
    py: Python<'_>,
    scenario: &Bound<'_, PyAny>,
    axes: Option<&Bound<'_, PyAny>>,
    rows: Option<&Bound<'_, PyAny>>,
    name: Option<&Bound<'_, PyAny>>,
    plans: Option<&Bound<'_, PyAny>>,
) -> PyResult<String> {
    let mut study = Map::new();
    let mut put = |key: &str, value: Value| drop(study.insert(key.to_owned(), value));
    put("format", json!("platewash-study/1"));
    let name = name.map_or_else(|| Ok("study".to_owned()), |name| argument::text("name", name, "a name"))?;
    put("name", json!(name));
    put("scenario", scenarios(scenario)?);
    if let Some(plans) = plans {
        put("plans", json!(argument::word("plans", plans, &PLANS)?));
    }
    if let Some(axes) = axes {
        put("axis", Value::Array(each_axis(axes)?));
    }
    if let Some(rows) = rows {
        let row = |name: &str, row: &Bound<'_, PyAny>| from_mapping(name, row).map(Value::Object);
        let rows = argument::each("rows", rows, "a list of dictionaries", row)?;
        refuse_nulls("rows", &Value::Array(rows.clone())).map_err(|at| none(py, &at))?;
        put("rows", Value::Array(rows));
    }
    toml::to_string(&study).map_err(|error| exception::input(py, "axes", &error.to_string()))
}

/// An error without the line of a text that nobody has seen.
pub fn without_line(error: StudyError) -> StudyError {
    match error {
        StudyError::File { file, problem, .. } => StudyError::File {
            file,
            line: None,
            problem,
        },
        other => other,
    }
}

fn scenarios(given: &Bound<'_, PyAny>) -> PyResult<Value> {
    let is_one = given.is_instance_of::<PyString>()
        || given.is_instance_of::<ScenarioObject>()
        || given.hasattr("__fspath__")?;
    let one = |name: &str, given: &Bound<'_, PyAny>| {
        if let Ok(scenario) = given.cast::<ScenarioObject>() {
            let text = scenario.get().to_toml(given.py())?;
            return Ok(json!({"name": scenario.get().inner().name, "text": text}));
        }
        let path = argument::path(name, given).map_err(|e| argument::refused(name, given, SCENARIO, e))?;
        match path.to_str() {
            Some(path) => Ok(Value::from(path)),
            None => Err(exception::input(given.py(), name, "is not valid Unicode")),
        }
    };
    if is_one {
        return one("scenario", given);
    }
    argument::each("scenario", given, SCENARIO, one).map(Value::Array)
}

fn each_axis(axes: &Bound<'_, PyAny>) -> PyResult<Vec<Value>> {
    const NEEDED: &str = "a dictionary from keys to their values";
    let mapping = axes.cast::<PyMapping>();
    let mapping = mapping.map_err(|_| argument::wrong_type("axes", axes, NEEDED))?;
    let mut all = Vec::new();
    for item in mapping.items()?.iter() {
        let (key, values): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let key = argument::text("axes", &key, "the key of a scenario")?;
        all.push(axis(&key, &values)?);
    }
    Ok(all)
}

/// One axis. Seeds in a row are a range of the file, which is not listed.
fn axis(key: &str, values: &Bound<'_, PyAny>) -> PyResult<Value> {
    let at = format!("axes[{key}]");
    if let Ok(range) = values.cast::<PyRange>()
        && key == "seed"
    {
        let wide = |e| argument::refused(&at, values, "a range of seeds up to 2⁵³ − 1", e);
        let (first, end, step) = (
            range.start().map_err(wide)?,
            range.stop().map_err(wide)?,
            range.step().map_err(wide)?,
        );
        if step == 1 && first < end {
            return Ok(json!({"key": key, "seeds": format!("{first}..{}", end - 1)}));
        }
    }
    // A set has no order, so that each start of the interpreter gave other rows.
    let is_unordered = values.is_instance_of::<PySet>() || values.is_instance_of::<PyFrozenSet>();
    if is_unordered || values.is_instance_of::<PyString>() || values.cast::<PyMapping>().is_ok() {
        return Err(argument::wrong_type(&at, values, "a list of values"));
    }
    let py = values.py();
    let one = |name: &str, value: &Bound<'_, PyAny>| {
        let held = pyo3::types::PyDict::new(py);
        held.set_item(name, value)?;
        let mut held = from_mapping("", &held)?;
        let value = held.remove(name).unwrap_or_default();
        refuse_nulls(name, &value).map_err(|at| none(py, &at))?;
        Ok(value)
    };
    let values = argument::each(&at, values, "a list of values", one)?;
    Ok(json!({"key": key, "values": values}))
}

/// The place of the first value that no file can state.
fn refuse_nulls(at: &str, value: &Value) -> Result<(), String> {
    match value {
        Value::Null => Err(at.to_owned()),
        Value::Array(all) => {
            let mut all = all.iter().enumerate();
            all.try_for_each(|(k, value)| refuse_nulls(&format!("{at}[{k}]"), value))
        }
        Value::Object(all) => all
            .iter()
            .try_for_each(|(key, value)| refuse_nulls(&format!("{at}.{key}"), value)),
        _ => Ok(()),
    }
}

fn none(py: Python<'_>, at: &str) -> PyErr {
    exception::wrong_type(py, at, "a value is needed; found None")
}
