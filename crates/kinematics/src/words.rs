//! Numbers in sentences, with as many digits as the sentence needs, and no more.
//!
//! A message that compares two numbers shows that they differ; a suggested number is accepted when it is entered.
//!
//! Messages of parsers about values of another type, in words for people who do not know this program's types.

/// Greatest number of decimals that a double below 10 can need.
const MOST_DECIMALS: usize = 17;

/// Formats two numbers with `decimals` decimals, or with as many more as they need to read differently if they differ.
#[must_use]
pub fn distinct_decimals(a: f64, b: f64, decimals: usize) -> [String; 2] {
    let told = |digits: usize| [a, b].map(|v| format!("{v:.digits$}"));
    let differ = |[a, b]: &[String; 2]| a != b;
    if a == b || a.is_nan() || b.is_nan() {
        return told(decimals);
    }
    let enough = (decimals..=MOST_DECIMALS).map(told).find(differ);
    // The shortest decimals that read back exactly: those of different numbers differ.
    enough.unwrap_or_else(|| [a, b].map(|v| format!("{v:e}")))
}

/// Formats a number with `decimals` decimals, or with as many more as show that it is not zero if it is not.
#[must_use]
pub fn nonzero_decimals(value: f64, decimals: usize) -> String {
    let [told, _] = distinct_decimals(value.abs(), 0.0, decimals);
    if value < 0.0 { format!("-{told}") } else { told }
}

/// Formats a number with `decimals` decimals; a number that rounds to zero has no sign.
#[must_use]
pub fn fixed(value: f64, decimals: usize) -> String {
    let told = format!("{value:.decimals$}");
    match told.strip_prefix('-') {
        Some(zero) if zero.bytes().all(|digit| matches!(digit, b'0' | b'.')) => zero.to_owned(),
        _ => told,
    }
}

/// Formats two angles \[rad\] in degrees with their unit, distinguished as by [`distinct_decimals`]; in radians if their degrees round to the same
/// number.
#[must_use]
pub fn angles_told_apart(a_rad: f64, b_rad: f64, decimals: usize) -> [String; 2] {
    let (a, b) = (a_rad.to_degrees(), b_rad.to_degrees());
    if a == b && a_rad != b_rad {
        return distinct_decimals(a_rad, b_rad, decimals).map(|v| format!("{v} rad"));
    }
    distinct_decimals(a, b, decimals).map(|v| format!("{v}°"))
}

/// Rounds a number to at most `digits` significant digits.
#[must_use]
pub fn rounded(value: f64, digits: usize) -> f64 {
    decimal(&format!("{value:.*e}", digits.saturating_sub(1)), value)
}

/// Returns the least number with at most `digits` significant digits that is not below a positive `value`.
#[must_use]
pub fn rounded_up(value: f64, digits: usize) -> f64 {
    let near = rounded(value, digits);
    if near >= value {
        return near;
    }
    rounded(near + unit(near, digits), digits)
}

/// Returns the greatest number with at most `digits` significant digits that is not above a positive `value`.
#[must_use]
pub fn rounded_down(value: f64, digits: usize) -> f64 {
    let near = rounded(value, digits);
    if near <= value {
        return near;
    }
    rounded(near - unit(value, digits), digits)
}

/// Formats a share in percent with one decimal, rounded down: `99.8`. A share that is below 1 only by rounding is `100`.
#[must_use]
pub fn percent(share: f64) -> String {
    if (1.0 - 1e-9..=1.0).contains(&share) {
        "100".to_owned()
    } else {
        decimals_down(100.0 * share, 1)
    }
}

/// Formats the least number with `decimals` decimals that is not below `value`, for "at most".
#[must_use]
pub fn decimals_up(value: f64, decimals: usize) -> String {
    let near = format!("{value:.decimals$}");
    let read = decimal(&near, value);
    if read >= value || !value.is_finite() {
        return near;
    }
    format!("{:.decimals$}", read + decimal(&format!("1e-{decimals}"), 0.0))
}

/// Formats the greatest number with `decimals` decimals that is not above `value`, for "at least".
#[must_use]
pub fn decimals_down(value: f64, decimals: usize) -> String {
    let near = format!("{value:.decimals$}");
    let read = decimal(&near, value);
    if read <= value || !value.is_finite() {
        return near;
    }
    format!("{:.decimals$}", read - decimal(&format!("1e-{decimals}"), 0.0))
}

/// Value of a unit in the last of `digits` significant digits of a positive number.
fn unit(value: f64, digits: usize) -> f64 {
    let text = format!("{value:e}");
    let exponent = text.split('e').nth(1).and_then(|e| e.parse::<i32>().ok()).unwrap_or(0);
    let last = exponent + 1 - i32::try_from(digits.max(1)).unwrap_or(1);
    decimal(&format!("1e{last}"), 0.0)
}

/// Returns the number nearest to a decimal.
fn decimal(text: &str, otherwise: f64) -> f64 {
    text.parse().unwrap_or(otherwise)
}

/// True for a control or format character of Unicode, and for one that separates lines or paragraphs (categories Cc, Cf, Zl and Zp). Text
/// with such a character does not read as its contents.
#[must_use]
pub fn is_hidden(c: char) -> bool {
    c.is_control() || is_format(c)
}

fn is_format(c: char) -> bool {
    matches!(c,
        '\u{ad}' | '\u{600}'..='\u{605}' | '\u{61c}' | '\u{6dd}' | '\u{70f}' | '\u{890}'..='\u{891}' | '\u{8e2}' | '\u{180e}'
        | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}'
        | '\u{110bd}' | '\u{110cd}' | '\u{13430}'..='\u{1343f}' | '\u{1bca0}'..='\u{1bca3}' | '\u{1d173}'..='\u{1d17a}'
        | '\u{e0001}' | '\u{e0020}'..='\u{e007f}')
}

/// Rewrites a message about a value of another type without names of Rust's types. `path` is the key of the value, or empty.
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
