//! Files that the system does not give or take.

use super::{any, named, raise};
use platewash::kinematics::urdf::file::FileError;
use pyo3::prelude::*;
use std::io::ErrorKind;
use std::path::Path;

/// What a file is of; names the exceptions.
#[derive(Debug, Clone, Copy)]
pub enum FileOf {
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

/// What the system says of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SystemWord {
    /// It is not there, or the folder that it would be in.
    NotFound,
    /// Anything else, with its number where it has one.
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
pub fn system_file(py: Python<'_>, of: FileOf, word: SystemWord, filename: &str, message: &str) -> PyErr {
    let (class, number) = match (of, word) {
        (FileOf::Urdf, SystemWord::NotFound) => ("UrdfNotFoundError", Some(ENOENT)),
        (FileOf::Plan, SystemWord::NotFound) => ("PlanNotFoundError", Some(ENOENT)),
        (FileOf::Scenario, SystemWord::NotFound) => ("ScenarioNotFoundError", Some(ENOENT)),
        (FileOf::Page, SystemWord::NotFound) => ("PageNotFoundError", Some(ENOENT)),
        (FileOf::Study, SystemWord::NotFound) => ("StudyNotFoundError", Some(ENOENT)),
        (FileOf::Urdf, SystemWord::Refused(number)) => ("UrdfAccessError", number),
        (FileOf::Plan, SystemWord::Refused(number)) => ("PlanAccessError", number),
        (FileOf::Scenario, SystemWord::Refused(number)) => ("ScenarioAccessError", number),
        (FileOf::Page, SystemWord::Refused(number)) => ("FileError", number),
        (FileOf::Study, SystemWord::Refused(number)) => ("StudyAccessError", number),
    };
    let fields = [
        ("filename", any(py, filename)),
        ("errno", number.and_then(|number| any(py, number))),
        ("strerror", any(py, message)),
    ];
    raise(py, class, message, &fields)
}

/// An input file that was not read: missing, refused by the system, or no text that is read.
pub fn unread(py: Python<'_>, of: FileOf, path: &Path, error: &FileError) -> PyErr {
    let filename = path.display().to_string();
    let message = format!("{filename}: cannot be read: {error}");
    match error {
        FileError::System { kind, code, .. } => {
            let word = match kind {
                ErrorKind::NotFound => SystemWord::NotFound,
                _ => SystemWord::Refused(*code),
            };
            system_file(py, of, word, &filename, &message)
        }
        FileError::NotRegular => system_file(py, of, SystemWord::Refused(None), &filename, &message),
        _ => match of {
            FileOf::Urdf => named(py, "UrdfError", &message),
            FileOf::Plan => named(py, "PlanFileError", &message),
            FileOf::Scenario => named(py, "ScenarioError", &message),
            FileOf::Page => named(py, "FileError", &message),
            FileOf::Study => named(py, "StudyError", &message),
        },
    }
}
