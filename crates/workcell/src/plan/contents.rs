//! Whether a plan file says what is read of it, and nothing else.
//!
//! Reading alone is not strict enough: tagged and flattened types swallow keys that they do not know, missing keys of a scenario
//! become defaults, and of a key that is stated twice the last one counts. The hash would then be that of other contents.

use super::error::PlanFileError;
use crate::job::MAX_SEED;
use crate::json::JsonError;
use crate::words::shortened;
use serde::Serialize;
use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Number, Value};
use std::fmt;

/// The largest whole number that JSON says exactly (RFC 8785: numbers are doubles), which bounds seeds for that reason.
const MOST_EXACT: u64 = MAX_SEED;

/// Longest value that a message repeats, in characters.
const LONGEST: usize = 60;

/// Refuses a text that says anything else than what was read of it, which is `written` as canonical JSON.
///
/// # Errors
/// [`PlanFileError`] with the key.
pub(super) fn check(text: &str, written: &str, plan: &impl Serialize) -> Result<(), PlanFileError> {
    // As this program writes it there is nothing else in it.
    if written == text.trim_end() {
        return Ok(());
    }
    let unreadable = |e: serde_json::Error| JsonError { reason: e.to_string() };
    let mut parser = serde_json::Deserializer::from_str(text);
    let said = Strict.deserialize(&mut parser).map_err(unreadable)?;
    let read = serde_json::to_value(plan).map_err(unreadable)?;
    compare("", &said, &read)
}

/// The first difference between what a file says and what was read of it.
fn compare(at: &str, said: &Value, read: &Value) -> Result<(), PlanFileError> {
    match (said, read) {
        (Value::Object(said), Value::Object(read)) => compare_tables(at, said, read),
        (Value::Array(said), Value::Array(read)) if said.len() == read.len() => {
            let mut both = said.iter().zip(read).enumerate();
            both.try_for_each(|(i, (said, read))| compare(&format!("{at}[{i}]"), said, read))
        }
        (Value::Number(said), Value::Number(read)) if same(said, read) => Ok(()),
        _ if said == read && !said.is_number() => Ok(()),
        _ => Err(PlanFileError::Inexact {
            key: at.to_owned(),
            found: shortened(&said.to_string(), LONGEST),
            read: match read.as_u64() {
                Some(whole) if whole > MOST_EXACT => format!("a whole number from 0 to {MOST_EXACT} (2^53 − 1)"),
                _ => shortened(&read.to_string(), LONGEST),
            },
        }),
    }
}

fn compare_tables(at: &str, said: &Map<String, Value>, read: &Map<String, Value>) -> Result<(), PlanFileError> {
    let inside = |key: &str| {
        let dot = if at.is_empty() { "" } else { "." };
        format!("{at}{dot}{}", key.escape_debug())
    };
    for (key, value) in said {
        match read.get(key) {
            Some(known) => compare(&inside(key), value, known)?,
            None if value.is_null() => {
                return Err(PlanFileError::Inexact {
                    key: inside(key),
                    found: "null".to_owned(),
                    read: "left out".to_owned(),
                });
            }
            None => return Err(PlanFileError::UnknownKey { key: inside(key) }),
        }
    }
    match read.keys().find(|key| !said.contains_key(*key)) {
        Some(missing) => Err(PlanFileError::MissingKey { key: inside(missing) }),
        None => Ok(()),
    }
}

/// Whether two numbers are the same JSON number. Where a whole number was read, it is one that JSON says exactly.
fn same(said: &Number, read: &Number) -> bool {
    match read.as_u64() {
        Some(whole) if !said.is_f64() => said.as_u64() == Some(whole) && (whole <= MOST_EXACT),
        _ => said.as_f64() == read.as_f64(),
    }
}

/// Reads any JSON value, and refuses a key that is stated twice.
struct Strict;

impl<'de> DeserializeSeed<'de> for Strict {
    type Value = Value;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Value, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Strict {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Value, A::Error> {
        let mut all = Vec::new();
        while let Some(value) = list.next_element_seed(Self)? {
            all.push(value);
        }
        Ok(Value::Array(all))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut table: A) -> Result<Value, A::Error> {
        let mut all = Map::new();
        while let Some(key) = table.next_key::<String>()? {
            if all.contains_key(&key) {
                return Err(A::Error::custom(format_args!("key {key:?} is stated twice")));
            }
            let value = table.next_value_seed(Self)?;
            all.insert(key, value);
        }
        Ok(Value::Object(all))
    }
}
