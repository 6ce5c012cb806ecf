//! Why a study was refused, or could not go on.

use platewash_workcell::cancel::Cancelled;
use platewash_workcell::words::printable;
use std::path::{Path, PathBuf};

/// Reason that a study was refused, or could not go on.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The study file is none.
    #[error("study {}{}: {problem}", printable(.file), line.map_or_else(String::new, |line| format!(", line {line}")))]
    File {
        /// The file.
        file: String,
        /// Its line at fault, from 1.
        line: Option<usize>,
        /// Error, with the key.
        problem: String,
    },
    /// The folder keeps another study.
    #[error(
        "{}: keeps another study: {what} is {kept} there and {given} here; give another folder",
        .folder.display()
    )]
    Other {
        /// The folder.
        folder: PathBuf,
        /// Setting that differs.
        what: &'static str,
        /// Value in the folder.
        kept: String,
        /// Value given.
        given: String,
    },
    /// The folder keeps something that is no study of this program.
    #[error("{}: {}{problem}", .file.display(), line.map_or_else(String::new, |line| format!("line {line}: ")))]
    Kept {
        /// The file.
        file: PathBuf,
        /// Its line at fault, from 1.
        line: Option<usize>,
        /// Error in it.
        problem: String,
    },
    /// Somebody else works on the study.
    #[error("{}: another process works on this study", .folder.display())]
    Busy {
        /// The folder.
        folder: PathBuf,
    },
    /// A file could not be read or written.
    #[error("{}: {doing}: {cause}", .file.display())]
    Disk {
        /// The file.
        file: PathBuf,
        /// Action that was tried.
        doing: &'static str,
        /// Error of the system.
        cause: std::io::Error,
    },
    /// The text that was sent is neither a row of this study nor a study.
    #[error("what was sent is not of this study: {problem}")]
    Sent {
        /// Error in it.
        problem: String,
    },
    /// There is no such row.
    #[error("there is no row {index}; the study has {rows}, counted from 0")]
    NoRow {
        /// The row that was asked for.
        index: u64,
        /// Number of rows.
        rows: u64,
    },
    /// A row states no scenario.
    #[error("row {index}: {problem}")]
    Row {
        /// The row.
        index: u64,
        /// Error in it.
        problem: String,
    },
    /// The study was cancelled on request; the rows that were done are kept.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl StudyError {
    /// A file that could not be read or written.
    pub(crate) fn disk(file: &Path, doing: &'static str) -> impl FnOnce(std::io::Error) -> Self {
        let file = file.to_owned();
        move |cause| Self::Disk { file, doing, cause }
    }

    /// A file of a study's folder that is not as this program writes it.
    pub(crate) fn damaged_file(file: &Path, line: Option<usize>, problem: String) -> Self {
        Self::Kept {
            file: file.to_owned(),
            line,
            problem,
        }
    }

    /// Data that was sent and is of no study.
    pub(crate) fn sent(error: &impl std::fmt::Display) -> Self {
        Self::Sent {
            problem: error.to_string(),
        }
    }
}
