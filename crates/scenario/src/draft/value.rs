//! A value of a text, and the same value as JSON.

use crate::draft::stop::Stop;
use crate::keys::value::json_of;
use serde_json::Value as Json;
use toml::de::DeValue;
use toml_edit::{RawString, Value};

pub(crate) fn text_of(raw: Option<&RawString>) -> String {
    raw.and_then(RawString::as_str).unwrap_or_default().to_owned()
}

/// Puts a value in the place of another, whose decoration stays.
pub(crate) fn replace_value(old: &mut Value, mut new: Value) {
    *new.decor_mut() = old.decor().clone();
    *old = new;
}

pub(crate) fn parsed(text: &str) -> Result<Value, Stop> {
    text.parse().map_err(|_| Stop::Unplaced)
}

/// A value's text without the text around it.
pub(crate) fn bare_text(value: &Value) -> String {
    let mut bare = value.clone();
    bare.decor_mut().clear();
    bare.to_string()
}

pub(crate) fn json(value: &Value) -> Json {
    DeValue::parse(&bare_text(value)).map_or(Json::Null, |value| json_of(value.get_ref()))
}

/// Compares two values as readers of the file see them: numbers to the bit, and a whole number with a point equals the one
/// without.
pub(crate) fn same(a: &Json, b: &Json) -> bool {
    match (a, b) {
        (Json::Number(a), Json::Number(b)) => a.as_f64().map(f64::to_bits) == b.as_f64().map(f64::to_bits),
        (Json::Object(a), Json::Object(b)) => {
            a.len() == b.len() && a.iter().all(|(name, a)| b.get(name).is_some_and(|b| same(a, b)))
        }
        (Json::Array(a), Json::Array(b)) => a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b)),
        (Json::Null, _) | (_, Json::Null) => false,
        _ => a == b,
    }
}
