//! Values that were probably meant in another unit, as Python's warnings.

use platewash::scenario::Note;
use pyo3::exceptions::PyUserWarning;
use pyo3::prelude::*;
use std::ffi::CString;

/// Warns of each note, at the line that called; an error where warnings are errors.
///
/// # Errors
/// The warning itself, where the caller's filters make it an exception.
pub fn warn(py: Python<'_>, notes: &[Note]) -> PyResult<()> {
    let category = py.get_type::<PyUserWarning>();
    for note in notes {
        PyErr::warn(py, &category, &CString::new(note.to_string())?, 1)?;
    }
    Ok(())
}
