//! Numbers as text, for files with many of them.

/// Adds the shortest decimal that reads back as a finite number, whole numbers without a point; very small and large ones have an exponent.
pub(crate) fn push_shortest(text: &mut String, number: f64) {
    let mut buffer = zmij::Buffer::new();
    let digits = buffer.format_finite(number);
    text.push_str(digits.strip_suffix(".0").unwrap_or(digits));
}
