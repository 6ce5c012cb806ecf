//! Arguments: conversion of Python values to numbers, texts, paths and objects of this package, in one place.
//!
//! Every public callable takes plain Python objects and reads them here (arrays in `arrays`, tables in `value`). A value that does
//! not fit is refused in one form: the argument's name, what is needed, what was found. A wrong type is an `InputTypeError`, a wrong
//! value an `InputError`. Exceptions of foreign objects, such as an iterator of the caller, pass unchanged.
//!
//! Numbers, integers, truth values and texts.
//!
//! Arguments of the functions that are written in Python: read and refused as those of Rust's. `python/pyplatewash/_arguments.py` names
//! these.

use crate::exception;
use numpy::{PyUntypedArray, PyUntypedArrayMethods};
use pyo3::exceptions::{PyOverflowError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::{PyBool, PyBytes, PyComplex, PyFloat, PyInt, PyMapping, PyString, PyType};
use pyo3::{PyClass, intern};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Largest number of characters of a value that a message shows.
const MOST_SHOWN: usize = 60;
/// Largest number of items of a sequence that is read one by one.
const MOST_ITEMS: usize = 10_000_000;
/// Expected type of a tool, in messages.
pub const TOOL: &str = "a Tool";
/// Expected type of an arm, in messages.
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
    exception::wrong_type(value.py(), name, &format!("{needed} is needed; found {}", shown(value)))
}

/// A value out of the range that is needed.
pub fn wrong_value(name: &str, value: &Bound<'_, PyAny>, needed: &str) -> PyErr {
    exception::input(value.py(), name, &format!("{needed} is needed; found {}", shown(value)))
}

/// Exception for a value that a conversion refused, in the words of this package. Errors that concern neither type nor
/// value pass unchanged.
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

/// Refuses a masked NumPy array in which a value is masked, as a masked value is no number.
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
            Err(exception::input(py, name, &problem))
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

/// A list of names, empty if left out.
///
/// # Errors
/// `InputTypeError` for what is no list of texts, a single text too; `InputError` for lone surrogates.
pub fn names(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
    let needed = "a list of names";
    match value {
        None => Ok(Vec::new()),
        Some(value) if value.is_instance_of::<PyString>() => Err(wrong_type(name, value, needed)),
        Some(value) => each(name, value, needed, |name, item| text(name, item, "a name")),
    }
}

