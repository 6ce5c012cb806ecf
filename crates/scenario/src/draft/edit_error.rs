//! Reason that a change of a scenario was refused.

use crate::error::Problem;
use platewash_workcell::words::printable;

/// Reason that a change of a scenario's text was refused; the text stays as it was.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// A key or a value that a file would be refused for, in the same words.
    #[error("{0}")]
    Refused(Problem),
    /// The text leaves no room for the key.
    #[error("{key} cannot be changed: line {line} of the scenario has '{}' where it would go; change that line by hand", printable(.found))]
    Blocked {
        /// The key.
        key: String,
        /// Line of the text, from 1.
        line: usize,
        /// Beginning of that line.
        found: String,
    },
    /// A list has no such section.
    #[error("{key} cannot be changed: there is no such [[{list}]] section; sections are counted from 0")]
    NoRow {
        /// The key.
        key: String,
        /// The list.
        list: &'static str,
    },
    /// The text would become longer than is read.
    #[error("{key} cannot be changed: the scenario would be longer than {limit} bytes, the most that are read")]
    TooLong {
        /// The key.
        key: String,
        /// The most that are read \[bytes\].
        limit: u64,
    },
    /// The changed text would not state the new value.
    #[error("{key} cannot be changed without changing something else; change it by hand")]
    Unplaced {
        /// The key.
        key: String,
    },
}

impl EditError {
    /// The key that was to be changed.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::Refused(problem) => problem.key(),
            Self::Blocked { key, .. }
            | Self::NoRow { key, .. }
            | Self::TooLong { key, .. }
            | Self::Unplaced { key } => Some(key),
        }
    }
}
