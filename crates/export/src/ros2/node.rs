//! YAML as a tree with lines, strictly and within bounds: the part of the language that a message needs, and nothing else.

use crate::ros2::read::Language;
use platewash_workcell::words::{quoted, shortened};
use saphyr_parser::{Event, Parser, ScalarStyle, Span};
use std::borrow::Cow;

/// Longest text that is read \[bytes\].
pub(crate) const MAX_BYTES: usize = 1 << 25;

/// Most values of a text, keys among them.
const MAX_NODES: usize = 4_000_000;

/// Deepest nesting.
const MAX_DEPTH: usize = 16;

/// Longest text that a message repeats, in characters.
const LONGEST: usize = 40;

/// A value of a text.
#[derive(Debug)]
pub(crate) struct Node<'a> {
    /// The line at which it begins, from 1.
    pub(crate) line: usize,
    pub(crate) kind: Kind<'a>,
}

/// Kind of a value.
#[derive(Debug)]
pub(crate) enum Kind<'a> {
    /// Value without quotes: a number, or a word.
    Plain(Cow<'a, str>),
    /// Value without quotes in a text that is also JSON: its numbers are those of JSON.
    OfJson(Cow<'a, str>),
    /// A text in quotes.
    Quoted(Cow<'a, str>),
    List(Vec<Node<'a>>),
    /// Keys, no two the same, with the line of each.
    Table(Vec<Entry<'a>>),
}

/// A key of a table, and its value.
#[derive(Debug)]
pub(crate) struct Entry<'a> {
    pub(crate) key: Cow<'a, str>,
    pub(crate) line: usize,
    pub(crate) value: Node<'a>,
}

/// A line, and its error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) line: usize,
    pub(crate) reason: String,
}

impl Fault {
    pub(crate) fn new(line: usize, reason: impl Into<String>) -> Self {
        let reason = reason.into();
        Self { line, reason }
    }
}

impl Kind<'_> {
    /// Message of the fault, in words.
    pub(crate) fn message(&self) -> String {
        match self {
            Self::Plain(text) | Self::OfJson(text) => told(text),
            Self::Quoted(text) => format!("the text {}", quoted(&told(text))),
            Self::List(_) => "a list".to_owned(),
            Self::Table(_) => "a table".to_owned(),
        }
    }
}

fn told(text: &str) -> String {
    match text {
        "" => "nothing".to_owned(),
        text => shortened(text, LONGEST),
    }
}

/// Reads a text: one document, no anchors, aliases and tags, no key twice in a table.
pub(crate) fn read(text: &str, language: Language) -> Result<Node<'_>, Fault> {
    if text.len() > MAX_BYTES {
        let reason = format!("expected {MAX_BYTES} bytes at most; found {}", text.len());
        return Err(Fault::new(1, reason));
    }
    // YAML 1.1, which ROS 2 reads, ends lines and comments there; YAML 1.2, which is read here, does not.
    let ends_a_line = |c: char| matches!(c, '\u{85}' | '\u{2028}' | '\u{2029}');
    if let Some((line, _)) = (1..).zip(text.lines()).find(|(_, line)| line.contains(ends_a_line)) {
        return Err(Fault::new(
            line,
            "expected lines that end with a line feed; found U+0085, U+2028 or U+2029, which ends a line in YAML 1.1 alone",
        ));
    }
    let mut events = Events {
        parser: Parser::new_from_str(text),
        language,
        nodes: 0,
    };
    events.expect(|event| matches!(event, Event::StreamStart))?;
    match events.next()? {
        (Event::DocumentStart(_), _) => {}
        (_, line) => return Err(Fault::new(line, "expected a message; found nothing")),
    }
    let first = events.next()?;
    let root = events.node(first, 0)?;
    events.expect(|event| matches!(event, Event::DocumentEnd))?;
    match events.next()? {
        (Event::StreamEnd, _) => Ok(root),
        (_, line) => Err(Fault::new(line, "expected one document; found another one")),
    }
}

struct Events<'a> {
    parser: Parser<'a, saphyr_parser::StrInput<'a>>,
    language: Language,
    nodes: usize,
}

