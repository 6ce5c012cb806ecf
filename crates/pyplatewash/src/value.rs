//! Data as plain Python objects and back, by way of JSON's types.

use crate::{argument, exception};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString, PyTuple, PyType};
use pyo3::{IntoPyObjectExt, intern};
use serde::Serialize;
use serde_json::{Map, Number, Value};

/// Deepest nesting that is read: a list that contains itself ends there.
const DEEPEST: usize = 32;

static RECORD: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// Dictionaries, lists, numbers and strings; what is not finite becomes `None`.
///
/// # Errors
/// Out of memory, or a value that JSON cannot say.
pub fn to_python<'py>(py: Python<'py>, value: &impl Serialize) -> PyResult<Bound<'py, PyAny>> {
    let value = serde_json::to_value(value).map_err(|e| exception::internal(py, &e.to_string()))?;
    plain(py, &value)
}

/// A value as a `Record`, a dictionary whose keys are attributes too; `text` is what `str` of it returns.
///
/// # Errors
/// As [`to_python`].
pub fn to_record<'py>(py: Python<'py>, value: &impl Serialize, text: Option<String>) -> PyResult<Bound<'py, PyAny>> {
    let class = RECORD.import(py, "pyplatewash._records", "Record")?;
    class.call1((to_python(py, value)?, text))
}

/// Serialisable things as records.
///
/// # Errors
/// As [`to_python`].
pub fn records<'py, T: Serialize>(py: Python<'py>, all: &[T]) -> PyResult<Bound<'py, PyList>> {
    let list = PyList::empty(py);
    for one in all {
        list.append(to_record(py, one, None)?)?;
    }
    Ok(list)
}

fn plain<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(v) => v.into_bound_py_any(py)?,
        Value::Number(v) => match (v.as_u64(), v.as_i64()) {
            (Some(v), _) => v.into_bound_py_any(py)?,
            (_, Some(v)) => v.into_bound_py_any(py)?,
            _ => v.as_f64().into_bound_py_any(py)?,
        },
        Value::String(v) => v.into_bound_py_any(py)?,
        Value::Array(all) => {
            let list = PyList::empty(py);
            for v in all {
                list.append(plain(py, v)?)?;
            }
            list.into_any()
        }
        Value::Object(all) => {
            let dict = PyDict::new(py);
            for (key, v) in all {
                dict.set_item(key, plain(py, v)?)?;
            }
            dict.into_any()
        }
    })
}

/// A mapping of plain values. `None`, NumPy numbers and arrays, dataclasses and path objects count as what
/// they hold.
///
/// # Errors
/// `InputTypeError` for anything else, `InputError` for numbers that are not finite.
pub fn from_mapping(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Map<String, Value>> {
    match from_python(name, value, 0)? {
        Value::Object(map) => Ok(map),
        _ => Err(exception::wrong_type(
            value.py(),
            name,
            &format!("a dictionary is needed; found {}", argument::shown(value)),
        )),
    }
}

fn from_python(name: &str, value: &Bound<'_, PyAny>, depth: usize) -> PyResult<Value> {
    let py = value.py();
    if depth > DEEPEST {
        return Err(exception::input(py, name, "is nested too deep"));
    }
    if value.is_none() {
        return Ok(Value::Null);
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Bool(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        let number = value.extract::<i64>();
        return match number {
            Ok(number) => Ok(number.into()),
            Err(_) => Err(exception::input(py, name, "an integer is out of the range of 64 bits")),
        };
    }
    if value.is_instance_of::<PyFloat>() {
        let number: f64 = value.extract()?;
        let wrong = || exception::input(py, name, &format!("numbers must be finite; found {number}"));
        return Number::from_f64(number).map(Value::Number).ok_or_else(wrong);
    }
    if value.is_instance_of::<PyString>() {
        return match value.extract::<String>() {
            Ok(text) => Ok(Value::String(text)),
            Err(_) => Err(exception::input(py, name, "a string is not valid Unicode")),
        };
    }
    if let Ok(mapping) = value.cast::<PyMapping>() {
        return object(name, mapping, depth);
    }
    if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
        let all = value.try_iter()?.map(|item| from_python(name, &item?, depth + 1));
        return Ok(Value::Array(all.collect::<PyResult<_>>()?));
    }
    if value.hasattr(intern!(py, "__fspath__"))? {
        let path = value.call_method0(intern!(py, "__fspath__"))?;
        return from_python(name, &path, depth + 1);
    }
    if value.hasattr(intern!(py, "__dataclass_fields__"))? {
        return from_python(name, &value.getattr(intern!(py, "__dict__"))?, depth + 1);
    }
    argument::unmasked(name, value)?;
    // NumPy's numbers and arrays.
    if value.hasattr(intern!(py, "tolist"))? {
        let list = value.call_method0(intern!(py, "tolist"))?;
        return from_python(name, &list, depth + 1);
    }
    Err(exception::wrong_type(
        py,
        name,
        &format!(
            "a number, a text, a list or a dictionary is needed; found {}",
            argument::shown(value)
        ),
    ))
}

fn object(name: &str, mapping: &Bound<'_, PyMapping>, depth: usize) -> PyResult<Value> {
    let mut map = Map::new();
    for item in mapping.items()?.iter() {
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let Ok(key) = key.extract::<String>() else {
            let found = argument::shown(&key);
            return Err(exception::wrong_type(
                mapping.py(),
                name,
                &format!("a string is needed as a key; found {found}"),
            ));
        };
        let inside = if name.is_empty() {
            key.clone()
        } else {
            format!("{name}.{key}")
        };
        map.insert(key, from_python(&inside, &value, depth + 1)?);
    }
    Ok(Value::Object(map))
}
