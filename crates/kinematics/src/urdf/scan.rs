//! First look at URDF text with a pull parser: bounds size and depth, finds cut files, refuses xacro.
//! Nothing recursive may see the text before this.

use super::UrdfError;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// Longest text that is read \[bytes\].
const MAX_BYTES: usize = 16 << 20;
/// Deepest nesting that is read; real descriptions need fewer than 10 levels.
const MAX_DEPTH: usize = 64;

/// Checks well-formedness, size, depth and the root element.
pub(super) fn check(text: &str) -> Result<(), UrdfError> {
    if text.len() > MAX_BYTES {
        return Err(UrdfError::TooLarge {
            bytes: text.len(),
            limit: MAX_BYTES,
        });
    }
    let mut reader = Reader::from_str(text);
    let mut open: Vec<String> = Vec::new();
    let mut root: Option<String> = None;
    loop {
        let event = reader.read_event();
        let line = || line_at(text, reader.buffer_position());
        match event {
            Ok(Event::Start(tag)) => {
                open.push(element(&tag, &mut root, line())?);
                if open.len() > MAX_DEPTH {
                    return Err(UrdfError::TooDeep {
                        depth: open.len(),
                        limit: MAX_DEPTH,
                        line: line(),
                    });
                }
            }
            Ok(Event::Empty(tag)) => {
                element(&tag, &mut root, line())?;
            }
            Ok(Event::End(_)) => {
                open.pop();
            }
            Ok(Event::Eof) => return end(open.pop(), root, line()),
            Ok(_) => {}
            Err(quick_xml::Error::Syntax(e)) => {
                return Err(match open.pop() {
                    Some(element) => UrdfError::Truncated { element, line: line() },
                    None => xml(line(), &e),
                });
            }
            Err(e) => return Err(xml(line(), &e)),
        }
    }
}

/// Notes the root element; returns the element's name.
fn element(tag: &BytesStart<'_>, root: &mut Option<String>, line: usize) -> Result<String, UrdfError> {
    let name = tag.name().as_ref().to_owned();
    if name.starts_with("xacro:") {
        return Err(UrdfError::Xacro { tag: name, line });
    }
    for attribute in tag.attributes() {
        attribute.map_err(|e| xml(line, &e))?;
    }
    match root {
        None if name != "robot" => Err(UrdfError::NotARobot {
            found: format!("<{name}>"),
        }),
        None => {
            *root = Some(name.clone());
            Ok(name)
        }
        Some(_) => Ok(name),
    }
}

fn end(open: Option<String>, root: Option<String>, line: usize) -> Result<(), UrdfError> {
    match (open, root) {
        (Some(element), _) => Err(UrdfError::Truncated { element, line }),
        (None, None) => Err(UrdfError::NotARobot {
            found: "no element at all".to_owned(),
        }),
        (None, Some(_)) => Ok(()),
    }
}

fn xml(line: usize, detail: &dyn std::fmt::Display) -> UrdfError {
    let detail = detail.to_string();
    UrdfError::Xml { line, detail }
}

fn line_at(text: &str, position: u64) -> usize {
    let end = usize::try_from(position).unwrap_or(text.len()).min(text.len());
    1 + text.as_bytes()[..end].iter().filter(|b| **b == b'\n').count()
}
