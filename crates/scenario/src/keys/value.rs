//! A value of a file or of an edit: as JSON, in words.
//!
//! Also here: a value as TOML writes it; values in effect in a scenario, key by key.

use crate::keys::KEYS;
use crate::scenario::Scenario;
use platewash_workcell::words::quoted;
use serde_json::{Number, Value};
use std::collections::BTreeMap;
use toml::de::DeValue;

/// Elements of a list that are named.
const FEW: usize = 8;

/// A value of a file as JSON. Values that JSON does not have (NaN, infinity, dates) are null, as are whole numbers of more than 64 bits
/// and sections of other values than numbers: no key takes them.
pub(crate) fn json_of(value: &DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => Value::String(text.clone().into_owned()),
        DeValue::Integer(i) => i64::from_str_radix(i.as_str(), i.radix()).map_or(Value::Null, Value::from),
        DeValue::Float(float) => {
            let number = float.as_str().parse().ok().and_then(Number::from_f64);
            number.map_or(Value::Null, Value::Number)
        }
        DeValue::Boolean(boolean) => Value::Bool(*boolean),
        DeValue::Array(array) => Value::Array(array.iter().map(|v| json_of(v.get_ref())).collect()),
        DeValue::Table(table) => {
            let numbers: serde_json::Map<_, _> = table
                .iter()
                .map(|(name, value)| (name.get_ref().to_string(), json_of(value.get_ref())))
                .collect();
            match numbers.values().all(Value::is_number) {
                true => Value::Object(numbers),
                false => Value::Null,
            }
        }
        DeValue::Datetime(_) => Value::Null,
    }
}

/// A value of a file, in words.
pub(crate) fn describe(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => quoted(text),
        DeValue::Integer(integer) => integer.to_string(),
        DeValue::Float(float) => float.to_string(),
        DeValue::Boolean(boolean) => boolean.to_string(),
        DeValue::Datetime(datetime) => datetime.to_string(),
        DeValue::Array(array) => list(array.iter().map(|v| describe(v.get_ref()))),
        DeValue::Table(_) => "a section".to_owned(),
    }
}

/// A value of an edit, in the same words.
pub(crate) fn describe_json(value: &Value) -> String {
    match value {
        Value::Null => "nothing".to_owned(),
        Value::Bool(boolean) => boolean.to_string(),
        Value::Number(number) => number.to_string(),
        Value::String(text) => quoted(text),
        Value::Array(array) => list(array.iter().map(describe_json)),
        Value::Object(_) => "a section".to_owned(),
    }
}

fn list(mut elements: impl ExactSizeIterator<Item = String>) -> String {
    let few: Vec<_> = elements.by_ref().take(FEW).collect();
    let more = if elements.len() > 0 { ", …" } else { "" };
    format!("[{}{more}]", few.join(", "))
}

/// A value on one line; numbers with the shortest text that reads back exactly.
pub(crate) fn on_one_line(value: &Value) -> String {
    match value {
        Value::Array(elements) => {
            let elements: Vec<_> = elements.iter().map(on_one_line).collect();
            format!("[{}]", elements.join(", "))
        }
        Value::Object(table) if table.is_empty() => "{}".to_owned(),
        Value::Object(table) => {
            let pairs: Vec<_> = table
                .iter()
                .map(|(name, value)| format!("{} = {}", key_text(name), on_one_line(value)))
                .collect();
            format!("{{ {} }}", pairs.join(", "))
        }
        Value::String(text) => string(text),
        Value::Number(value) => number(value),
        other => other.to_string(),
    }
}

/// A name as a key of TOML: bare where it can be.
fn key_text(name: &str) -> String {
    let is_bare = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-');
    match !name.is_empty() && name.bytes().all(is_bare) {
        true => name.to_owned(),
        false => string(name),
    }
}

/// A list with an element a line.
pub(crate) fn on_rows(elements: &[Value]) -> String {
    let rows: String = elements
        .iter()
        .map(|element| format!("\n    {},", on_one_line(element)))
        .collect();
    format!("[{rows}\n]")
}

/// A value in the style of the one that it takes the place of: whole numbers without a point and texts in single quotes stay so.
pub(crate) fn in_style_of(old: &str, value: &Value) -> String {
    let whole = |n: &Number| {
        n.as_f64()
            .filter(|v| v.fract() == 0.0 && v.abs() < 1e15 && v.to_bits() != (-0.0f64).to_bits())
    };
    match value {
        Value::Number(n) if is_whole(old) => whole(n).map_or_else(|| number(n), |v| format!("{v:.0}")),
        Value::String(text) if old.starts_with('\'') && !old.starts_with("'''") => {
            let plain = !text.contains(|c: char| c == '\'' || c.is_control());
            if plain { format!("'{text}'") } else { string(text) }
        }
        other => on_one_line(other),
    }
}

fn is_whole(old: &str) -> bool {
    let digits = old.strip_prefix(['+', '-']).unwrap_or(old);
    !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit() || b == b'_')
}

fn number(number: &Number) -> String {
    match number.as_f64() {
        Some(float) if number.is_f64() => format!("{float:?}"),
        _ => number.to_string(),
    }
}

/// A text in double quotes. JSON's escapes are TOML's, except for one character that TOML escapes, too.
fn string(text: &str) -> String {
    Value::from(text).to_string().replace('\u{7f}', "\\u007F")
}

/// The values of a scenario by their keys, defaults filled in; keys without a value are left out. Paths are as the scenario has them:
/// those of a file that was loaded begin with its folder.
#[must_use]
pub fn values_of(scenario: &Scenario) -> BTreeMap<String, Value> {
    let Ok(all) = serde_json::to_value(scenario) else {
        return BTreeMap::new();
    };
    let stated = KEYS.iter().filter_map(|key| {
        let value = key.path.split('.').try_fold(&all, |v, name| v.get(name))?;
        (!value.is_null()).then(|| (key.path.to_owned(), value.clone()))
    });
    stated.collect()
}
