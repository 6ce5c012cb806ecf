//! Check that a value lies in a key's domain, and the message where it does not: the same for files and for edits.
//!
//! Also here: keys that do not exist; the word that was probably intended; checks of sections that a file states several times;
//! lines of a text by their numbers, and where a text states a key.

use crate::error::Problem;
use crate::keys::key::{Domain, Key};
use crate::keys::value::{describe, json_of};
use crate::keys::{KEYS, LISTS, List, own_name};
use platewash_kinematics::words::{is_hidden, rounded};
use platewash_workcell::surface::MOST_KNOTS;
use platewash_workcell::words::printable;
use serde_json::Value;
use std::collections::BTreeSet;
use toml::de::{DeTable, DeValue};

/// More plates than any job has.
const MOST_PLATES: u64 = 1000;

/// Significant digits of a length that is suggested.
const METRE_DIGITS: usize = 6;

/// Refuses a value that lies outside a key's domain; `found` puts it into words.
pub(crate) fn check(key: &Key, value: &Value, found: impl FnOnce() -> String) -> Result<(), Problem> {
    if fits(key.domain, value) {
        return Ok(());
    }
    Err(Problem::Value {
        key: key.path.to_owned(),
        expected: key.domain.describe(),
        found: found() + &intended_value_hint(key, value),
    })
}

/// Checks that a value lies in the domain; NaN and infinity, which are null here, never do.
fn fits(domain: Domain, value: &Value) -> bool {
    let text = value.as_str().is_some_and(|s| !s.trim().is_empty());
    match domain {
        Domain::Text => text && !value.as_str().is_some_and(|s| s.contains(is_hidden)),
        Domain::Path => text,
        Domain::Paths => value.as_array().is_some_and(|all| all.iter().all(Value::is_string)),
        Domain::Names => value
            .as_array()
            .is_some_and(|all| all.iter().all(|name| fits(Domain::Text, name))),
        Domain::Positions(least, most) => value.as_object().is_some_and(|all| {
            let is_name = |name: &str| !name.trim().is_empty() && !name.contains(is_hidden);
            let is_within = |v: &Value| v.as_f64().is_some_and(|v| (least..=most).contains(&v));
            all.iter().all(|(name, v)| is_name(name) && is_within(v))
        }),
        Domain::Word(words) => value.as_str().is_some_and(|s| words.contains(&s)),
        Domain::Bool => value.is_boolean(),
        Domain::Integer(least, most) => value.as_i64().is_some_and(|v| (least..=most).contains(&v)),
        Domain::Number(least, most) => value.as_f64().is_some_and(|v| (least..=most).contains(&v)),
        Domain::NumberAbove(above, most) => value.as_f64().is_some_and(|v| v > above && v <= most),
        Domain::Range(least, most) => {
            numbers(value).is_some_and(|v| matches!(v[..], [a, b] if least <= a && a < b && b <= most))
        }
        Domain::Joints(least, most) => several(value, 6, |v| (least..=most).contains(&v)),
        Domain::JointsAbove(above, most) => several(value, 6, |v| v > above && v <= most),
        Domain::Points(least, most) => value.as_array().is_some_and(|points| {
            let fine =
                |p: &Value| numbers(p).is_some_and(|v| v.len() == 2 && v.iter().all(|c| (least..=most).contains(c)));
            (1..=1000).contains(&points.len()) && points.iter().all(fine)
        }),
        Domain::PairAbove(above, most) => several(value, 2, |v| v > above && v <= most),
        Domain::Pair(least, most) => several(value, 2, |v| (least..=most).contains(&v)),
        Domain::Scale(least, most) => several(value, 3, |v| v != 0.0 && (least..=most).contains(&v)),
        Domain::Plates => value.as_str() == Some("all") || plates(value),
        Domain::Triple(least, most) => several(value, 3, |v| (least..=most).contains(&v)),
        Domain::TripleAbove(above, most) => several(value, 3, |v| v > above && v <= most),
        Domain::Knots(most_m, most_deg) => knots(value, [most_m, most_deg]),
    }
}

