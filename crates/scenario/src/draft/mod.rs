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
mod row;
mod statement;
mod target;

pub use error::EditError;

use self::target::Target;
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

    /// Gives a key of the table, or one of a section of a list that is there, as `plate[1].at_m`, a value, or takes it out of the text.
    ///
    /// Everything else in the text stays byte for byte, and all of it does where the value is there already. A key that is not stated yet
    /// goes to the end of its section, a section to where the table has it. A key that is taken out takes the comment behind it with it.
    ///
    /// # Errors
    /// [`EditError`]; the text stays as it was.
    pub fn set(&mut self, key: &str, value: Option<&Value>) -> Result<(), EditError> {
        let target = target(key)?;
        let value = value.map(|value| taken(&target, value)).transpose()?;
        let splices = match &value {
            Some(value) => change::set(&self.text, &target, value)?,
            None => change::remove(&self.text, &target)?,
        };
        if splices.is_empty() {
            return Ok(());
        }
        let text = lines::spliced(&self.text, splices);
        let key = || target.path();
        if text.len() as u64 > MAX_BYTES {
            return Err(EditError::TooLong {
                key: key(),
                limit: MAX_BYTES,
            });
        }
        if !self.becomes(&text, &target, value.as_ref()) {
            return Err(EditError::Unplaced { key: key() });
        }
        self.text = text;
        Ok(())
    }

    /// Whether a key takes a value, in whatever text; that a text has a place for it is not said.
    ///
    /// # Errors
    /// [`EditError::Refused`], as [`Draft::set`] has it.
    pub fn check(key: &str, value: &Value) -> Result<(), EditError> {
        taken(&target(key)?, value).map(|_| ())
    }

    /// Whether the values of a key are paths of files or folders.
    #[must_use]
    pub fn names_files(key: &str) -> bool {
        Target::of(key).is_some_and(|target| matches!(target.key.domain, Domain::Path | Domain::Paths))
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
    fn becomes(&self, text: &str, target: &Target, value: Option<&Value>) -> bool {
        let (Some([mut before, mut rows_before]), Some([mut after, mut rows_after])) = (all(&self.text), all(text))
        else {
            return false;
        };
        let taken = match target.row {
            None => {
                before.remove(target.key.path);
                after.remove(target.key.path)
            }
            Some((list, index)) => {
                let own = |rows: &mut BTreeMap<String, Value>| {
                    let section = rows.get_mut(list)?.get_mut(index)?;
                    section.as_object_mut()?.remove(target.name())
                };
                own(&mut rows_before);
                own(&mut rows_after)
            }
        };
        let fits = match (taken, value) {
            (Some(found), Some(value)) => merge::same(&found, value),
            (found, value) => found.is_none() && value.is_none(),
        };
        fits && before == after && rows_before == rows_after
    }
}

/// The key that a path names.
fn target(key: &str) -> Result<Target, EditError> {
    Target::of(key).ok_or_else(|| EditError::Refused(unknown(key)))
}

/// A value as the key takes it.
fn taken(target: &Target, value: &Value) -> Result<Value, EditError> {
    let value = whole(target.key.domain, value);
    let checked = check(target.key, &value, || describe_json(&value));
    checked.map_err(|problem| EditError::Refused(target.of_problem(problem)))?;
    Ok(value)
}

/// What a text states: the keys of the table, and the sections of lists; `None` where it is no TOML.
fn all(text: &str) -> Option<[BTreeMap<String, Value>; 2]> {
    Some([stated(text)?, listed(text)?])
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

/// The sections of lists that a text states, list by list; `None` where it is no TOML.
fn listed(text: &str) -> Option<BTreeMap<String, Value>> {
    let table = DeTable::parse(text).ok()?;
    let of = |list: &List| {
        let value = table.get_ref().get(list.name)?;
        Some((list.name.to_owned(), with_sections(value.get_ref())))
    };
    Some(LISTS.iter().filter_map(of).collect())
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
