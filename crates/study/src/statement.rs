//! What a study file states, as TOML has it: types and names of keys are checked here, what they mean is not.

use crate::error::StudyError;
use crate::keep::Keep;
use platewash_kinematics::words::message_in_words;
use serde::Deserialize;
use std::ops::Range;
use toml::Spanned;

/// What `format` must be.
pub(crate) const FORMAT: &str = "platewash-study/1";

/// A study file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Statement {
    pub format: Spanned<String>,
    pub name: Spanned<String>,
    pub scenario: Spanned<OneOrMore>,
    #[serde(default)]
    pub plans: Keep,
    pub axis: Option<Spanned<Vec<Spanned<AxisStatement>>>>,
    pub rows: Option<Spanned<Vec<Spanned<toml::Table>>>>,
}

/// A scenario or several.
#[derive(Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "scenario must be a name, a file or a table { name, text } with a scenario's text, or a list of them"
)]
pub(crate) enum OneOrMore {
    // Lists first: one of two texts would do as a table's name and text.
    More(Vec<ScenarioStatement>),
    One(ScenarioStatement),
}

/// A scenario by its name or file, or by its text.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum ScenarioStatement {
    Named(String),
    Text(TextStatement),
}

/// A scenario's text, and what the study calls it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TextStatement {
    pub name: String,
    pub text: String,
}

impl OneOrMore {
    /// All of them.
    pub fn all(&self) -> &[ScenarioStatement] {
        match self {
            Self::One(one) => std::slice::from_ref(one),
            Self::More(all) => all,
        }
    }
}

impl ScenarioStatement {
    /// What the study calls it.
    pub fn name(&self) -> &str {
        match self {
            Self::Named(name) => name,
            Self::Text(stated) => &stated.name,
        }
    }
}

/// `[[axis]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AxisStatement {
    pub key: Spanned<String>,
    pub values: Option<Spanned<Vec<toml::Value>>>,
    pub range: Option<Spanned<Vec<toml::Value>>>,
    pub seeds: Option<Spanned<String>>,
}

/// A study file's text, and where errors are in it.
pub(crate) struct Source<'a> {
    pub file: &'a str,
    pub text: &'a str,
}

impl Source<'_> {
    /// What the text states.
    pub fn statement(&self) -> Result<Statement, StudyError> {
        toml::from_str(self.text).map_err(|error| {
            let key = error.span().and_then(|span| self.key_at(span.start));
            let key = key.filter(|key| !error.message().contains(key)).unwrap_or_default();
            self.wrong(error.span(), &message_in_words(key, error.message()))
        })
    }

    /// The key whose value begins at a place of the text, where both stand on one line.
    fn key_at(&self, place: usize) -> Option<&str> {
        let line = self.text.get(..place)?.lines().next_back()?;
        line.split_once('=').map(|(key, _)| key.trim())
    }

    /// An error at a stretch of the text; its words become one line.
    pub fn wrong(&self, span: Option<Range<usize>>, problem: &str) -> StudyError {
        let line = span.map(|span| 1 + self.text.bytes().take(span.start).filter(|b| *b == b'\n').count());
        StudyError::File {
            file: self.file.to_owned(),
            line,
            problem: problem.split_whitespace().collect::<Vec<_>>().join(" "),
        }
    }
}