impl<'a> Events<'a> {
    /// The next event and its line.
    fn next(&mut self) -> Result<(Event<'a>, usize), Fault> {
        match self.parser.next_event() {
            Some(Ok((event, Span { start, .. }))) => Ok((event, start.line())),
            Some(Err(error)) => Err(Fault::new(error.marker().line(), format!("not YAML: {}", error.info()))),
            None => Err(Fault::new(1, "not YAML: it ends early")),
        }
    }

    fn expect(&mut self, is_it: impl Fn(&Event<'_>) -> bool) -> Result<(), Fault> {
        let (event, line) = self.next()?;
        match is_it(&event) {
            true => Ok(()),
            false => Err(Fault::new(line, "not YAML: expected another part of the document")),
        }
    }

    fn node(&mut self, (event, line): (Event<'a>, usize), depth: usize) -> Result<Node<'a>, Fault> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            return Err(Fault::new(
                line,
                format!("expected {MAX_NODES} values at most; found more"),
            ));
        }
        if depth > MAX_DEPTH {
            return Err(Fault::new(
                line,
                format!("expected {MAX_DEPTH} levels at most; found more"),
            ));
        }
        let kind = match event {
            Event::Alias(_) => return Err(Fault::new(line, "expected a value; found an alias")),
            Event::Scalar(_, _, anchor, ref tag) => {
                check_bare_line(line, anchor, tag.is_some())?;
                let Event::Scalar(text, style, ..) = event else {
                    return Err(Fault::new(line, "expected a value"));
                };
                match (style, self.language) {
                    (ScalarStyle::Plain, Language::Yaml) => Kind::Plain(text),
                    (ScalarStyle::Plain, Language::Json) => Kind::OfJson(text),
                    _ => Kind::Quoted(text),
                }
            }
            Event::SequenceStart(anchor, tag) => {
                check_bare_line(line, anchor, tag.is_some())?;
                Kind::List(self.list(depth)?)
            }
            Event::MappingStart(anchor, tag) => {
                check_bare_line(line, anchor, tag.is_some())?;
                Kind::Table(self.table(depth)?)
            }
            _ => return Err(Fault::new(line, "expected a value; found the end")),
        };
        Ok(Node { line, kind })
    }

    fn list(&mut self, depth: usize) -> Result<Vec<Node<'a>>, Fault> {
        let mut all = Vec::new();
        loop {
            match self.next()? {
                (Event::SequenceEnd, _) => return Ok(all),
                event => all.push(self.node(event, depth + 1)?),
            }
        }
    }

    fn table(&mut self, depth: usize) -> Result<Vec<Entry<'a>>, Fault> {
        let mut all: Vec<Entry<'a>> = Vec::new();
        loop {
            let event = match self.next()? {
                (Event::MappingEnd, _) => return Ok(all),
                event => event,
            };
            let Node { line, kind } = self.node(event, depth + 1)?;
            let key = match kind {
                Kind::Plain(key) | Kind::OfJson(key) | Kind::Quoted(key) => key,
                other => return Err(Fault::new(line, format!("expected a key; found {}", other.message()))),
            };
            // No table of a message has many keys: a longer one is refused before its keys are compared for long.
            if all.len() == MAX_KEYS {
                return Err(Fault::new(
                    line,
                    format!("expected {MAX_KEYS} keys at most; found more"),
                ));
            }
            if all.iter().any(|entry| entry.key == key) {
                return Err(Fault::new(
                    line,
                    format!("the key {} stands twice", quoted(&told(&key))),
                ));
            }
            let event = self.next()?;
            let value = self.node(event, depth + 1)?;
            all.push(Entry { key, line, value });
        }
    }
}

/// Most keys of a table.
const MAX_KEYS: usize = 64;

fn check_bare_line(line: usize, anchor: usize, tagged: bool) -> Result<(), Fault> {
    match (anchor, tagged) {
        (0, false) => Ok(()),
        (_, true) => Err(Fault::new(line, "expected a value; found a tag before it")),
        _ => Err(Fault::new(line, "expected a value; found an anchor before it")),
    }
}
