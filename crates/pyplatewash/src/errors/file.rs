//! Files that the system does not give or take; studies that are none, and folders that keep something else.

use crate::exception::{any, internal, named, raise};
use platewash::kinematics::urdf::file::FileError;
use platewash::study::StudyError;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::io::ErrorKind;
use std::path::Path;

/// Kind of a file; decides which exceptions its errors raise.
#[derive(Debug, Clone, Copy)]
pub enum FileKind {
    /// A description of an arm.
    Urdf,
    /// A plan.
    Plan,
    /// A scenario.
    Scenario,
    /// A page.
    Page,
    /// A study: its file, or what its folder keeps.
    Study,
}

/// Error of the operating system on a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SystemWord {
    /// The file or its folder does not exist.
    NotFound,
    /// Any other error, with its number where it has one.
    Refused(Option<i32>),
}

/// Number of "no such file or folder".
const ENOENT: i32 = 2;

impl From<&std::io::Error> for SystemWord {
    fn from(error: &std::io::Error) -> Self {
        match error.kind() {
            ErrorKind::NotFound => Self::NotFound,
            _ => Self::Refused(error.raw_os_error()),
        }
    }
}

/// A file that the system does not give or take: an `OSError` too, with the name as `filename`.
pub fn system_file(py: Python<'_>, kind: FileKind, word: SystemWord, filename: &str, message: &str) -> PyErr {
    let (class, number) = match (kind, word) {
        (FileKind::Urdf, SystemWord::NotFound) => ("UrdfNotFoundError", Some(ENOENT)),
        (FileKind::Plan, SystemWord::NotFound) => ("PlanNotFoundError", Some(ENOENT)),
        (FileKind::Scenario, SystemWord::NotFound) => ("ScenarioNotFoundError", Some(ENOENT)),
        (FileKind::Page, SystemWord::NotFound) => ("PageNotFoundError", Some(ENOENT)),
        (FileKind::Study, SystemWord::NotFound) => ("StudyNotFoundError", Some(ENOENT)),
        (FileKind::Urdf, SystemWord::Refused(number)) => ("UrdfAccessError", number),
        (FileKind::Plan, SystemWord::Refused(number)) => ("PlanAccessError", number),
        (FileKind::Scenario, SystemWord::Refused(number)) => ("ScenarioAccessError", number),
        (FileKind::Page, SystemWord::Refused(number)) => ("FileError", number),
        (FileKind::Study, SystemWord::Refused(number)) => ("StudyAccessError", number),
    };
    let fields = [
        ("filename", any(py, filename)),
        ("errno", number.and_then(|number| any(py, number))),
        ("strerror", any(py, message)),
    ];
    raise(py, class, message, &fields)
}

/// An input file that was not read: missing, refused by the system, or no text that is read.
pub fn unread(py: Python<'_>, kind: FileKind, path: &Path, error: &FileError) -> PyErr {
    let filename = path.display().to_string();
    let message = format!("{filename}: cannot be read: {error}");
    match error {
        FileError::System { kind: cause, code, .. } => {
            let word = match cause {
                ErrorKind::NotFound => SystemWord::NotFound,
                _ => SystemWord::Refused(*code),
            };
            system_file(py, kind, word, &filename, &message)
        }
        FileError::NotRegular => system_file(py, kind, SystemWord::Refused(None), &filename, &message),
        _ => match kind {
            FileKind::Urdf => named(py, "UrdfError", &message),
            FileKind::Plan => named(py, "PlanFileError", &message),
            FileKind::Scenario => named(py, "ScenarioError", &message),
            FileKind::Page => named(py, "FileError", &message),
            FileKind::Study => named(py, "StudyError", &message),
        },
    }
}

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
            system_file(py, FileKind::Study, word, &file.display().to_string(), &message)
        }
        StudyError::File { file, line, .. } => of(file.clone(), *line),
        StudyError::Kept { file, line, .. } => of(file.display().to_string(), *line),
        StudyError::Other { folder, .. } | StudyError::Busy { folder } => of(folder.display().to_string(), None),
        StudyError::NoRow { .. } | StudyError::Row { .. } => of("study".to_owned(), None),
        StudyError::Cancelled(_) => PyKeyboardInterrupt::new_err(()),
        _ => internal(py, &message),
    }
}
