//! Why a scenario was refused.
//!
//! Also here: why a body that a section states could not be made.

use crate::keys::fits::line_at;
use platewash_kinematics::urdf::MeshError;
use platewash_workcell::clearance::SolidError;
use platewash_workcell::words::printable;
use std::fmt;

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
    let (keys, detail) = (keys.into(), detail.into());
    Err(Problem::Conflict { keys, detail })
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

/// Reason that the body of a section could not be made.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyError {
    /// List that it belongs to.
    pub section: BodySection,
    /// Index of the section, from 0.
    pub index: usize,
    /// Its name.
    pub name: String,
    /// The fault.
    pub why: BodyFault,
}

/// A list of bodies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodySection {
    /// `[[obstacle]]`.
    Obstacle,
    /// `[[tool_body]]`.
    ToolBody,
}

impl BodySection {
    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Obstacle => "obstacle",
            Self::ToolBody => "tool_body",
        }
    }

    fn noun(self) -> &'static str {
        match self {
            Self::Obstacle => "obstacle",
            Self::ToolBody => "body of the tool",
        }
    }
}

/// Fault of a body.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum BodyFault {
    /// Its mesh cannot be read; the error names the file and the reason.
    Mesh(MeshError),
    /// The mesh forms no body.
    Solid {
        /// The file.
        file: String,
        /// The fault of the mesh.
        why: SolidError,
    },
    /// It reaches farther from its origin than any body of a tool.
    Large {
        /// The file.
        file: String,
        /// Reach from the origin \[m\].
        reach_m: f64,
        /// Greatest reach allowed \[m\].
        most_m: f64,
    },
    /// Another body has its name.
    NameTaken {
        /// The other owner of the name.
        of: &'static str,
    },
}

impl fmt::Display for BodyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (noun, name) = (self.section.noun(), printable(&self.name));
        let at = format!("{}[{}]", self.section.name(), self.index);
        match &self.why {
            BodyFault::Mesh(why) => write!(f, "{at}.mesh: {noun} '{name}': {}", printable(&why.to_string())),
            BodyFault::Solid { file, why } => write!(f, "{at}.mesh: {noun} '{name}': {}: {why}", printable(file)),
            BodyFault::Large { file, reach_m, most_m } => write!(
                f,
                "{at}.mesh_scale: {noun} '{name}': {} reaches {reach_m} m from its origin, a {noun} up to {most_m} m: 0.001 each is the scale \
                 of a file in millimetres",
                printable(file)
            ),
            BodyFault::NameTaken { of } => write!(
                f,
                "{at}.name: '{name}' is the name of {of}; give the {noun} another one"
            ),
        }
    }
}

impl std::error::Error for BodyError {}
