//! A scenario's text that is being changed: key by key, all else in it kept byte for byte.
//!
//! A change is a stretch of the text that is replaced, found where the parser found the key and its value: nothing is written anew
//! that is not changed. What comes of it is read again before it counts.

mod change;
mod error;
mod lines;
mod list;
mod merge;
mod place;
mod statement;

pub use error::EditError;

use crate::error::{Problem, ScenarioError};
use crate::fits::check;
use crate::key::{Domain, Key};
use crate::keys::KEYS;
use crate::lists::{LISTS, List};
use crate::scenario::Scenario;
use crate::source::MAX_BYTES;
use crate::unknown::unknown;
use crate::value::{describe, describe_json, json_of};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// What errors call a text that has no name.
const UNNAMED: &str = "text";

/// A scenario's text that is being changed: valid TOML of at most 1 MiB, which need not be a scenario that can be carried out.
///
/// ```
/// use platewash_scenario::Draft;
///
/// let mut draft = Draft::new("[wash]\nturns = 3   # windings\n")?;
/// draft.set("wash.turns", Some(&3.5.into()))?;
/// assert_eq!(draft.text(), "[wash]\nturns = 3.5   # windings\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draft {
    text: String,
}

impl Draft {
    /// A text to change. It need not be a scenario: it may be mended.
    ///
    /// # Errors
    /// [`ScenarioError`]: longer than 1 MiB, or no TOML.
    pub fn new(text: &str) -> Result<Self, ScenarioError> {
        if text.len() as u64 > MAX_BYTES {
            let problem = Problem::TooLarge { limit: MAX_BYTES };
            return Err(ScenarioError::new(UNNAMED, None, problem));
        }
        DeTable::parse(text).map_err(|e| ScenarioError::syntax(UNNAMED, text, &e))?;
        Ok(Self { text: text.to_owned() })
    }

    /// The text as it is now.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Gives a key of the table a value, or takes it out of the text.
    ///
    /// Everything else in the text stays byte for byte, and all of it does where the value is there already. A key that is not stated yet
    /// goes to the end of its section, a section to where the table has it. A key that is taken out takes the comment behind it with it.
    ///
    /// # Errors
    /// [`EditError`]; the text stays as it was.
    pub fn set(&mut self, key: &str, value: Option<&Value>) -> Result<(), EditError> {
        let Some(row) = KEYS.iter().find(|row| row.path == key) else {
            return Err(EditError::Refused(unknown(key)));
        };
        let value = value.map(|value| whole(row.domain, value));
        if let Some(value) = &value {
            check(row, value, || describe_json(value)).map_err(EditError::Refused)?;
        }
        let splices = match &value {
            Some(value) => change::set(&self.text, row, value)?,
            None => change::remove(&self.text, row)?,
        };
        if splices.is_empty() {
            return Ok(());
        }
        let text = lines::spliced(&self.text, splices);
        let key = || row.path.to_owned();
        if text.len() as u64 > MAX_BYTES {
            return Err(EditError::TooLong {
                key: key(),
                limit: MAX_BYTES,
            });
        }
        if !self.becomes(&text, row, value.as_ref()) {
            return Err(EditError::Unplaced { key: key() });
        }
        self.text = text;
        Ok(())
    }

    /// The scenario that the text states; paths in it are relative to the folder, without one they stay as they are.
    ///
    /// # Errors
    /// As [`Scenario::parse`].
    pub fn scenario(&self, source_name: &str, folder: Option<&Path>) -> Result<Scenario, ScenarioError> {
        Scenario::parse_in(&self.text, source_name, folder)
    }

    /// The keys of the table that the text states, with their values, whether they take them or not. A value that JSON does not know,
    /// such as infinity or a date, is put into words.
    #[must_use]
    pub fn stated(&self) -> BTreeMap<String, Value> {
        stated(&self.text).unwrap_or_default()
    }

    /// Whether another text states the value of a key, and of all others what this one does.
    fn becomes(&self, text: &str, key: &Key, value: Option<&Value>) -> bool {
        let Some(mut after) = stated(text) else {
            return false;
        };
        let mut before = self.stated();
        before.remove(key.path);
        let fits = match (after.remove(key.path), value) {
            (Some(found), Some(value)) => merge::same(&found, value),
            (found, value) => found.is_none() && value.is_none(),
        };
        fits && before == after && listed(text) == listed(&self.text)
    }
}

/// The keys of the table that a text states; `None` where it is no TOML.
fn stated(text: &str) -> Option<BTreeMap<String, Value>> {
    let table = DeTable::parse(text).ok()?;
    let found = |key: &Key| {
        let mut names = key.path.split('.');
        let first = table.get_ref().get(names.next()?)?.get_ref();
        let value = names.try_fold(first, |value, name| Some(value.as_table()?.get(name)?.get_ref()))?;
        Some((key.path.to_owned(), json_or_words(value)))
    };
    Some(KEYS.iter().filter_map(found).collect())
}

/// The sections of lists that a text states, which no edit changes; `None` where it is no TOML.
fn listed(text: &str) -> Option<Vec<Option<Value>>> {
    let table = DeTable::parse(text).ok()?;
    let of = |list: &List| {
        table
            .get_ref()
            .get(list.name)
            .map(|value| with_sections(value.get_ref()))
    };
    Some(LISTS.iter().map(of).collect())
}

fn with_sections(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::Array(array) => array.iter().map(|v| with_sections(v.get_ref())).collect(),
        DeValue::Table(table) => {
            let names = table
                .iter()
                .map(|(name, v)| (name.get_ref().to_string(), with_sections(v.get_ref())));
            Value::Object(names.collect())
        }
        other => json_or_words(other),
    }
}

fn json_or_words(value: &DeValue<'_>) -> Value {
    match (json_of(value), value) {
        (Value::Array(_), DeValue::Array(array)) => array.iter().map(|v| json_or_words(v.get_ref())).collect(),
        (Value::Null, _) => Value::String(describe(value)),
        (known, _) => known,
    }
}

/// JSON has one type of numbers: where whole ones are wanted, those with a point are as good.
fn whole(domain: Domain, value: &Value) -> Value {
    /// Up to here all whole numbers are there \[2^53\].
    const EXACT: f64 = 9_007_199_254_740_992.0;
    match value.as_f64() {
        Some(v) if matches!(domain, Domain::Integer(..)) && v.fract() == 0.0 && v.abs() < EXACT => {
            Value::from(v as i64)
        }
        _ => value.clone(),
    }
}
