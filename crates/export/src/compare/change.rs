//! What changed.

use serde::Serialize;

/// Something that a program says otherwise than the one that was handed over.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Change {
    /// File and line, as `FILE:LINE`; of a line that is missing the one before it.
    pub place: String,
    /// What it is about, e.g. `joint 3`.
    pub what: String,
    /// What the line says.
    pub found: String,
    /// What was handed over.
    pub expected: String,
}
