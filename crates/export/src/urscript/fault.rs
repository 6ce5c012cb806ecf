//! What is wrong with a line.

use crate::dialect::ReadError;

/// What is wrong with a line, and what was expected.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Fault(String);

impl Fault {
    pub(super) fn new(reason: impl Into<String>) -> Self {
        Self(reason.into())
    }

    /// The same, at a line of a file.
    pub(super) fn at(self, file: &str, line: usize) -> ReadError {
        ReadError::at(file, line, self.0)
    }
}
