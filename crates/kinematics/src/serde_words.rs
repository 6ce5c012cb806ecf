//! Messages of parsers about values of another kind, in words for people who do not know this program's types.

/// A message about a value of another kind, without names of Rust's types: `path` is the key where the value stands, or empty.
#[must_use]
pub fn message_in_words(path: &str, message: &str) -> String {
    let inside = |name: &str| {
        if path.is_empty() {
            name.to_owned()
        } else {
            format!("{path}.{name}")
        }
    };
    let quoted = |text: &str| text.split('`').nth(1).unwrap_or(text).to_owned();
    // The path ends with the key where the parser has read it.
    let in_full = |key: &str| {
        let is_in_path = path == key || path.ends_with(&format!(".{key}"));
        if is_in_path { path.to_owned() } else { inside(key) }
    };
    if message.starts_with("missing field") {
        return format!("'{}' is missing", inside(&quoted(message)));
    }
    if message.starts_with("duplicate field") {
        return format!("'{}' is stated twice", in_full(&quoted(message)));
    }
    if let Some((unknown, expected)) = message.strip_prefix("unknown field ").and_then(|m| m.split_once(", ")) {
        let key = in_full(&quoted(unknown));
        return format!("unknown key '{key}': {}", expected.replace('`', "'"));
    }
    let name = if path.is_empty() {
        "the whole".to_owned()
    } else {
        format!("'{path}'")
    };
    let kinds = ["invalid type: ", "invalid value: ", "invalid length "];
    let found = kinds
        .iter()
        .find_map(|kind| message.strip_prefix(kind)?.split_once(", expected "));
    if let Some((variant, expected)) = message
        .strip_prefix("unknown variant ")
        .and_then(|m| m.split_once(", expected "))
    {
        let expected = expected.trim_start_matches("one of ").replace('`', "'");
        return format!("'{}' is none of {expected}", quoted(variant));
    }
    match found {
        Some((found, expected)) => format!(
            "{name} must be {}; found {}",
            expected_words(expected),
            found_words(found)
        ),
        None if path.is_empty() => message.to_owned(),
        None => format!("{name}: {message}"),
    }
}

fn expected_words(expected: &str) -> String {
    match expected {
        "u8" | "u16" | "u32" | "u64" | "usize" | "i32" | "i64" => "a whole number".to_owned(),
        "f64" | "f32" => "a number".to_owned(),
        "a string" => "a text".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a map" => "a table {…}".to_owned(),
        "a sequence" => "a list […]".to_owned(),
        other if other.starts_with("struct ") || other.starts_with("internally tagged enum") => {
            "a table {…}".to_owned()
        }
        other => other
            .replace("an array of length", "a list of length")
            .replace('`', "'"),
    }
}

fn found_words(found: &str) -> String {
    match found {
        "map" => "a table {…}".to_owned(),
        "sequence" => "a list […]".to_owned(),
        other => {
            let plain = ["integer ", "floating point ", "boolean ", "string ", "character "];
            let rest = plain.iter().find_map(|kind| other.strip_prefix(kind)).unwrap_or(other);
            rest.replace('`', "")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::message_in_words;

    #[test]
    fn no_type_of_rust_is_named() {
        for (path, message, told) in [
            ("", "missing field `format`", "'format' is missing"),
            ("a.b", "missing field `c`", "'a.b.c' is missing"),
            (
                "",
                "unknown field `seed`, expected one of `name`, `axis`",
                "unknown key 'seed': expected one of 'name', 'axis'",
            ),
            (
                "",
                "unknown variant `hinge`, expected one of `revolute`, `fixed`",
                "'hinge' is none of 'revolute', 'fixed'",
            ),
            (
                "rows",
                "invalid type: map, expected a sequence",
                "'rows' must be a list […]; found a table {…}",
            ),
            (
                "seed",
                "invalid value: integer `-1`, expected u64",
                "'seed' must be a whole number; found -1",
            ),
            ("", "invalid float literal", "invalid float literal"),
        ] {
            assert_eq!(message_in_words(path, message), told);
        }
    }
}
