//! Studies that are none, and folders that keep something else.

use super::file::{FileOf, SystemWord, system_file};
use super::{any, internal, raise};
use platewash::study::StudyError;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

/// A study that was refused, or could not go on.
pub fn study(py: Python<'_>, error: StudyError) -> PyErr {
    let message = error.to_string();
    let of = |source: String, line: Option<usize>| {
        let fields = [
            ("source", any(py, source)),
            ("line", line.and_then(|line| any(py, line))),
        ];
        raise(py, "StudyError", &message, &fields)
    };
    match &error {
        StudyError::Disk { file, cause, .. } => {
            let word = SystemWord::from(cause);
            system_file(py, FileOf::Study, word, &file.display().to_string(), &message)
        }
        StudyError::File { file, line, .. } => of(file.clone(), *line),
        StudyError::Kept { file, line, .. } => of(file.display().to_string(), *line),
        StudyError::Other { folder, .. } | StudyError::Busy { folder } => of(folder.display().to_string(), None),
        StudyError::NoRow { .. } | StudyError::Row { .. } => of("study".to_owned(), None),
        StudyError::Cancelled(_) => PyKeyboardInterrupt::new_err(()),
        _ => internal(py, &message),
    }
}
