//! A scenario's text that is being changed: key by key, all else in it kept.
//!
//! `toml_edit` keeps comments, order and layout.
//!
//! | concept | module |
//! | --- | --- |
//! | the key that is changed | `target` |
//! | the change of the text; a value or its elements in the place of others | `change`; `value`, `elements` |
//! | reasons that a text is not changed, inside and in the words of the keys | `stop`, `edit_error` |

mod change;
mod edit_error;
mod elements;
mod stop;
mod target;
mod value;

pub use crate::draft::edit_error::EditError;

use crate::draft::target::{Target, row};
use crate::error::{Problem, ScenarioError};
use crate::keys::key::{Domain, Key};
use crate::keys::table::KEYS;
use crate::keys::value::{describe, json_of};
use crate::scenario::Scenario;
use crate::source::MAX_BYTES;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use toml::de::{DeTable, DeValue};

/// Name that errors use for a text without one.
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

    /// Gives a key of the table, or one of a section of a list that is there, as `plate[1].at_m`, a value, or takes it out of the text. A
    /// whole section of a list, as `obstacle[0]`, can only be taken out.
    ///
    /// Everything else in the text stays, and the text is the same where the value is there already. A key that is not stated yet goes to
    /// the end of its section, a section to where the table has it. A key that is taken out takes the comment behind it with it.
    ///
    /// # Errors
    /// [`EditError`]; the text stays as it was.
    pub fn set(&mut self, key: &str, value: Option<&Value>) -> Result<(), EditError> {
        let (text, key) = match (value, row(key)) {
            (None, Some((list, index))) => (change::without_row(&self.text, (list.name, index))?, key.to_owned()),
            _ => {
                let (target, value) = Target::with_value(key, value)?;
                let Some(text) = change::changed(&self.text, &target, value.as_ref())? else {
                    return Ok(());
                };
                (text, target.path())
            }
        };
        if text.len() as u64 > MAX_BYTES {
            return Err(EditError::TooLong { key, limit: MAX_BYTES });
        }
        self.text = text;
        Ok(())
    }

    /// Checks that a key takes a value, in any text. It does not check that a text has a place for the key.
    ///
    /// # Errors
    /// [`EditError::Refused`], as [`Draft::set`] has it.
    pub fn check(key: &str, value: &Value) -> Result<(), EditError> {
        Target::with_value(key, Some(value)).map(|_| ())
    }

    /// Returns true where the values of a key are paths of files or folders.
    #[must_use]
    pub fn names_files(key: &str) -> bool {
        Target::parse(key).is_some_and(|target| matches!(target.key.domain, Domain::Path | Domain::Paths))
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
}

/// The keys of the table that a text states; `None` where it is no TOML.
fn stated(text: &str) -> Option<BTreeMap<String, Value>> {
    let table = DeTable::parse(text).ok()?;
    let found = |key: &Key| {
        let mut names = key.path.split('.');
        let first = table.get_ref().get(names.next()?)?.get_ref();
        let value = names.try_fold(first, |value, name| Some(value.as_table()?.get(name)?.get_ref()))?;
        let stated = match value {
            DeValue::Table(_) if !matches!(key.domain, Domain::Positions(..)) => Value::String(describe(value)),
            value => json_or_words(value),
        };
        Some((key.path.to_owned(), stated))
    };
    Some(KEYS.iter().filter_map(found).collect())
}

fn json_or_words(value: &DeValue<'_>) -> Value {
    match (json_of(value), value) {
        (Value::Array(_), DeValue::Array(array)) => array.iter().map(|v| json_or_words(v.get_ref())).collect(),
        (Value::Null, _) => Value::String(describe(value)),
        (known, _) => known,
    }
}
