//! Checks of Python's plain values when they are made.

use crate::plate::{PlateFields, check_foot};
use crate::tool::ToolFields;
use crate::{curves, exception, page, robot};
use pyo3::prelude::*;

/// Checks one of Python's plain values when it is made, field by field; `kind` is its class in lower case.
///
/// Raises InputTypeError for a field of a wrong type, InputError for one out of its range.
#[pyfunction]
pub fn _check(py: Python<'_>, kind: &str, value: &Bound<'_, PyAny>) -> PyResult<()> {
    match kind {
        "tool" => ToolFields::read(value)?.tool(py).map(|_| ()),
        "plate" => PlateFields::read("plate", value)?.plate(py).map(|_| ()),
        "foot" => check_foot(py, value),
        "ik_settings" => robot::settings(value).map(|_| ()),
        "paper_spiral" => curves::spiral_of(value).map(|_| ()),
        "figure" => page::check_figure(value),
        "page" => page::check(value),
        "rings" => curves::rings_of("rings", value).map(|_| ()),
        "wash_curve" => curves::curve_of(value).map(|_| ()),
        _ => Err(exception::internal(py, "no such kind of value")),
    }
}
