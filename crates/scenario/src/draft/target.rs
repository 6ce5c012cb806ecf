//! Key of a text that is changed: one of the table, as `wash.turns`, or one in a section of a list, as `plate[1].at_m`.

use crate::draft::edit_error::EditError;
use crate::keys::fits::check;
use crate::keys::key::{Domain, Key, own_name};
use crate::keys::table::{KEYS, LISTS, List};
use crate::keys::unknown::unknown;
use crate::keys::value::describe_json;
use serde_json::Value;

/// A key that is changed.
pub(crate) struct Target {
    /// Its row of a table of keys.
    pub key: &'static Key,
    /// The list and, from 0, which of its sections it is in; none for keys of the table.
    pub row: Option<(&'static str, usize)>,
}

impl Target {
    /// The key of a path; `None` where there is no such key.
    pub fn parse(path: &str) -> Option<Self> {
        if let Some(key) = KEYS.iter().find(|key| key.path == path) {
            return Some(Self { key, row: None });
        }
        let (section, own) = path.split_once('.')?;
        let (list, index) = row(section)?;
        let key = list.keys.iter().find(|key| own_name(key) == own)?;
        let row = Some((list.name, index));
        Some(Self { key, row })
    }

    /// The key that a path names, and a value as the key takes it: JSON has one type of numbers, so that where a whole one is wanted, one
    /// with a point is as good.
    pub fn with_value(path: &str, value: Option<&Value>) -> Result<(Self, Option<Value>), EditError> {
        /// Up to here all whole numbers are there \[2^53\].
        const EXACT: f64 = 9_007_199_254_740_992.0;
        let target = Self::parse(path).ok_or_else(|| EditError::Refused(unknown(path)))?;
        let Some(value) = value else {
            return Ok((target, None));
        };
        let value = match value.as_f64() {
            Some(v) if matches!(target.key.domain, Domain::Integer(..)) && v.fract() == 0.0 && v.abs() < EXACT => {
                Value::from(v as i64)
            }
            _ => value.clone(),
        };
        check(target.key, || target.path(), &value, || describe_json(&value)).map_err(EditError::Refused)?;
        Ok((target, Some(value)))
    }

    /// Full name of the key.
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
}

/// The list and the index of a section, as `obstacle[0]`; `None` for anything else.
pub(crate) fn row(section: &str) -> Option<(&'static List, usize)> {
    let (name, index) = section.strip_suffix(']')?.split_once('[')?;
    let list = LISTS.iter().find(|list| list.name == name)?;
    // No sign, and one way to write a number.
    let index = index.parse().ok().filter(|k: &usize| k.to_string() == index)?;
    Some((list, index))
}
