//! The command `platewash`: the same code as the Rust program.

use crate::argument;
use crate::work::{alone, patiently};
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::ffi::OsString;
use std::path::PathBuf;

/// Runs the command `platewash` with these arguments (its own name left out) in this process: results on standard output,
/// messages on standard error. The answer is the exit code: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible,
/// 4 verification failed. Ctrl-C raises, and ends long work and `view`.
#[pyfunction]
pub fn run_command(py: Python<'_>, arguments: &Bound<'_, PyAny>) -> PyResult<u8> {
    let line = line(arguments)?;
    patiently(py, move |cancel| platewash::cli::main_until(line, cancel))
}

/// The same as a program of its own, which answers Ctrl-C: exit code 130.
#[pyfunction]
pub fn _program(py: Python<'_>, arguments: &Bound<'_, PyAny>) -> PyResult<u8> {
    let line = line(arguments)?;
    alone(py, move || platewash::cli::program(line))
}

/// The command's own name and its arguments.
fn line(arguments: &Bound<'_, PyAny>) -> PyResult<Vec<OsString>> {
    const NEEDED: &str = "a list of strings";
    if arguments.is_instance_of::<PyString>() {
        return Err(argument::wrong_type("arguments", arguments, NEEDED));
    }
    let arguments = argument::each("arguments", arguments, NEEDED, argument::path)?;
    let arguments = arguments.into_iter().map(PathBuf::into_os_string);
    Ok(std::iter::once(OsString::from("platewash")).chain(arguments).collect())
}
