//! Numbers in messages, as readers of YAML 1.1, YAML 1.2 and JSON take them.

/// Number in a text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParsedNumber {
    /// A finite number that every reader takes for a float.
    Float(f64),
    /// A whole number.
    Whole(i64),
    /// A finite number that JSON and YAML 1.2 take for a float, and YAML 1.1 for a text.
    TextInYaml11(f64),
    /// Not a number, or not a finite one.
    Nothing,
}

/// Reads a number's text.
pub fn read(text: &str) -> ParsedNumber {
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (unsigned, None),
    };
    let (whole, fraction) = match mantissa.split_once('.') {
        Some((whole, fraction)) => (whole, Some(fraction)),
        None => (mantissa, None),
    };
    let digits = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    let octal = whole.len() > 1 && whole.starts_with('0');
    let power = exponent.map(|e| e.strip_prefix(['-', '+']).unwrap_or(e));
    let is_number = !whole.is_empty()
        && digits(whole)
        && !octal
        && fraction.is_none_or(|f| !f.is_empty() && digits(f))
        && power.is_none_or(|p| !p.is_empty() && digits(p));
    if !is_number {
        return ParsedNumber::Nothing;
    }
    if fraction.is_none() && exponent.is_none() {
        return text.parse().map_or(ParsedNumber::Nothing, ParsedNumber::Whole);
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => {
            let signed = exponent.is_none_or(|e| e.starts_with(['-', '+']));
            if fraction.is_some() && signed {
                ParsedNumber::Float(value)
            } else {
                ParsedNumber::TextInYaml11(value)
            }
        }
        _ => ParsedNumber::Nothing,
    }
}
