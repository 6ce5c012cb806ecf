//! The command `platewash`: the same code as the Rust program.

use crate::argument;
use crate::work::alone;
use pyo3::prelude::*;
use pyo3::types::PyString;
use std::ffi::OsString;
use std::path::PathBuf;

/// Runs the command `platewash` with these arguments (its own name left out) in this process: results on standard output,
/// messages on standard error. The answer is the exit code: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible,
/// 4 verification failed.
#[pyfunction]
pub fn run_command(py: Python<'_>, arguments: &Bound<'_, PyAny>) -> PyResult<u8> {
    command(py, arguments, platewash::cli::main)
}

/// The same as a program of its own, which answers Ctrl-C: exit code 130.
#[pyfunction]
pub fn _program(py: Python<'_>, arguments: &Bound<'_, PyAny>) -> PyResult<u8> {
    command(py, arguments, platewash::cli::program)
}

fn command(py: Python<'_>, arguments: &Bound<'_, PyAny>, run: fn(Vec<OsString>) -> u8) -> PyResult<u8> {
    const NEEDED: &str = "a list of strings";
    if arguments.is_instance_of::<PyString>() {
        return Err(argument::wrong_type("arguments", arguments, NEEDED));
    }
    let arguments = argument::each("arguments", arguments, NEEDED, argument::path)?;
    let arguments = arguments.into_iter().map(PathBuf::into_os_string);
    let line = std::iter::once(OsString::from("platewash")).chain(arguments);
    let line: Vec<OsString> = line.collect();
    alone(py, move || run(line))
}
