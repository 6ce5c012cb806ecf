//! Places in texts, and the errors of reading one.

use std::fmt;

/// A line of a file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// The file's name.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
}

impl Place {
    /// A line of a file, counted from 1.
    #[must_use]
    pub fn new(file: &str, line: usize) -> Self {
        let file = file.to_owned();
        Self { file, line }
    }

    /// The error of that line.
    #[must_use]
    pub fn refused(&self, reason: impl Into<String>) -> ReadError {
        let (place, reason) = (self.clone(), reason.into());
        ReadError { place, reason }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}

/// Reason that a text could not be interpreted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {reason}")]
pub struct ReadError {
    /// The line.
    pub place: Place,
    /// Error in the line, and the text that was expected.
    pub reason: String,
}

impl ReadError {
    /// Makes the error of a line, counted from 1.
    #[must_use]
    pub fn at(file: &str, line: usize, reason: impl Into<String>) -> Self {
        Place::new(file, line).refused(reason)
    }
}
