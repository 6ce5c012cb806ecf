//! YAML as a tree with lines, strictly and within bounds: the part of the language that a message needs, and nothing else.

use crate::message::language::Language;
use crate::place::ReadError;
use platewash_workcell::words::{quoted, shortened};
use saphyr_parser::{Event, Parser, ScalarStyle, Span};
use std::borrow::Cow;
use std::collections::HashMap;

/// Longest text that is read \[bytes\].
pub const MAX_BYTES: usize = 1 << 25;

/// Most values of a text, keys among them.
const MAX_NODES: usize = 4_000_000;

/// Deepest nesting.
const MAX_DEPTH: usize = 16;

/// Longest text that a message repeats, in characters.
const LONGEST: usize = 40;

/// A value of a text.
#[derive(Debug, Clone)]
pub struct Node<'a> {
    /// The line at which it begins, from 1.
    pub line: usize,
    pub kind: Kind<'a>,
}

/// Kind of a value.
#[derive(Debug, Clone)]
pub enum Kind<'a> {
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
#[derive(Debug, Clone)]
pub struct Entry<'a> {
    pub key: Cow<'a, str>,
    pub line: usize,
    pub value: Node<'a>,
}

/// A line, and its error.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    pub line: usize,
    pub reason: String,
}

impl Fault {
    pub fn new(line: usize, reason: impl Into<String>) -> Self {
        let reason = reason.into();
        Self { line, reason }
    }

    /// Returns the fault as the error of a file.
    #[must_use]
    pub fn in_file(self, name: &str) -> ReadError {
        ReadError::at(name, self.line.max(1), self.reason)
    }

    /// Refuses a line.
    ///
    /// # Errors
    /// The fault, always.
    pub fn err<T>(line: usize, reason: impl Into<String>) -> Result<T, Self> {
        Err(Self::new(line, reason))
    }
}

impl Kind<'_> {
    /// Message of the fault, in words.
    pub fn message(&self) -> String {
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

impl<'a> Node<'a> {
    /// The value of a key, where it is a table that has it.
    pub fn get(&self, key: &str) -> Option<&Self> {
        let Kind::Table(entries) = &self.kind else { return None };
        let entry = entries.iter().find(|entry| entry.key == key);
        entry.map(|entry| &entry.value)
    }

    /// The fault of its line.
    pub fn refused<T>(&self, reason: impl Into<String>) -> Result<T, Fault> {
        Fault::err(self.line, reason)
    }

    /// The fault of a node that is something else than expected.
    pub fn unexpected<T>(&self, expected: &str) -> Result<T, Fault> {
        self.refused(format!("expected {expected}; found {}", self.kind.message()))
    }

    /// Number of values in it, and its depth.
    fn extent(&self) -> [usize; 2] {
        let of = |nodes: &mut dyn Iterator<Item = &Self>| {
            nodes.fold([1, 0], |[count, depth], node| {
                let [more, below] = node.extent();
                [count + more, depth.max(below + 1)]
            })
        };
        match &self.kind {
            Kind::List(nodes) => of(&mut nodes.iter()),
            Kind::Table(entries) => of(&mut entries.iter().map(|entry| &entry.value)),
            _ => [1, 0],
        }
    }
}

/// Reads a text of one document: no tags, no key twice in a table.
pub fn read(text: &str, language: Language) -> Result<Node<'_>, Fault> {
    let mut all = documents(text, language)?.into_iter();
    match (all.next(), all.next()) {
        (Some(root), None) => Ok(root),
        (None, _) => Fault::err(1, "expected a message; found nothing"),
        (Some(_), Some(second)) => Fault::err(second.line, "expected one document; found another one"),
    }
}

/// Reads the documents of a text, but for empty ones.
pub fn documents(text: &str, language: Language) -> Result<Vec<Node<'_>>, Fault> {
    if text.len() > MAX_BYTES {
        let reason = format!("expected {MAX_BYTES} bytes at most; found {}", text.len());
        return Fault::err(1, reason);
    }
    // YAML 1.1, which ROS 2 reads, ends lines and comments there; YAML 1.2, which is read here, does not.
    let ends_a_line = |c: char| matches!(c, '\u{85}' | '\u{2028}' | '\u{2029}');
    if let Some((line, _)) = (1..).zip(text.lines()).find(|(_, line)| line.contains(ends_a_line)) {
        return Fault::err(
            line,
            "expected lines that end with a line feed; found U+0085, U+2028 or U+2029, which ends a line in YAML 1.1 alone",
        );
    }
    let mut events = Events {
        parser: Parser::new_from_str(text),
        language,
        nodes: 0,
        anchored: HashMap::new(),
    };
    events.expect(|event| matches!(event, Event::StreamStart))?;
    let mut all = Vec::new();
    loop {
        match events.next()? {
            (Event::StreamEnd, _) => return Ok(all),
            (Event::DocumentStart(_), _) => {}
            (_, line) => return Fault::err(line, "not YAML: expected a document"),
        }
        events.anchored.clear();
        let first = events.next()?;
        let root = events.node(first, 0)?;
        events.expect(|event| matches!(event, Event::DocumentEnd))?;
        let is_empty = matches!(&root.kind, Kind::Plain(text) if text.is_empty() || text == "~");
        all.extend((!is_empty).then_some(root));
    }
}

