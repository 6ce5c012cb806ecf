//! Which key of a text is changed: one of the table, as `wash.turns`, or one in a section of a list, as `plate[1].at_m`.

use super::place::{Place, place};
use super::row::place_in_row;
use super::statement::Statement;
use crate::error::Problem;
use crate::key::Key;
use crate::keys::KEYS;
use crate::lists::{LISTS, own_name};

/// A key that is changed.
pub(super) struct Target {
    /// Its row of a table of keys.
    pub key: &'static Key,
    /// The list and, from 0, which of its sections it is in; none for keys of the table.
    pub row: Option<(&'static str, usize)>,
}

impl Target {
    /// That of a path; none where there is no such key.
    pub fn of(path: &str) -> Option<Self> {
        if let Some(key) = KEYS.iter().find(|key| key.path == path) {
            return Some(Self { key, row: None });
        }
        let (name, rest) = path.split_once('[')?;
        let (index, own) = rest.split_once("].")?;
        let list = LISTS.iter().find(|list| list.name == name)?;
        let key = list.keys.iter().find(|key| own_name(key) == own)?;
        // No sign, and one way to write a number.
        let index = index.parse().ok().filter(|k: &usize| k.to_string() == index)?;
        let row = Some((list.name, index));
        Some(Self { key, row })
    }

    /// What it is called.
    pub fn path(&self) -> String {
        match self.row {
            Some((list, index)) => format!("{list}[{index}].{}", self.name()),
            None => self.key.path.to_owned(),
        }
    }

    /// Its name in its section.
    pub fn name(&self) -> &'static str {
        own_name(self.key)
    }

    /// Its section, if it has one.
    pub fn section(&self) -> Option<&'static str> {
        self.key.path.rsplit_once('.').map(|(section, _)| section)
    }

    /// Where it stands in a text, or would go.
    pub fn place<'a>(&self, statements: &'a [Statement]) -> Place<'a> {
        match self.row {
            Some(row) => place_in_row(statements, row, self.name()),
            None => place(statements, self.section(), self.name()),
        }
    }

    /// A problem with its value, under the name that it has here.
    pub fn of_problem(&self, problem: Problem) -> Problem {
        match problem {
            Problem::Value { expected, found, .. } => Problem::Value {
                key: self.path(),
                expected,
                found,
            },
            other => other,
        }
    }
}
