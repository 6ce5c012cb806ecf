//! What Python's side of the package does for methods of ours: figures, pages in cells, tables.

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

/// A noun's table for notebooks, in HTML.
///
/// # Errors
/// What a getter of the noun raises.
pub fn table<'py>(noun: &Bound<'py, PyAny>, kind: &str) -> PyResult<Bound<'py, PyAny>> {
    ask(noun.py(), "_tables", kind, (noun,))
}