/// Hint on a value that fits if it was meant in millimetres or per cent, and on a word that is close to one of those expected.
fn intended_value_hint(key: &Key, value: &Value) -> String {
    if let (Domain::Word(words), Some(word)) = (key.domain, value.as_str()) {
        let nearest = nearest(&word.to_lowercase(), words.iter().copied()).filter(|_| words.len() > 1);
        return nearest.map_or_else(String::new, |word| format!("; did you mean \"{word}\"?"));
    }
    let (factor, expected, other) = match (key.unit, key.domain) {
        ("m", _) => (1e-3, "metres are expected", "millimetres were meant"),
        ("m/s", _) => (
            1e-3,
            "metres per second are expected",
            "millimetres per second were meant",
        ),
        ("", Domain::Number(0.0, 1.0) | Domain::NumberAbove(0.0, 1.0)) => {
            (1e-2, "a share of 1 is expected", "per cent were meant")
        }
        _ => return String::new(),
    };
    let scaled = |v: &Value| Some(rounded(factor * v.as_f64()?, METRE_DIGITS));
    let all = match value.as_array() {
        Some(all) => all.iter().map(scaled).collect::<Option<Vec<_>>>().map(Value::from),
        None => scaled(value).map(Value::from),
    };
    match all {
        Some(all) if fits(key.domain, &all) => format!(" ({expected}; {all} if {other})"),
        _ => String::new(),
    }
}

fn knots(value: &Value, [most_m, most_deg]: [f64; 2]) -> bool {
    let Some(knots) = value.as_array() else { return false };
    let mut before_m = 0.0;
    let mut fine = |knot: &Value| {
        let Some([radius_m, slope_deg]) = numbers(knot).and_then(|v| <[f64; 2]>::try_from(v).ok()) else {
            return false;
        };
        let grows = radius_m > before_m && radius_m <= most_m;
        before_m = radius_m;
        grows && slope_deg.abs() <= most_deg
    };
    (1..=MOST_KNOTS).contains(&knots.len()) && knots.iter().all(&mut fine)
}

fn plates(value: &Value) -> bool {
    let Some(all) = value.as_array() else { return false };
    let all: Option<Vec<_>> = all.iter().map(Value::as_u64).collect();
    all.is_some_and(|all| all.windows(2).all(|pair| pair[0] < pair[1]) && all.iter().all(|plate| *plate < MOST_PLATES))
}

fn several(value: &Value, count: usize, fine: impl Fn(f64) -> bool) -> bool {
    numbers(value).is_some_and(|v| v.len() == count && v.into_iter().all(fine))
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

/// Problem for a key that does not exist.
pub(crate) fn unknown(key: &str) -> Problem {
    let paths = || KEYS.iter().map(|key| key.path);
    let sections = paths().filter_map(|path| Some(path.split_once('.')?.0));
    let sections: BTreeSet<_> = sections.chain(LISTS.iter().map(|list| list.name)).collect();
    let hint = match key.split_once('.').filter(|(section, _)| sections.contains(section)) {
        Some((section, name)) => {
            let own: Vec<_> = paths()
                .filter_map(|path| path.strip_prefix(section)?.strip_prefix('.'))
                .collect();
            let elsewhere = paths().find(|path| path.split_once('.').is_some_and(|(_, other)| other == name));
            let in_full = |name: &str| format!("{section}.{name}");
            hint(name, &own, in_full, || match elsewhere {
                Some(path) => format!("did you mean '{path}'?"),
                None => format!("keys of [{section}]: {}", own.join(", ")),
            })
        }
        None => {
            let known: Vec<_> = sections.iter().copied().chain(paths()).collect();
            hint(key, &known, str::to_owned, || {
                let all: Vec<_> = sections.iter().copied().collect();
                format!("sections: {}", all.join(", "))
            })
        }
    };
    let key = printable(key);
    Problem::UnknownKey { key, hint }
}

/// Less like any word than this, nothing is suggested.
const LEAST_LIKENESS: f64 = 0.6;

/// Returns the most similar one of the known words, where it is similar enough.
pub(crate) fn nearest<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let ranked = known.map(|other| (strsim::normalized_damerau_levenshtein(other, word), other));
    let nearest = ranked.max_by(|a, b| a.0.total_cmp(&b.0));
    nearest
        .filter(|(likeness, _)| *likeness > LEAST_LIKENESS)
        .map(|(_, other)| other)
}

