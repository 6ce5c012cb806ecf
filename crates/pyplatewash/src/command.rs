//! The command `platewash`: the same code as the Rust program.

use crate::work::alone;
use pyo3::prelude::*;
use std::ffi::OsString;

/// Runs the command `platewash` with these arguments (its own name left out) in this process: results on standard output,
/// messages on standard error. The answer is the exit code: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible,
/// 4 verification failed.
#[pyfunction]
pub fn run_command(py: Python<'_>, arguments: Vec<OsString>) -> PyResult<u8> {
    let line = std::iter::once(OsString::from("platewash")).chain(arguments);
    let line: Vec<OsString> = line.collect();
    alone(py, move || platewash::cli::main(line))
}
