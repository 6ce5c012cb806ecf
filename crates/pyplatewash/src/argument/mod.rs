//! Arguments: the one place where what Python hands over becomes a number, a text, a path or an object of ours.
//!
//! Every public callable takes plain Python objects and reads them here (arrays in `arrays`, tables in `value`). What does not do
//! is refused in one form: the argument's name, what is needed, what was found. A wrong type is an `InputTypeError`, a wrong
//! value an `InputError`. What a foreign object raises itself, such as an iterator of the caller's, is passed on.

mod for_python;
mod scalar;

pub use for_python::{
    _argument_count, _argument_flag, _argument_number, _argument_path, _argument_shown, _argument_texts, _argument_word,
};
pub use scalar::{ANY_COUNT, count, flag, number, number_or, seed, text, word};

use crate::errors;
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBool, PyBytes, PyFloat, PyInt, PyString, PyType};
use pyo3::{PyClass, intern};
use std::path::PathBuf;

/// Most characters of a value that a message shows.
const MOST_SHOWN: usize = 60;
/// Most items of a sequence that is read one by one.
const MOST_ITEMS: usize = 10_000_000;
/// What a tool must be.
pub const TOOL: &str = "a Tool";
/// What an arm must be.
pub const ROBOT: &str = "a Robot";

static MASKED_ARRAY: PyOnceLock<Py<PyType>> = PyOnceLock::new();

/// The name of a value's type.
pub fn type_name(value: &Bound<'_, PyAny>) -> String {
    value
        .get_type()
        .name()
        .map_or_else(|_| "an unnameable type".to_owned(), |name| name.to_string())
}

/// A value as messages show it: `-5 (int)`; only its type where its text may be long.
pub fn shown(value: &Bound<'_, PyAny>) -> String {
    let kind = type_name(value);
    if value.is_none() {
        return "None".to_owned();
    }
    let short = value.is_instance_of::<PyBool>()
        || value.is_instance_of::<PyInt>()
        || value.is_instance_of::<PyFloat>()
        || value.is_instance_of::<PyString>()
        || value.is_instance_of::<PyBytes>();
    let text = value
        .repr()
        .ok()
        .filter(|_| short)
        .map(|text| text.to_string_lossy().into_owned());
    match text {
        None => format!("a value of type {kind}"),
        Some(text) if text.chars().count() > MOST_SHOWN => {
            let begin: String = text.chars().take(MOST_SHOWN).collect();
            format!("{begin}… ({kind})")
        }
        Some(text) => format!("{text} ({kind})"),
    }
}

/// A value of a wrong type.
pub fn wrong_type(name: &str, value: &Bound<'_, PyAny>, needed: &str) -> PyErr {
    errors::wrong_type(value.py(), name, &format!("{needed} is needed; found {}", shown(value)))
}

/// A value out of the range that is needed.
pub fn wrong_value(name: &str, value: &Bound<'_, PyAny>, needed: &str) -> PyErr {
    errors::input(value.py(), name, &format!("{needed} is needed; found {}", shown(value)))
}

/// What a conversion says, in our words; what is neither about type nor value is the object's own error.
pub fn refused(name: &str, value: &Bound<'_, PyAny>, needed: &str, error: PyErr) -> PyErr {
    let py = value.py();
    if error.is_instance_of::<PyTypeError>(py) {
        wrong_type(name, value, needed)
    } else if error.is_instance_of::<PyValueError>(py) || error.is_instance_of::<PyOverflowError>(py) {
        wrong_value(name, value, needed)
    } else {
        error
    }
}

/// Refuses a masked array of NumPy's with a masked value: what is masked is no number.
///
/// # Errors
/// `InputError`, naming the argument.
pub fn unmasked(name: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    let py = value.py();
    let class = MASKED_ARRAY.import(py, "numpy.ma", "MaskedArray")?;
    if !value.is_instance(class)? {
        return Ok(());
    }
    let masked = py
        .import(intern!(py, "numpy.ma"))?
        .call_method1(intern!(py, "count_masked"), (value,))?
        .extract::<usize>()?;
    match masked {
        0 => Ok(()),
        _ => {
            let problem = format!("{masked} masked values; fill them in, or leave their rows out");
            Err(errors::input(py, name, &problem))
        }
    }
}

/// A path: a string or a path object. An empty one would be the working folder.
///
/// # Errors
/// `InputTypeError`; `InputError` for an empty one.
pub fn path(name: &str, value: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    const NEEDED: &str = "a path";
    let path: PathBuf = value.extract().map_err(|e| refused(name, value, NEEDED, e))?;
    match path.as_os_str().is_empty() {
        true => Err(wrong_value(name, value, NEEDED)),
        false => Ok(path),
    }
}

/// A path or several, none for `None`.
///
/// # Errors
/// `InputTypeError`, naming the item at fault.
pub fn paths(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<PathBuf>> {
    let Some(value) = value else {
        return Ok(Vec::new());
    };
    if value.is_instance_of::<PyString>() || value.hasattr(intern!(value.py(), "__fspath__"))? {
        return Ok(vec![path(name, value)?]);
    }
    each(name, value, "a path or a list of paths", path)
}

/// The items of a sequence, each read by `read` under its own name.
///
/// # Errors
/// `InputTypeError` for what is no sequence, `InputError` for one that does not seem to end, what `read` raises.
pub fn each<'py, T>(
    name: &str,
    value: &Bound<'py, PyAny>,
    needed: &str,
    read: impl Fn(&str, &Bound<'py, PyAny>) -> PyResult<T>,
) -> PyResult<Vec<T>> {
    unmasked(name, value)?;
    let items = value.try_iter().map_err(|e| refused(name, value, needed, e))?;
    let mut all = Vec::new();
    for (k, item) in items.enumerate() {
        if k >= MOST_ITEMS {
            let problem = format!("more than {MOST_ITEMS} items");
            return Err(errors::input(value.py(), name, &problem));
        }
        all.push(read(&format!("{name}[{k}]"), &item?)?);
    }
    Ok(all)
}

/// An object of one of our classes; `needed` names it.
///
/// # Errors
/// `InputTypeError`.
pub fn object<'a, 'py, T: PyClass>(
    name: &str,
    value: &'a Bound<'py, PyAny>,
    needed: &str,
) -> PyResult<&'a Bound<'py, T>> {
    value.cast::<T>().map_err(|_| wrong_type(name, value, needed))
}

/// The same of an argument that may be left out.
///
/// # Errors
/// As [`object`].
pub fn maybe<'a, 'py, T: PyClass>(
    name: &str,
    value: Option<&'a Bound<'py, PyAny>>,
    needed: &str,
) -> PyResult<Option<&'a Bound<'py, T>>> {
    value.map(|value| object(name, value, needed)).transpose()
}

/// A field of one of Python's dataclasses, called `class.field` in messages.
///
/// # Errors
/// `InputTypeError` for an object without it, which is none of that class; what `read` raises.
pub fn field<'py, T>(
    (name, needed): (&str, &str),
    value: &Bound<'py, PyAny>,
    (class, field): (&str, &str),
    read: impl FnOnce(&str, &Bound<'py, PyAny>) -> PyResult<T>,
) -> PyResult<T> {
    let found = value.getattr_opt(field)?;
    let found = found.ok_or_else(|| wrong_type(name, value, needed))?;
    read(&format!("{class}.{field}"), &found)
}
