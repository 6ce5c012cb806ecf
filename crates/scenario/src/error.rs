//! Why a scenario was refused.

use crate::keys::line::line_at;
use platewash_workcell::words::printable;
use std::fmt::Display;
use std::path::Path;

/// Fault of a scenario.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)] // the fields are named after what the message prints
pub enum Problem {
    /// The file cannot be read.
    #[error("cannot be read: {detail}")]
    Unreadable { detail: String },
    /// Neither a file nor a shipped name.
    #[error("is neither a file nor a shipped scenario{}; shipped: {shipped}", guess(.nearest.as_deref()))]
    NotFound { nearest: Option<String>, shipped: String },
    /// Larger than any sensible scenario.
    #[error("is longer than {limit} bytes, the most that are read")]
    TooLarge { limit: u64 },
    /// Not TOML.
    #[error("is not valid TOML: {}", printable(.detail))]
    Syntax { detail: String },
    /// A key that does not exist.
    #[error("unknown key '{key}'; {hint}")]
    UnknownKey { key: String, hint: String },
    /// A value out of its range or of the wrong type.
    #[error("{key} must be {expected}; found {found}")]
    Value {
        key: String,
        expected: String,
        found: String,
    },
    /// Another fault, in words.
    #[error("{detail}")]
    Detail { detail: String },
    /// Keys that contradict each other.
    #[error("{keys}: {detail}")]
    Conflict { keys: String, detail: String },
}

/// A scenario that was refused: where and why.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}{}{}: {problem}", .kind.words(), printable(.source_name), line_text(*.line))]
pub struct ScenarioError {
    /// The kind of the text.
    pub kind: TextKind,
    /// The file or shipped name.
    pub source_name: Box<str>,
    /// Line in the file, from 1, where one is at fault.
    pub line: Option<usize>,
    /// The fault.
    pub problem: Problem,
}

/// Kind of a text that was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TextKind {
    /// A scenario.
    Scenario,
    /// A file of obstacles, or of a tool.
    Bodies,
}

impl TextKind {
    /// Words before the name of the text in a message.
    fn words(self) -> &'static str {
        match self {
            Self::Scenario => "scenario ",
            Self::Bodies => "",
        }
    }
}

impl ScenarioError {
    pub(crate) fn new(source_name: &str, line: Option<usize>, problem: Problem) -> Self {
        Self {
            kind: TextKind::Scenario,
            source_name: source_name.into(),
            line,
            problem,
        }
    }

    /// Error for a text that is no TOML.
    pub(crate) fn syntax(source_name: &str, text: &str, error: &toml::de::Error) -> Self {
        let span = error.span();
        let line = span.as_ref().map(|span| line_at(text, span.start));
        let at_fault = span.and_then(|span| text.get(span)).unwrap_or_default();
        let written = line.and_then(|line| text.lines().nth(line - 1)).unwrap_or_default();
        let detail = syntax_words(error.message(), at_fault, written.trim());
        Self::new(source_name, line, Problem::Syntax { detail })
    }

    /// The key at fault: a path of the table of keys or a section, where a file is at fault, or the name that a file states in
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
    /// The problem of keys that contradict each other.
    pub(crate) fn conflict(keys: impl Into<String>, detail: impl Into<String>) -> Self {
        let (keys, detail) = (keys.into(), detail.into());
        Self::Conflict { keys, detail }
    }

    /// The problem of a file that a key names.
    pub(crate) fn of_file(key: &str, file: &Path, detail: impl Display) -> Self {
        Self::conflict(key, format!("{}: {detail}", file.display()))
    }

    /// The key at fault, as [`ScenarioError::key`].
    #[must_use]
    pub fn key(&self) -> Option<&str> {
        match self {
            Self::UnknownKey { key, .. } | Self::Value { key, .. } => Some(key),
            Self::Conflict { keys, .. } => keys.split([',', ' ']).next(),
            Self::Unreadable { .. }
            | Self::NotFound { .. }
            | Self::TooLarge { .. }
            | Self::Syntax { .. }
            | Self::Detail { .. } => None,
        }
    }
}

/// Refuses keys that contradict each other.
pub(crate) fn conflict(keys: impl Into<String>, detail: impl Into<String>) -> Result<(), Problem> {
    Err(Problem::conflict(keys, detail))
}

fn line_text(line: Option<usize>) -> String {
    line.map_or_else(String::new, |line| format!(", line {line}"))
}

/// Longest line of a text that a message repeats, in characters.
const LONGEST: usize = 60;

/// Describes the fault of a line that is no TOML, and quotes the line.
fn syntax_words(message: &str, at_fault: &str, written: &str) -> String {
    let value = written.split_once('=').map(|(_, value)| value.trim());
    let plain = value.filter(|value| !value.contains(['[', '"']));
    let has_decimal_comma = plain
        .and_then(|value| value.split_once(','))
        .is_some_and(|(whole, rest)| {
            whole.ends_with(|c: char| c.is_ascii_digit()) && rest.starts_with(|c: char| c.is_ascii_digit())
        });
    let what = if message == "duplicate key" {
        format!("'{}' is stated twice", at_fault.trim())
    } else if value == Some("") {
        "a value is missing".to_owned()
    } else if has_decimal_comma {
        "a number has a decimal point, not a comma".to_owned()
    } else if written.starts_with('{') {
        "it begins as JSON; plan files are for verify, simulate, view and export".to_owned()
    } else {
        message.to_owned()
    };
    if written.is_empty() {
        return what;
    }
    let shown: String = written.chars().take(LONGEST).collect();
    let more = if shown.len() < written.len() { "…" } else { "" };
    format!("{what}, in: {shown}{more}")
}

fn guess(nearest: Option<&str>) -> String {
    nearest.map_or_else(String::new, |name| format!(" (did you mean '{name}'?)"))
}
