//! Text that is safe to show on a terminal.

use std::fmt::Display;

/// A value as text without control characters but new lines, so that a terminal obeys no name out of a file.
pub fn shown(value: &impl Display) -> String {
    let text = value.to_string();
    let is_harmful = |c: char| c.is_control() && c != '\n';
    if !text.contains(is_harmful) {
        return text;
    }
    let written = |c: char| match is_harmful(c) {
        true => c.escape_default().to_string(),
        false => c.to_string(),
    };
    text.chars().map(written).collect()
}
