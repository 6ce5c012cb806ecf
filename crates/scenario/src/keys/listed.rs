//! Checks of sections that a file may state several times.

use crate::error::Problem;
use crate::keys::fits::check;
use crate::keys::key::{Key, own_name};
use crate::keys::table::List;
use crate::keys::unknown::hint;
use crate::keys::value::{describe, json_of};
use platewash_workcell::words::printable;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Fault of a value, and its byte in the text.
pub(crate) type Misfit = (usize, Problem);

/// Checks a list of a file.
pub(crate) fn check_list(list: &List, value: &Spanned<DeValue<'_>>) -> Result<(), Misfit> {
    let misfit = |found: String| {
        let problem = Problem::Value {
            key: list.name.to_owned(),
            expected: format!(
                "a list of at most {} sections: write [[{}]] for each",
                list.most, list.name
            ),
            found,
        };
        (value.span().start, problem)
    };
    let DeValue::Array(sections) = value.get_ref() else {
        return Err(misfit(describe(value.get_ref())));
    };
    if sections.len() > list.most {
        return Err(misfit(format!("{} of them", sections.len())));
    }
    for (index, section) in sections.iter().enumerate() {
        match section.get_ref() {
            DeValue::Table(table) => check_section(list, index, table)?,
            found => return Err((section.span().start, misfit(describe(found)).1)),
        }
    }
    Ok(())
}

fn check_section(list: &List, index: usize, table: &DeTable<'_>) -> Result<(), Misfit> {
    for (name, value) in table {
        let Some(key) = list.keys.iter().find(|key| own_name(key) == name.get_ref()) else {
            return Err((name.span().start, unknown_in_list(list, index, name.get_ref())));
        };
        check_value(key, || format!("{}[{index}].{}", list.name, own_name(key)), value)?;
    }
    Ok(())
}

/// Refuses a value that lies outside the domain of its key, which the text states as `path`.
pub(crate) fn check_value(
    key: &Key,
    path: impl FnOnce() -> String,
    value: &Spanned<DeValue<'_>>,
) -> Result<(), Misfit> {
    let found = || describe(value.get_ref());
    check(key, path, &json_of(value.get_ref()), found).map_err(|problem| (value.span().start, problem))
}

/// Problem for a key that does not exist in a section of a list, counted from 0.
fn unknown_in_list(list: &List, index: usize, name: &str) -> Problem {
    let of_list = |name: &str| format!("{}[{index}].{name}", list.name);
    let known: Vec<_> = list.keys.iter().map(own_name).collect();
    let otherwise = || format!("keys of [[{}]]: {}", list.name, known.join(", "));
    Problem::UnknownKey {
        key: of_list(&printable(name)),
        hint: hint(name, &known, of_list, otherwise),
    }
}
