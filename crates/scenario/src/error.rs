//! Why a scenario was refused.

use crate::line::line_at;
use platewash_workcell::words::printable;

/// What is wrong with a scenario.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // the fields are named after what the message prints
pub enum Problem {
    /// The file cannot be read.
    #[error("cannot be read: {detail}")]
    Unreadable { detail: String },
    /// Neither a file nor a shipped name.
    #[error("is neither a file nor a shipped scenario; shipped: {shipped}")]
    NotFound { shipped: String },
    /// Larger than any sensible scenario.
    #[error("is longer than {limit} bytes, the most that are read")]
    TooLarge { limit: u64 },
    /// Not TOML.
    #[error("is not valid TOML: {}", printable(.detail))]
    Syntax { detail: String },
    /// A key that does not exist.
    #[error("unknown key '{key}'{}", hint(.nearest.as_deref()))]
    UnknownKey { key: String, nearest: Option<String> },
    /// A value out of its range or of the wrong type.
    #[error("{key} must be {expected}; found {found}")]
    Value {
        key: String,
        expected: String,
        found: String,
    },
    /// Keys that contradict each other.
    #[error("{keys}: {detail}")]
    Conflict { keys: String, detail: String },
}

/// A scenario that was refused: where and why.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("scenario {}{}: {problem}", printable(.source_name), line_text(*.line))]
pub struct ScenarioError {
    /// The file or shipped name.
    pub source_name: String,
    /// Line in the file, from 1, where one is at fault.
    pub line: Option<usize>,
    /// What is wrong.
    pub problem: Problem,
}

impl ScenarioError {
    pub(crate) fn new(source_name: &str, line: Option<usize>, problem: Problem) -> Self {
        Self {
            source_name: source_name.to_owned(),
            line,
            problem,
        }
    }

    /// What is said of a text that is no TOML.
    pub(crate) fn syntax(source_name: &str, text: &str, error: &toml::de::Error) -> Self {
        let line = error.span().map(|span| line_at(text, span.start));
        let detail = error.message().to_owned();
        Self::new(source_name, line, Problem::Syntax { detail })
    }

    /// The key that it is about: a path of the table of keys or a section, where a file is at fault, or whatever a file states in
    /// place of one; of keys that contradict each other, the first.
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        self.problem.key()
    }

    /// Line in the file, from 1, where one is at fault.
    #[must_use]
    pub fn line(&self) -> Option<usize> {
        self.line
    }
}

impl Problem {
    /// As [`ScenarioError::key`].
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::UnknownKey { key, .. } | Self::Value { key, .. } => Some(key),
            Self::Conflict { keys, .. } => keys.split([',', ' ']).next(),
            Self::Unreadable { .. } | Self::NotFound { .. } | Self::TooLarge { .. } | Self::Syntax { .. } => None,
        }
    }
}

/// Refuses keys that contradict each other.
pub(crate) fn conflict(keys: impl Into<String>, detail: impl Into<String>) -> Result<(), Problem> {
    let (keys, detail) = (keys.into(), detail.into());
    Err(Problem::Conflict { keys, detail })
}

fn line_text(line: Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!(", line {line}"))
}

fn hint(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |key| format!("; did you mean '{key}'?"))
}
