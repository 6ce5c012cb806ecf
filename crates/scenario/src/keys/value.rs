//! A value of a file or of an edit: as JSON, in words.

use crate::keys::table::KEYS;
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
