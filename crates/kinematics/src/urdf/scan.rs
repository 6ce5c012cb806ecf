//! First look at URDF text with a pull parser: bounds size and depth, finds cut files and stray text, refuses
//! xacro and vectors with words among their numbers. Nothing recursive may see the text before this.

use crate::urdf::error::UrdfError;
use crate::urdf::line::line_at;
use quick_xml::errors::SyntaxError;
use quick_xml::events::attributes::Attribute;
use quick_xml::events::{BytesStart, Event};
use quick_xml::reader::Reader;

/// Greatest length of a text \[bytes\].
pub const MAX_BYTES: usize = 16 << 20;
/// Deepest nesting that is read; real descriptions need fewer than 10 levels.
const MAX_DEPTH: usize = 64;
/// Elements with vector attributes, and below those attributes. `urdf-rs` skips words that are not numbers in them.
const WITH_VECTORS: [&str; 4] = ["origin", "axis", "box", "mesh"];
const VECTORS: [&str; 4] = ["xyz", "rpy", "size", "scale"];

/// Checks well-formedness, size, depth and the root element.
pub(crate) fn check(text: &str) -> Result<(), UrdfError> {
    if text.len() > MAX_BYTES {
        return Err(UrdfError::TooLarge {
            bytes: text.len(),
            limit: MAX_BYTES,
        });
    }
    let mut reader = Reader::from_str(text);
    let mut scan = Scan::new(text);
    loop {
        let event = reader.read_event();
        scan.position = usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX);
        match event {
            Ok(Event::Eof) => return scan.end(),
            Ok(event) => scan.take(&event)?,
            Err(e) => return Err(scan.broken(&e)),
        }
    }
}

/// State of the scan.
struct Scan<'a> {
    text: &'a str,
    /// Number of bytes read.
    position: usize,
    /// Names of the elements that are not closed yet.
    open: Vec<String>,
    root_seen: bool,
}

impl<'a> Scan<'a> {
    fn new(text: &'a str) -> Self {
        Self {
            text,
            position: 0,
            open: Vec::new(),
            root_seen: false,
        }
    }

    /// Line of the current position. It is counted only when an error needs it: counting at every tag would take quadratic time.
    fn line(&self) -> usize {
        line_at(self.text, self.position)
    }

    fn take(&mut self, event: &Event<'_>) -> Result<(), UrdfError> {
        match event {
            Event::Start(tag) => {
                let name = self.element(tag)?;
                self.open.push(name);
                self.depth()
            }
            Event::Empty(tag) => self.element(tag).map(drop),
            Event::End(_) => {
                self.open.pop();
                Ok(())
            }
            Event::Text(text) if self.open.is_empty() && !blank(&String::from_utf8_lossy(text)) => Err(self.stray()),
            Event::CData(_) | Event::GeneralRef(_) if self.open.is_empty() => Err(self.stray()),
            _ => Ok(()),
        }
    }

    /// Checks an element's name, place and attributes; returns the name.
    fn element(&mut self, tag: &BytesStart<'_>) -> Result<String, UrdfError> {
        let name = String::from_utf8_lossy(tag.name().as_ref()).into_owned();
        if name.starts_with("xacro:") {
            return Err(UrdfError::Xacro {
                tag: name,
                line: self.line(),
            });
        }
        for attribute in tag.attributes() {
            let attribute = attribute.map_err(|e| self.xml(&without_position(&e.to_string())))?;
            if WITH_VECTORS.contains(&name.as_str())
                && VECTORS.iter().any(|vector| vector.as_bytes() == attribute.key.as_ref())
            {
                self.numbers(&name, &attribute)?;
            }
        }
        match (self.root_seen, self.open.is_empty()) {
            (false, _) if name != "robot" => Err(UrdfError::NotARobot {
                found: format!("<{name}>"),
            }),
            (true, true) => Err(self.xml(&format!("<{name}> stands after the end of the root element"))),
            _ => {
                self.root_seen = true;
                Ok(name)
            }
        }
    }

    fn numbers(&self, element: &str, attribute: &Attribute<'_>) -> Result<(), UrdfError> {
        let value = String::from_utf8_lossy(&attribute.value);
        match value.split_whitespace().find(|v| v.parse::<f64>().is_err()) {
            None => Ok(()),
            Some(word) => Err(UrdfError::Syntax {
                at: format!("<{element}> (line {})", self.line()),
                detail: format!(
                    "'{word}' in {} is not a number",
                    String::from_utf8_lossy(attribute.key.as_ref())
                ),
            }),
        }
    }

    fn depth(&self) -> Result<(), UrdfError> {
        if self.open.len() <= MAX_DEPTH {
            return Ok(());
        }
        Err(UrdfError::TooDeep {
            depth: self.open.len(),
            limit: MAX_DEPTH,
            line: self.line(),
        })
    }

    fn end(mut self) -> Result<(), UrdfError> {
        match self.open.pop() {
            Some(element) => Err(UrdfError::Truncated {
                element,
                line: self.line(),
            }),
            None if self.root_seen => Ok(()),
            None => Err(UrdfError::NotARobot {
                found: "no element at all".to_owned(),
            }),
        }
    }

    /// Converts a parser error: a syntax error means that the text ended inside some markup, except for a wrong `<!…`.
    fn broken(mut self, error: &quick_xml::Error) -> UrdfError {
        let cut = match error {
            quick_xml::Error::Syntax(SyntaxError::InvalidBangMarkup) => self.text.ends_with("<!"),
            quick_xml::Error::Syntax(_) => true,
            _ => false,
        };
        match self.open.pop().filter(|_| cut) {
            Some(element) => UrdfError::Truncated {
                element,
                line: self.line(),
            },
            None => self.xml(error),
        }
    }

    fn stray(&self) -> UrdfError {
        self.xml(&"text outside the root element")
    }

    fn xml(&self, detail: &dyn std::fmt::Display) -> UrdfError {
        UrdfError::Xml {
            line: self.line(),
            detail: detail.to_string(),
        }
    }
}

/// Returns a message about attributes without its byte position, as the line is stated.
fn without_position(message: &str) -> &str {
    message
        .split_once(": ")
        .filter(|(at, _)| at.starts_with("position "))
        .map_or(message, |(_, what)| what)
}

fn blank(text: &str) -> bool {
    text.trim_start_matches('\u{feff}').trim().is_empty()
}