/// Hint on a name that does not exist among `known`, which `in_full` writes out. It names the radius for a diameter, otherwise
/// the most similar name, or else returns the text of `otherwise`.
pub(crate) fn hint(
    name: &str,
    known: &[&str],
    in_full: impl Fn(&str) -> String,
    otherwise: impl FnOnce() -> String,
) -> String {
    let of_radius = name.replace("diameter", "radius");
    if of_radius != name && known.contains(&&*of_radius) {
        return format!("half of it, the radius, is stated: '{}'", in_full(&of_radius));
    }
    nearest(name, known.iter().copied()).map_or_else(otherwise, |other| format!("did you mean '{}'?", in_full(other)))
}

/// Fault of a value, and its byte in the text.
pub(crate) type Misfit = (usize, Problem);

/// Checks a list of a file.
pub(crate) fn check_list(list: &List, value: &toml::Spanned<DeValue<'_>>) -> Result<(), Misfit> {
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
        check(key, &json_of(value.get_ref()), || describe(value.get_ref())).map_err(|problem| {
            let problem = match problem {
                Problem::Value { expected, found, .. } => Problem::Value {
                    key: format!("{}[{index}].{}", list.name, own_name(key)),
                    expected,
                    found,
                },
                other => other,
            };
            (value.span().start, problem)
        })?;
    }
    Ok(())
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

/// The line of a byte, from 1.
pub(crate) fn line_at(text: &str, byte: usize) -> usize {
    1 + text.as_bytes()[..byte.min(text.len())]
        .iter()
        .filter(|b| **b == b'\n')
        .count()
}

/// Byte at which a text states a key such as `layout.count` or `obstacle[1].name`. For a key that is left out it is the byte of
/// the section, where the section is one of a list or states something else. `None` where there is neither.
pub(crate) fn byte_of(table: &DeTable<'_>, key: &str) -> Option<usize> {
    let (first, rest) = key
        .split_once('.')
        .map_or((key, None), |(first, rest)| (first, Some(rest)));
    let (name, index) = match first.split_once('[') {
        Some((name, index)) => (name, index.trim_end_matches(']').parse::<usize>().ok()),
        None => (first, None),
    };
    let (stated, value) = table.iter().find(|(stated, _)| stated.get_ref() == name)?;
    let (at, value) = match (index, value.get_ref()) {
        (Some(index), DeValue::Array(all)) => all.get(index).map(|one| (one.span().start, one.get_ref()))?,
        (_, value) => (stated.span().start, value),
    };
    match (rest, value) {
        (Some(rest), DeValue::Table(section)) => byte_of(section, rest).or(Some(at)),
        _ => Some(at),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_a_key_in_its_line_or_its_section() {
        let text = "seed = 1\nlayout.count = 2\n[wash]\nturns = 1\n[[plate]]\ncount = 1\n\n[[plate]]\ncount = 2\n";
        let table = DeTable::parse(text).unwrap();
        let line = |key: &str| byte_of(table.get_ref(), key).map(|at| line_at(text, at));
        for (key, expected) in [
            ("seed", Some(1)),
            ("layout.count", Some(2)),
            ("wash.turns", Some(4)),
            ("wash.lift_m", Some(3)),
            ("plate[1].count", Some(9)),
            ("plate[1].at_m", Some(8)),
            ("plate[7].at_m", None),
            ("tool.length_m", None),
            ("", None),
            ("plate[x].count", Some(5)),
        ] {
            assert_eq!(line(key), expected, "{key}");
        }
    }
}