/// A mapping of names to numbers, empty if left out.
///
/// # Errors
/// `InputTypeError` for what is no mapping of texts to numbers. NaN and infinities pass, and the caller checks them.
pub fn positions(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<BTreeMap<String, f64>> {
    let Some(value) = value else {
        return Ok(BTreeMap::new());
    };
    let needed = "a dict of names with numbers";
    let mapping = value.cast::<PyMapping>().map_err(|_| wrong_type(name, value, needed))?;
    each(name, mapping.items()?.as_any(), needed, |_, item| {
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let key = text(name, &key, "a name")?;
        let value = number(&format!("{name}['{}']", key.escape_debug()), &value)?;
        Ok((key, value))
    })
    .map(|pairs| pairs.into_iter().collect())
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
            return Err(exception::input(value.py(), name, &problem));
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

/// An object of one of our classes, for an argument that may be left out.
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

/// Largest seed, 2⁵³ − 1: beyond it, a plan file cannot tell neighbouring integers apart.
pub const LARGEST_SEED: u64 = platewash::workcell::job::MAX_SEED;
/// Range of counts whose upper bound the called function checks.
pub const ANY_COUNT: [u64; 2] = [0, i64::MAX as u64];

/// A number; NaN and infinities pass, and the caller checks them.
///
/// # Errors
/// `InputTypeError` for what is no real number (a boolean is none), `InputError` for what no double can hold.
pub fn number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    const NEEDED: &str = "a number";
    if value.is_exact_instance_of::<PyFloat>() {
        return value.extract();
    }
    unmasked(name, value)?;
    let array = value.cast::<PyUntypedArray>().is_ok_and(|array| array.ndim() > 0);
    if array || value.is_instance_of::<PyBool>() || value.is_instance_of::<PyComplex>() || !real(value)? {
        return Err(wrong_type(name, value, NEEDED));
    }
    value.extract().map_err(|e| refused(name, value, NEEDED, e))
}

/// A number, or another one where none is given.
///
/// # Errors
/// As [`number`].
pub fn number_or(name: &str, value: Option<&Bound<'_, PyAny>>, otherwise: f64) -> PyResult<f64> {
    value.map_or(Ok(otherwise), |value| number(name, value))
}

/// A number from `least` to `most`.
///
/// # Errors
/// As [`number`]; `InputError` for one outside of the range, or NaN.
pub fn number_within(name: &str, value: &Bound<'_, PyAny>, [least, most]: [f64; 2]) -> PyResult<f64> {
    let found = number(name, value)?;
    if (least..=most).contains(&found) {
        return Ok(found);
    }
    Err(wrong_value(name, value, &format!("a number from {least} to {most}")))
}

/// True where a NumPy value is an integer or a real number; true for any value that is not NumPy's.
fn real(value: &Bound<'_, PyAny>) -> PyResult<bool> {
    let py = value.py();
    let Some(dtype) = value.getattr_opt(intern!(py, "dtype"))? else {
        return Ok(true);
    };
    let Some(kind) = dtype.getattr_opt(intern!(py, "kind"))? else {
        return Ok(true);
    };
    Ok(kind
        .extract::<String>()
        .is_ok_and(|kind| ["f", "i", "u"].contains(&kind.as_str())))
}

/// An integer from `least` to `most`.
///
/// # Errors
/// `InputTypeError` for what is no integer (a boolean is none), `InputError` for one out of range.
fn integer(name: &str, value: &Bound<'_, PyAny>, [least, most]: [u64; 2]) -> PyResult<u64> {
    let needed = match most {
        most if most == ANY_COUNT[1] => format!("an integer, {least} or more,"),
        most => format!("an integer from {least} to {most}"),
    };
    if value.is_instance_of::<PyBool>() {
        return Err(wrong_type(name, value, &needed));
    }
    let found: i64 = value.extract().map_err(|e| refused(name, value, &needed, e))?;
    let found = u64::try_from(found).ok().filter(|found| (least..=most).contains(found));
    found.ok_or_else(|| wrong_value(name, value, &needed))
}

/// A count or an index.
///
/// # Errors
/// As [`integer`].
pub fn count(name: &str, value: &Bound<'_, PyAny>, range: [u64; 2]) -> PyResult<usize> {
    let found = integer(name, value, range)?;
    usize::try_from(found).map_err(|_| wrong_value(name, value, "a smaller integer"))
}

/// A seed of random numbers.
///
/// # Errors
/// As [`integer`].
pub fn seed(name: &str, value: &Bound<'_, PyAny>) -> PyResult<u64> {
    integer(name, value, [0, LARGEST_SEED])
}

/// True or False.
///
/// # Errors
/// `InputTypeError`.
pub fn flag(name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
    const NEEDED: &str = "True or False";
    value.extract().map_err(|e| refused(name, value, NEEDED, e))
}

/// True or False; False where nothing is given.
///
/// # Errors
/// As [`flag`].
pub fn flag_or_false(name: &str, value: Option<&Bound<'_, PyAny>>) -> PyResult<bool> {
    value.map_or(Ok(false), |value| flag(name, value))
}

/// A text; `needed` says of what.
///
/// # Errors
/// `InputTypeError`; `InputError` for lone surrogates.
pub fn text(name: &str, value: &Bound<'_, PyAny>, needed: &str) -> PyResult<String> {
    value.extract().map_err(|e| refused(name, value, needed, e))
}

/// One of the given words.
///
/// # Errors
/// `InputTypeError`; `InputError` for another word.
pub fn word<T: Copy>(name: &str, value: &Bound<'_, PyAny>, words: &[(&str, T)]) -> PyResult<T> {
    let names: Vec<_> = words.iter().map(|(word, _)| format!("\"{word}\"")).collect();
    let needed = format!("one of {}", names.join(", "));
    let given = text(name, value, &needed)?;
    let found = words.iter().find(|(word, _)| *word == given);
    found
        .map(|(_, meaning)| *meaning)
        .ok_or_else(|| wrong_value(name, value, &needed))
}

/// A number; it may be NaN or infinite.
#[pyfunction]
pub fn _argument_number(name: &str, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    number(name, value)
}

/// An integer from `least` to `most`.
#[pyfunction]
pub fn _argument_count(name: &str, value: &Bound<'_, PyAny>, least: u64, most: u64) -> PyResult<usize> {
    count(name, value, [least, most])
}

/// True or False.
#[pyfunction]
pub fn _argument_flag(name: &str, value: &Bound<'_, PyAny>) -> PyResult<bool> {
    flag(name, value)
}

/// A path.
#[pyfunction]
pub fn _argument_path(name: &str, value: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    path(name, value)
}

/// One of `words`.
#[pyfunction]
pub fn _argument_word(name: &str, value: &Bound<'_, PyAny>, words: Vec<String>) -> PyResult<String> {
    let words: Vec<_> = words.iter().map(|word| (word.as_str(), word.as_str())).collect();
    word(name, value, &words).map(str::to_owned)
}

/// Texts, or one.
#[pyfunction]
pub fn _argument_texts(name: &str, value: &Bound<'_, PyAny>) -> PyResult<Vec<String>> {
    let one = |name: &str, value: &Bound<'_, PyAny>| text(name, value, "a text");
    if value.is_instance_of::<PyString>() {
        return Ok(vec![one(name, value)?]);
    }
    each(name, value, "a list of texts", one)
}

/// A value as messages show it.
#[pyfunction]
pub fn _argument_shown(value: &Bound<'_, PyAny>) -> String {
    shown(value)
}
