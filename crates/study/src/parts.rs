//! A study as data: all that its rows need, to be sent or kept.

use crate::base::Base;
use crate::error::StudyError;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A study for whoever has none of its files: as data, to be sent.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyParts {
    /// The file, as it was given.
    pub file: String,
    /// Its text.
    pub text: String,
    /// The scenarios.
    pub bases: Vec<Base>,
    /// The files that they name.
    pub files: Vec<PartsFile>,
}

impl StudyParts {
    /// As JSON.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Texts alone: there is nothing that JSON cannot say.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Out of JSON.
    ///
    /// # Errors
    /// [`StudyError::Sent`].
    pub fn from_json(text: &str) -> Result<Self, StudyError> {
        serde_json::from_str(text).map_err(|error| StudyError::Sent {
            problem: format!("parts of a study: {error}"),
        })
    }
}

/// A file of a study, as data.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartsFile {
    /// By what name it was read.
    pub path: PathBuf,
    /// What it holds.
    pub base64: String,
}
