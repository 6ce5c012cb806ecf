//! The text of a study file out of what a call states.

use crate::scenario::ScenarioObject;
use crate::value::from_mapping;
use crate::{argument, errors};
use platewash::study::StudyError;
use pyo3::prelude::*;
use pyo3::types::{PyFrozenSet, PyMapping, PyRange, PyRangeMethods, PySet, PyString};
use serde_json::{Map, Value, json};

/// The keys of `plans`.
const PLANS: [(&str, &str); 3] = [("none", "none"), ("failed", "failed"), ("all", "all")];
/// What a scenario must be.
const SCENARIO: &str = "a Scenario, the name of a shipped one, the path of a file or a list of them";

/// The TOML text of a study.
///
/// # Errors
/// `InputTypeError` and `InputError`, naming the argument and the key.
pub fn text(
    py: Python<'_>,
    scenario: &Bound<'_, PyAny>,
    (axes, rows): (Option<&Bound<'_, PyAny>>, Option<&Bound<'_, PyAny>>),
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
    toml::to_string(&study).map_err(|error| errors::input(py, "axes", &error.to_string()))
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
            None => Err(errors::input(given.py(), name, "is not valid Unicode")),
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
    errors::wrong_type(py, at, "a value is needed; found None")
}
