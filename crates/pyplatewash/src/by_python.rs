//! What Python's side of the package does for methods of ours: figures, pages in cells.

use pyo3::call::PyCallArgs;
use pyo3::prelude::*;

/// What a function of one of the package's modules answers.
///
/// # Errors
/// What the function raises.
pub fn ask<'py>(
    py: Python<'py>,
    module: &str,
    function: &str,
    arguments: impl PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let module = py.import(format!("pyplatewash.{module}"))?;
    module.getattr(function)?.call1(arguments)
}
