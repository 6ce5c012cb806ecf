//! Messages of ROS as trees of values with their lines: in YAML, as its versions 1.1 and 1.2 both read it, and JSON. The ROS 2 dialect of
//! robot programs reads its own by it, too.
//!
//! | concept | module |
//! | --- | --- |
//! | documents of a file, by its name | here |
//! | languages | `language` |
//! | YAML as a tree with lines, strictly and within bounds | `node` |
//! | values by their kind | `fields` |
//! | numbers | `number` |

mod fields;
mod language;
mod node;
pub mod number;

pub use crate::message::fields::{Fields, again, entries, list, parse_number, text};
pub use crate::message::language::Language;
pub use crate::message::node::{Entry, Fault, Kind, Node, with_indented_brackets};
pub use crate::message::number::ParsedNumber;

use platewash_workcell::words::without_mark;

/// Nanoseconds of a second.
pub const NS_PER_S: i64 = 1_000_000_000;

/// Reads a text as a tree, by the end of its file's name. `other` is the reason to refuse another name.
pub fn document<'a>(name: &str, text: &'a str, other: &str) -> Result<Node<'a>, Fault> {
    let text = without_mark(text);
    node::read(text, language(name, text, other)?)
}

/// Reads a text of several documents as trees, by the end of its file's name. `other` is the reason to refuse another name.
pub fn documents<'a>(name: &str, text: &'a str, other: &str) -> Result<Vec<Node<'a>>, Fault> {
    let text = without_mark(text);
    node::documents(text, language(name, text, other)?)
}

/// Language of a text by the end of its file's name; a text of JSON must be some.
fn language(name: &str, text: &str, other: &str) -> Result<Language, Fault> {
    let language = Language::from_file_name(name).ok_or_else(|| Fault::new(1, other))?;
    if language == Language::Json && text.len() <= node::MAX_BYTES {
        let json = serde_json::from_str::<serde::de::IgnoredAny>(text);
        json.map_err(|e| Fault::new(e.line(), format!("not JSON: {e}")))?;
    }
    Ok(language)
}
