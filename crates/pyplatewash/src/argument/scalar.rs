//! Numbers, integers, truth values and texts.

use super::{refused, unmasked, wrong_type, wrong_value};
use numpy::{PyUntypedArray, PyUntypedArrayMethods};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyComplex, PyFloat};

/// Largest seed: beyond 2⁵³ − 1, neighbouring integers are one number in a plan file.
pub const LARGEST_SEED: u64 = platewash::workcell::job::MAX_SEED;
/// Largest count that is passed on, to be judged by whoever counts.
pub const ANY_COUNT: [u64; 2] = [0, i64::MAX as u64];

/// A number; NaN and infinities are judged by whoever uses it.
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

/// Whether a value of NumPy's is an integer or a real number; true of anything else.
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
