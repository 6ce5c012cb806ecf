//! Words that messages share, and texts that people typed.

use platewash_kinematics::words::is_hidden;

/// Formats the names of two bodies, as from files: `"a" – "b"`.
#[must_use]
pub fn pair_text([a, b]: &[String; 2]) -> String {
    format!("{} – {}", quoted(a), quoted(b))
}

/// Returns a text without the byte order mark that some editors put before it.
#[must_use]
pub fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

/// A number of things: `1 plate`, `4 plates`.
#[must_use]
pub fn count_with_noun(count: usize, noun: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {noun}{ending}")
}

/// A part of some things: `0 of 1 plate`, `1 of 4 plates`.
#[must_use]
pub fn part_of(part: usize, count: usize, noun: &str) -> String {
    format!("{part} of {}", count_with_noun(count, noun))
}

/// Name of a plate in words, counted from 1: `plate 1` for index 0. It is also the name of its body.
#[must_use]
pub fn plate_name(index: usize) -> String {
    format!("plate {}", plate_number(index))
}

/// Number of a plate in words, counted from 1. The largest index, which only a damaged file states, has no number of its own.
#[must_use]
pub fn plate_number(index: usize) -> usize {
    index.saturating_add(1)
}

/// A length in millimetres, to a tenth: `-90.0 mm`.
#[must_use]
pub fn millimetres(length_m: f64) -> String {
    format!("{:.1} mm", 1e3 * length_m)
}

/// The first `most` characters of a text; `…` stands for the rest.
#[must_use]
pub fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// Text out of a file with control and format characters and separators of lines written out, so that no terminal obeys them, no
/// line is added to a message and nothing is hidden or reordered.
#[must_use]
pub fn printable(text: &str) -> String {
    let written = |c: char| {
        if is_hidden(c) {
            c.escape_default().to_string()
        } else {
            c.to_string()
        }
    };
    text.chars().map(written).collect()
}

/// Greatest number of characters of a name in a message.
const LONGEST_NAME: usize = 100;

/// Quotes a name from a file, with quotes, backslashes and hidden characters escaped, so that it ends where its quotes end. A long name is
/// shortened, and its length is added.
#[must_use]
pub fn quoted(name: &str) -> String {
    let begins: String = name.chars().take(LONGEST_NAME).collect();
    let rest = match name.chars().count() {
        ..=LONGEST_NAME => String::new(),
        length => format!("… ({length} characters)"),
    };
    let begins = begins.replace('\\', r"\\").replace('"', "\\\"");
    format!("\"{}\"{rest}", printable(&begins))
}
