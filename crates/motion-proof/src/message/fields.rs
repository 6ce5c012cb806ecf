//! Values of a message by their kind: tables with known keys, lists, texts and numbers.

use crate::message::node::{Entry, Fault, Kind, Node};
use crate::message::number::{self, ParsedNumber};
use platewash_workcell::words::quoted;

/// The words on a joint that is named twice.
pub fn again(name: &str) -> String {
    format!("expected each joint once; found {} again", quoted(name))
}

/// A text: in quotes, or a word that no reader takes for anything else.
pub fn text(node: &Node<'_>) -> Result<String, Fault> {
    match &node.kind {
        Kind::Quoted(text) => Ok(text.to_string()),
        Kind::Plain(text) if is_word(text) => Ok(text.to_string()),
        _ => node.unexpected("a text"),
    }
}

fn is_word(text: &str) -> bool {
    const OTHERS: [&str; 9] = ["y", "n", "yes", "no", "on", "off", "true", "false", "null"];
    let named = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '/' | '.');
    text.starts_with(|c: char| c.is_ascii_alphabetic())
        && text.chars().all(named)
        && !OTHERS.contains(&text.to_ascii_lowercase().as_str())
}

pub fn list<'n, 'a>(node: &'n Node<'a>) -> Result<&'n [Node<'a>], Fault> {
    match &node.kind {
        Kind::List(nodes) => Ok(nodes),
        _ => node.unexpected("a list"),
    }
}

pub fn parse_number(node: &Node<'_>) -> ParsedNumber {
    match &node.kind {
        Kind::Plain(text) | Kind::OfJson(text) => number::read(text),
        _ => ParsedNumber::Nothing,
    }
}

pub fn entries<'n, 'a>(node: &'n Node<'a>, what: &str) -> Result<&'n [Entry<'a>], Fault> {
    match &node.kind {
        Kind::Table(entries) => Ok(entries),
        _ => node.unexpected(what),
    }
}

/// A table whose keys are known.
pub struct Fields<'n, 'a> {
    pub node: &'n Node<'a>,
    what: &'static str,
}

impl<'n, 'a> Fields<'n, 'a> {
    pub fn new(node: &'n Node<'a>, what: &'static str, known: &[&str]) -> Result<Self, Fault> {
        let entries = entries(node, what)?;
        match entries.iter().find(|entry| !known.contains(&entry.key.as_ref())) {
            Some(entry) => {
                let found = quoted(&Kind::Plain(entry.key.clone()).message());
                let reason = format!("expected {what} with {}; found the key {found}", known.join(", "));
                Fault::err(entry.line, reason)
            }
            None => Ok(Self { node, what }),
        }
    }

    pub fn get(&self, key: &str) -> Option<&'n Node<'a>> {
        self.node.get(key)
    }

    pub fn needed(&self, key: &str) -> Result<&'n Node<'a>, Fault> {
        let missing = || {
            self.node
                .refused(format!("expected {} with {key}; it is missing", self.what))
        };
        self.get(key).map_or_else(missing, Ok)
    }
}
