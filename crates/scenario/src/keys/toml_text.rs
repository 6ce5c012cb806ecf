//! A value as TOML writes it.

use serde_json::{Number, Value};

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
