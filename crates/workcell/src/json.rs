//! JSON of files: read with error messages for people who do not know this program's types, and written.

use crate::words::{printable, without_mark};
use platewash_kinematics::words::message_in_words;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::error::Category;

/// Error in a JSON text.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", printable(.reason))]
pub struct JsonError {
    /// Description of the error, with its key or line.
    pub reason: String,
}

/// Parses a text.
///
/// # Errors
/// [`JsonError`]
pub fn read<T: DeserializeOwned>(text: &str) -> Result<T, JsonError> {
    let text = without_mark(text);
    serde_json::from_str(text).map_err(|error| JsonError {
        reason: error_text(text, &error),
    })
}

/// Writes a value as indented JSON with a final newline. NaN and infinity become `null`; control characters are escaped, those too
/// that JSON itself allows.
///
/// # Errors
/// A value that JSON cannot hold.
pub fn write(value: &impl Serialize) -> Result<String, JsonError> {
    let mut text = serde_json::to_string_pretty(value).map_err(|error| JsonError {
        reason: error.to_string(),
    })?;
    let is_harmful = |c: char| c.is_control() && c != '\n';
    if text.contains(is_harmful) {
        let written = |c: char| match is_harmful(c) {
            true => format!("\\u{:04x}", u32::from(c)),
            false => c.to_string(),
        };
        text = text.chars().map(written).collect();
    }
    text.push('\n');
    Ok(text)
}

/// True for a number that files leave out as it is 0.
#[must_use]
pub fn is_zero(number: &f64) -> bool {
    *number == 0.0
}

/// Describes an error with its position.
fn error_text(text: &str, error: &serde_json::Error) -> String {
    let at = format!("line {}, column {}", error.line(), error.column());
    let whole = error.to_string();
    let message = whole.split_once(" at line ").map_or(&*whole, |(message, _)| message);
    match error.classify() {
        Category::Eof => format!("it ends in the middle, at {at}: the file is empty or was cut off"),
        Category::Syntax | Category::Io => format!("it is not valid JSON: {message} at {at}"),
        Category::Data => {
            let lines = text.split_inclusive('\n').take(error.line().saturating_sub(1));
            let before = lines.map(str::len).sum::<usize>() + error.column();
            message_in_words(&path_at(&text.as_bytes()[..before.min(text.len())]), message)
        }
    }
}

/// A table or list that contains the current position.
enum Container {
    /// Table, with the key that was read last.
    Table(String),
    /// List, with the index of the element.
    List(usize),
}

/// Returns the key at which the JSON ends that was read up to an error, such as `list[2].name`; empty for the whole.
fn path_at(read: &[u8]) -> String {
    let mut inside: Vec<Container> = Vec::new();
    let (mut takes_key, mut k) = (false, 0);
    while let Some(&byte) = read.get(k) {
        let is_last = k + 1 == read.len();
        match byte {
            b'{' if !is_last => {
                takes_key = true;
                inside.push(Container::Table(String::new()));
            }
            b'[' if !is_last => inside.push(Container::List(0)),
            // An error at its end is one of the whole table or list.
            b'}' | b']' => drop(inside.pop()),
            b',' => match inside.last_mut() {
                Some(Container::List(index)) => *index += 1,
                _ => takes_key = true,
            },
            b'"' => {
                let start = k + 1;
                k = start;
                while read.get(k).is_some_and(|&byte| byte != b'"') {
                    k += if read[k] == b'\\' { 2 } else { 1 };
                }
                if let Some(Container::Table(key)) = inside.last_mut().filter(|_| takes_key) {
                    *key = String::from_utf8_lossy(&read[start..k.min(read.len())]).into_owned();
                    takes_key = false;
                }
            }
            _ => {}
        }
        k += 1;
    }
    let mut path = String::new();
    for part in &inside {
        match part {
            Container::Table(key) if path.is_empty() || key.is_empty() => path += key,
            Container::Table(key) => path += &format!(".{key}"),
            Container::List(index) => path += &format!("[{index}]"),
        }
    }
    path
}
