//! Where a key stands in a text, or would go.

use super::statement::{Inside, Item, Kind, Node, Statement};

/// Where a key stands, or would go.
pub(super) enum Place<'a> {
    /// In a statement of its own.
    Line { statement: &'a Statement, value: &'a Node },
    /// Within braces: which of these assignments.
    Braces {
        braces: &'a Node,
        items: &'a [Item],
        at: usize,
    },
    /// Nowhere; behind this statement of its section, with its section's name before it or not.
    Behind { statement: &'a Statement, dotted: bool },
    /// Nowhere; within these braces.
    Within { braces: &'a Node, items: &'a [Item] },
    /// Nowhere; at the top level, which has no keys yet.
    Top,
    /// Nowhere; its section is not there.
    NoSection,
    /// Something stands where it would go.
    Blocked { by: &'a Statement },
}

/// Where the key of a section, of the top level without one, stands in a text.
pub(super) fn place<'a>(statements: &'a [Statement], section: Option<&str>, name: &str) -> Place<'a> {
    let path: Vec<&str> = section.into_iter().chain([name]).collect();
    let mut last = None;
    let mut within: &[String] = &[];
    for statement in statements {
        let value = match &statement.kind {
            Kind::Section | Kind::ListedSection => {
                within = &statement.path;
                if begins(within, &path) || (equals(within, section) && matches!(statement.kind, Kind::ListedSection)) {
                    return Place::Blocked { by: statement };
                }
                if equals(within, section) {
                    last = Some((statement, false));
                }
                continue;
            }
            Kind::Assignment(value) => value,
        };
        let full: Vec<&str> = within.iter().chain(&statement.path).map(String::as_str).collect();
        if full == path {
            return Place::Line { statement, value };
        }
        if full.starts_with(&path) {
            return Place::Blocked { by: statement };
        }
        match section {
            Some(section) if full == [section] => return in_braces(statement, value, name),
            Some(section) if full.first() == Some(&section) && within.len() <= 1 => {
                last = Some((statement, within.is_empty()));
            }
            None if within.is_empty() => last = Some((statement, false)),
            _ => {}
        }
    }
    match (last, section) {
        (Some((statement, dotted)), _) => Place::Behind { statement, dotted },
        (None, Some(_)) => Place::NoSection,
        (None, None) => Place::Top,
    }
}

pub(super) fn in_braces<'a>(statement: &'a Statement, braces: &'a Node, name: &str) -> Place<'a> {
    let Inside::Section(items) = &braces.inside else {
        return Place::Blocked { by: statement };
    };
    match items.iter().position(|item| begins(&item.path, &[name])) {
        Some(at) if items[at].path.len() == 1 => Place::Braces { braces, items, at },
        Some(_) => Place::Blocked { by: statement },
        None => Place::Within { braces, items },
    }
}

fn begins(path: &[String], with: &[&str]) -> bool {
    path.len() >= with.len() && path.iter().zip(with).all(|(a, b)| a == b)
}

fn equals(path: &[String], section: Option<&str>) -> bool {
    matches!((path, section), ([name], Some(section)) if name == section)
}
