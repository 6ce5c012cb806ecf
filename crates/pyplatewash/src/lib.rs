//! The Python wheel of platewash.
use pyo3::prelude::*;

/// Core.
#[pymodule(gil_used = false)]
mod _core {}
