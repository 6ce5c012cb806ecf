//! What a text states, in order, each with its place: sections and assignments, down to the commas of lists.
//!
//! The places are those of `toml_parser`, of which `toml` is made: what is found here is what is read.

use std::ops::Range;
use toml_parser::decoder::Encoding;
use toml_parser::parser::{Event, EventKind, parse_document};
use toml_parser::{Raw, Source, Span};

/// A line, or several, that state something.
#[derive(Debug)]
pub(super) struct Statement {
    /// Names of a section, or of a key within its section.
    pub path: Vec<String>,
    /// From the first letter of the key, or the bracket, to the end of the value, or the bracket.
    pub span: Range<usize>,
    pub kind: Kind,
}

/// What a statement states.
#[derive(Debug)]
pub(super) enum Kind {
    /// `[wash]`
    Section,
    /// `[[wash]]`
    ListedSection,
    /// `turns = 3`
    Assignment(Node),
}

/// A value in the text.
#[derive(Debug, Default)]
pub(super) struct Node {
    /// From its first letter to its last, brackets included.
    pub span: Range<usize>,
    pub inside: Inside,
}

/// What is inside of a value.
#[derive(Debug, Default)]
pub(super) enum Inside {
    #[default]
    Scalar,
    /// `[1, 2]`
    List(Vec<Item>),
    /// `{ turns = 3 }`
    Section(Vec<Item>),
}

/// An element of a list, or an assignment within braces.
#[derive(Debug)]
pub(super) struct Item {
    /// Names of its key; none in a list.
    pub path: Vec<String>,
    /// From the first letter of the key, if it has one, to the end of the value.
    pub span: Range<usize>,
    pub value: Node,
    /// The comma behind it.
    pub comma: Option<Range<usize>>,
}

impl Item {
    /// The end of it, or of the comma behind it.
    pub fn end(&self) -> usize {
        self.comma.as_ref().map_or(self.span.end, |comma| comma.end)
    }
}

/// All statements of a text that is valid TOML.
pub(super) fn statements(text: &str) -> Vec<Statement> {
    let tokens = Source::new(text).lex().into_vec();
    let mut events: Vec<Event> = Vec::with_capacity(tokens.len());
    parse_document(&tokens, &mut events, &mut ());
    let mut reader = Reader::default();
    for event in events {
        reader.take(text, &event);
    }
    reader.statements
}

#[derive(Default)]
struct Reader {
    statements: Vec<Statement>,
    /// The key, or section, that is being read.
    key: Key,
    /// Lists and braces that are open.
    open: Vec<Open>,
}

#[derive(Default)]
struct Key {
    path: Vec<String>,
    start: Option<usize>,
}

struct Open {
    /// The key whose value it is.
    key: Key,
    start: usize,
    items: Vec<Item>,
}

impl Reader {
    fn take(&mut self, text: &str, event: &Event) {
        let span = event.span();
        match event.kind() {
            EventKind::StdTableOpen | EventKind::ArrayTableOpen => self.key.start = Some(span.start()),
            EventKind::StdTableClose => self.section(Kind::Section, span.end()),
            EventKind::ArrayTableClose => self.section(Kind::ListedSection, span.end()),
            EventKind::SimpleKey => {
                self.key.start.get_or_insert(span.start());
                self.key.path.push(name(text, span, event.encoding()));
            }
            EventKind::Scalar => self.value(span.start()..span.end(), Inside::Scalar),
            EventKind::ArrayOpen | EventKind::InlineTableOpen => self.open.push(Open {
                key: std::mem::take(&mut self.key),
                start: span.start(),
                items: Vec::new(),
            }),
            EventKind::ArrayClose => self.close(Inside::List, span.end()),
            EventKind::InlineTableClose => self.close(Inside::Section, span.end()),
            EventKind::ValueSep => {
                if let Some(item) = self.open.last_mut().and_then(|open| open.items.last_mut()) {
                    item.comma = Some(span.start()..span.end());
                }
            }
            _ => {}
        }
    }

    fn section(&mut self, kind: Kind, end: usize) {
        let key = std::mem::take(&mut self.key);
        self.statements.push(Statement {
            path: key.path,
            span: key.start.unwrap_or(end)..end,
            kind,
        });
    }

    fn close(&mut self, inside: fn(Vec<Item>) -> Inside, end: usize) {
        if let Some(open) = self.open.pop() {
            self.key = open.key;
            self.value(open.start..end, inside(open.items));
        }
    }

    fn value(&mut self, span: Range<usize>, inside: Inside) {
        let key = std::mem::take(&mut self.key);
        let whole = key.start.unwrap_or(span.start)..span.end;
        let value = Node { span, inside };
        match self.open.last_mut() {
            Some(open) => open.items.push(Item {
                path: key.path,
                span: whole,
                value,
                comma: None,
            }),
            None => self.statements.push(Statement {
                path: key.path,
                span: whole,
                kind: Kind::Assignment(value),
            }),
        }
    }
}

fn name(text: &str, span: Span, encoding: Option<Encoding>) -> String {
    let raw = text.get(span.start()..span.end()).unwrap_or_default();
    let mut name = String::new();
    Raw::new_unchecked(raw, encoding, span).decode_key(&mut name, &mut ());
    name
}
