//! Text that a terminal may be given.

use std::fmt::Display;

/// A value as text without control characters but new lines, so that a terminal obeys no name out of a file.
pub fn text(value: &impl Display) -> String {
    escaped(&value.to_string(), |c| c.escape_default().to_string())
}

/// A text in which `escape` writes every control character but new lines.
pub fn escaped(text: &str, escape: impl Fn(char) -> String) -> String {
    let mut all = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() && c != '\n' {
            all.push_str(&escape(c));
        } else {
            all.push(c);
        }
    }
    all
}
