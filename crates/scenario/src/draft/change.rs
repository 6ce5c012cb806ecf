//! What changes in a text where a key gets a value, or loses it.

use super::error::EditError;
use super::lines::{self, Splices};
use super::list;
use super::merge::{fresh, merge};
use super::place::Place;
use super::statement::{Kind, Statement, statements};
use super::target::Target;
use crate::keys::KEYS;
use crate::line::line_at;
use crate::write::on_one_line;
use serde_json::Value;

/// Longest part of a line that is quoted in a message.
const LONGEST: usize = 40;

/// What changes where a key gets a value that it takes.
pub(super) fn set(text: &str, target: &Target, value: &Value) -> Result<Splices, EditError> {
    let statements = statements(text);
    let (section, name, domain) = (target.section(), target.name(), target.key.domain);
    Ok(match target.place(&statements) {
        Place::Line { statement, value: old } => {
            let indent = lines::indent(text, statement.span.start);
            merge(text, old, domain, value, Some(indent))
        }
        Place::Braces { items, at, .. } => merge(text, &items[at].value, domain, value, None),
        Place::Behind { statement, dotted } => {
            let indent = lines::indent(text, statement.span.start);
            let name = if dotted { target.key.path } else { name };
            let at = lines::tail(text, statement.span.end);
            let value = fresh(text, domain, value, Some(indent));
            vec![(at..at, format!("{}{indent}{name} = {value}", lines::newline(text)))]
        }
        Place::Within { braces, items } => {
            let new = format!("{name} = {}", on_one_line(value));
            if text[braces.span.start + 1..braces.span.end - 1].trim().is_empty() {
                vec![(braces.span.clone(), format!("{{ {new} }}"))]
            } else {
                list::insert(text, braces, items, items.len(), &[new])
            }
        }
        Place::Top => {
            let new = format!("{name} = {}", fresh(text, domain, value, Some("")));
            block(text, &new, statements.first())
        }
        Place::NoSection => {
            if let Some((list, _)) = target.row {
                let key = target.path();
                return Err(EditError::NoRow { key, list });
            }
            let value = fresh(text, domain, value, Some(""));
            let new = format!(
                "[{}]{}{name} = {value}",
                section.unwrap_or_default(),
                lines::newline(text)
            );
            block(text, &new, following(&statements, section))
        }
        Place::Blocked { by } => return Err(blocked(text, target, by)),
    })
}

/// What changes where a key is taken out.
pub(super) fn remove(text: &str, target: &Target) -> Result<Splices, EditError> {
    let statements = statements(text);
    Ok(match target.place(&statements) {
        Place::Line { statement, .. } => {
            let mut start = lines::start(text, statement.span.start);
            let end = lines::next(text, statement.span.end);
            let last = end == text.len() && !text.ends_with('\n');
            if last && start > lines::first(text) {
                // What is the last line then has no end, either.
                start = lines::end(text, start - 1);
            }
            vec![(start..end, String::new())]
        }
        Place::Braces { braces, items, at } => list::remove(text, braces, items, at..at + 1),
        Place::Blocked { by } => return Err(blocked(text, target, by)),
        Place::Behind { .. } | Place::Within { .. } | Place::Top | Place::NoSection => Vec::new(),
    })
}

fn section_of(path: &str) -> Option<&str> {
    path.rsplit_once('.').map(|(section, _)| section)
}

/// The section in the text that a new one goes before, in the order of the table of keys; none where it goes to the end.
fn following<'a>(statements: &'a [Statement], section: Option<&str>) -> Option<&'a Statement> {
    let rank = |section: Option<&str>| KEYS.iter().position(|key| section_of(key.path) == section);
    let own = rank(section);
    let headers: Vec<_> = statements
        .iter()
        .filter(|s| !matches!(s.kind, Kind::Assignment(_)))
        .map(|s| (s, rank(s.path.first().map(String::as_str))))
        .collect();
    let before = headers.iter().filter(|(_, rank)| rank.is_some() && *rank < own);
    let Some(nearest) = before.map(|(_, rank)| *rank).max() else {
        return headers.iter().find(|(_, rank)| rank.is_some()).map(|(s, _)| *s);
    };
    let last = headers.iter().rposition(|(_, rank)| *rank == nearest)?;
    headers.get(last + 1).map(|(s, _)| *s)
}

/// Lines with a blank one on either side, before a statement and the comments that lead to it, or at the end.
fn block(text: &str, new: &str, before: Option<&Statement>) -> Splices {
    let newline = lines::newline(text);
    let first = lines::first(text);
    let at = before.map_or(text.len(), |statement| lines::lead(text, statement.span.start));
    let ended = at == first || text[..at].ends_with('\n');
    let blank = at == first || (ended && lines::is_blank(text, lines::start(text, at - 1)));
    let mut block = String::new();
    if !ended {
        block.push_str(newline);
    }
    if !blank {
        block.push_str(newline);
    }
    block.push_str(new);
    if ended {
        block.push_str(newline);
    }
    if before.is_some() {
        block.push_str(newline);
    }
    vec![(at..at, block)]
}

fn blocked(text: &str, target: &Target, by: &Statement) -> EditError {
    let found = &text[by.span.start..lines::end(text, by.span.start)];
    let found = found
        .char_indices()
        .nth(LONGEST)
        .map_or(found, |(end, _)| &found[..end]);
    EditError::Blocked {
        key: target.path(),
        line: line_at(text, by.span.start),
        found: found.to_owned(),
    }
}