/// Returns a text with every line that continues a list or table in brackets indented far. YAML 1.2 wants such a line farther in than the key
/// before; YAML 1.1, in which ROS writes and reads messages, does not.
pub fn with_indented_brackets(text: &str) -> String {
    const FAR: &str = "                                ";
    let mut out = String::with_capacity(text.len());
    let mut depth = 0_usize;
    for line in text.split_inclusive('\n') {
        if depth > 0 {
            out.push_str(FAR);
        }
        out.push_str(line);
        let (mut quote, mut before) = (None, None);
        for c in line.chars() {
            // A bracket, quotation mark or sign of a comment begins something where a value may begin.
            let begins = before.is_none_or(|c| matches!(c, ' ' | '\t' | ':' | '-' | ',' | '[' | '{'));
            match (quote, c) {
                (Some(mark), c) if c == mark => quote = None,
                (Some(_), _) => {}
                (None, '"' | '\'') if begins => quote = Some(c),
                (None, '#') if begins => break,
                (None, '[' | '{') if begins || depth > 0 => depth += 1,
                (None, ']' | '}') => depth = depth.saturating_sub(1),
                _ => {}
            }
            before = Some(c);
        }
    }
    out
}

struct Events<'a> {
    parser: Parser<'a, saphyr_parser::StrInput<'a>>,
    language: Language,
    nodes: usize,
    /// Values with an anchor, by the number of the anchor.
    anchored: HashMap<usize, Node<'a>>,
}

impl<'a> Events<'a> {
    /// The next event and its line.
    fn next(&mut self) -> Result<(Event<'a>, usize), Fault> {
        match self.parser.next_event() {
            Some(Ok((event, Span { start, .. }))) => Ok((event, start.line())),
            Some(Err(error)) => Fault::err(error.marker().line(), format!("not YAML: {}", error.info())),
            None => Fault::err(1, "not YAML: it ends early"),
        }
    }

    fn expect(&mut self, is_it: impl Fn(&Event<'_>) -> bool) -> Result<(), Fault> {
        let (event, line) = self.next()?;
        match is_it(&event) {
            true => Ok(()),
            false => Fault::err(line, "not YAML: expected another part of the document"),
        }
    }

    fn node(&mut self, (event, line): (Event<'a>, usize), depth: usize) -> Result<Node<'a>, Fault> {
        self.nodes += 1;
        if self.nodes > MAX_NODES {
            return Fault::err(line, format!("expected {MAX_NODES} values at most; found more"));
        }
        if depth > MAX_DEPTH {
            return Fault::err(line, format!("expected {MAX_DEPTH} levels at most; found more"));
        }
        let (kind, anchor) = match event {
            Event::Alias(anchor) => return self.alias(anchor, line, depth),
            Event::Scalar(text, style, anchor, None) => {
                let kind = match (style, self.language) {
                    (ScalarStyle::Plain, Language::Yaml) => Kind::Plain(text),
                    (ScalarStyle::Plain, Language::Json) => Kind::OfJson(text),
                    _ => Kind::Quoted(text),
                };
                (kind, anchor)
            }
            Event::SequenceStart(anchor, None) => (Kind::List(self.list(depth)?), anchor),
            Event::MappingStart(anchor, None) => (Kind::Table(self.table(depth)?), anchor),
            Event::Scalar(..) | Event::SequenceStart(..) | Event::MappingStart(..) => {
                return Fault::err(line, "expected a value; found a tag before it");
            }
            _ => return Fault::err(line, "expected a value; found the end"),
        };
        let node = Node { line, kind };
        // Anchors are numbered from 1.
        if anchor > 0 {
            self.anchored.insert(anchor, node.clone());
        }
        Ok(node)
    }

    /// The value that an alias stands for, with the lines of that value.
    fn alias(&mut self, anchor: usize, line: usize, depth: usize) -> Result<Node<'a>, Fault> {
        let Some(node) = self.anchored.get(&anchor) else {
            return Fault::err(line, "found an alias of a value that contains it");
        };
        let [count, below] = node.extent();
        self.nodes += count;
        if self.nodes > MAX_NODES || depth + below > MAX_DEPTH {
            return Fault::err(
                line,
                format!("expected {MAX_NODES} values and {MAX_DEPTH} levels at most, aliases written out; found more"),
            );
        }
        Ok(node.clone())
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
                other => return Fault::err(line, format!("expected a key; found {}", other.message())),
            };
            // No table of a message has many keys: a longer one is refused before its keys are compared for long.
            if all.len() == MAX_KEYS {
                return Fault::err(line, format!("expected {MAX_KEYS} keys at most; found more"));
            }
            if all.iter().any(|entry| entry.key == key) {
                return Fault::err(line, format!("the key {} stands twice", quoted(&told(&key))));
            }
            let event = self.next()?;
            let value = self.node(event, depth + 1)?;
            all.push(Entry { key, line, value });
        }
    }
}

/// Most keys of a table.
const MAX_KEYS: usize = 64;
