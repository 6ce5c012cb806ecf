//! A scenario that rows begin from, and its text with their values.

use platewash_scenario::Draft;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::path::PathBuf;

/// A scenario that rows begin from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Base {
    /// As the study names it: a shipped name, a file relative to the study's, or the name beside a text.
    pub name: String,
    /// Its text.
    pub text: String,
    /// The folder to which paths in it are relative.
    pub folder: Option<PathBuf>,
}

/// A scenario's text with other values.
pub(crate) fn changed<'a>(
    text: &str,
    values: impl IntoIterator<Item = (&'a String, &'a Value)>,
) -> Result<String, String> {
    let mut draft = Draft::new(text).map_err(|error| error.to_string())?;
    for (key, value) in values {
        draft.set(key, Some(value)).map_err(|error| error.to_string())?;
    }
    Ok(draft.text().to_owned())
}
