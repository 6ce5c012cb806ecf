//! Arguments of the functions that are written in Python: read and refused as those of Rust's. `python/pyplatewash/_arguments.py` names
//! these.

use super::{count, each, flag, number, path, shown, text};
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::path::PathBuf;

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
    super::word(name, value, &words).map(str::to_owned)
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
