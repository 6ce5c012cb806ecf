//! Checks that a plan file contains exactly what is read from it.
//!
//! Reading alone is not strict enough: tagged and flattened types swallow unknown keys, missing keys of a scenario become defaults, and the
//! last one of repeated keys counts. The hash would then belong to other contents.
//!
//! The sizes of lists are counted before a file is read: a file with too long lists is refused at the cost of its text.

use crate::differences::{Difference, NOTHING, by_place};
use crate::plan::error::PlanFileError;
use platewash_workcell::job::MAX_SEED;
use platewash_workcell::json::JsonError;
use platewash_workcell::layout::MAX_PLATES;
use platewash_workcell::words::shortened;
use serde::de::{Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::fmt;

/// Greatest number of characters of a value in a message.
const LONGEST: usize = 60;

/// Checks that a text contains exactly what was read from it, given as canonical JSON in `written`.
///
/// # Errors
/// [`PlanFileError`] with the key.
pub(crate) fn check_contents(text: &str, written: &str, plan: &impl Serialize) -> Result<(), PlanFileError> {
    // As this program writes it there is nothing else in it.
    if written == text.trim_end() {
        return Ok(());
    }
    let unreadable = |e: serde_json::Error| JsonError { reason: e.to_string() };
    let said = serde_json::from_str(text).map_err(unreadable)?;
    if keys(&said) != keys_stated(text) {
        let reason = "a key is stated twice".to_owned();
        return Err(JsonError { reason }.into());
    }
    let read = serde_json::to_value(plan).map_err(unreadable)?;
    let all = by_place(&said, &read);
    // A key that is present tells more about a mistake than the one that is missing for it.
    let first = all.iter().find(|difference| difference.found != NOTHING);
    first.or(all.first()).map_or(Ok(()), |first| Err(refused(first)))
}

fn refused(Difference { key, found, expected }: &Difference) -> PlanFileError {
    let key = key.clone();
    let read = match (found.as_str(), expected.as_str()) {
        (NOTHING, _) => return PlanFileError::MissingKey { key },
        ("null", NOTHING) => "left out".to_owned(),
        (_, NOTHING) => return PlanFileError::UnknownKey { key },
        (_, whole) if whole.parse().is_ok_and(|whole: u64| whole > MAX_SEED) => {
            format!("a whole number from 0 to {MAX_SEED} (2^53 − 1)")
        }
        _ => shortened(expected, LONGEST),
    };
    let found = shortened(found, LONGEST);
    PlanFileError::Inexact { key, found, read }
}

/// Counts the keys of all tables of a value.
fn keys(value: &Value) -> usize {
    match value {
        Value::Object(table) => table.values().map(|value| 1 + keys(value)).sum(),
        Value::Array(list) => list.iter().map(keys).sum(),
        _ => 0,
    }
}

/// Counts the keys of all tables of a JSON text, repeated ones included, by the colons outside strings.
fn keys_stated(text: &str) -> usize {
    let (mut count, mut is_in_text, mut is_escaped) = (0, false, false);
    for byte in text.bytes() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' => is_escaped = true,
            b'"' => is_in_text = !is_in_text,
            b':' if !is_in_text => count += 1,
            _ => {}
        }
    }
    count
}

/// Greatest number of knots of a motion: twice those of a thousand plates.
const MOST_KNOTS: usize = 1_000_000;

/// Length of a text that is read without counting \[bytes\]. Its contents take some tens of megabytes.
const SMALL: usize = 2_000_000;

/// Lists of a plan that may be long.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Sizes {
    #[serde(rename = "job")]
    _job: Job,
    #[serde(rename = "knots")]
    _knots: Knots,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Job {
    #[serde(rename = "plates", deserialize_with = "plates")]
    _plates: (),
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Knots {
    #[serde(rename = "t_s", deserialize_with = "times")]
    _t_s: (),
}

/// Refuses a text with more plates or knots than are allowed. All other errors are left to the reader.
pub(crate) fn check_sizes(text: &str) -> Result<(), PlanFileError> {
    if text.len() <= SMALL {
        return Ok(());
    }
    let Err(error) = serde_json::from_str::<Sizes>(text) else {
        return Ok(());
    };
    match error.to_string() {
        words if words.starts_with(TOO_MANY) => Err(PlanFileError::TooLarge { detail: words }),
        _ => Ok(()),
    }
}

/// Start of the message on a list that is too long.
const TOO_MANY: &str = "more than ";

fn plates<'de, D: Deserializer<'de>>(from: D) -> Result<(), D::Error> {
    let (name, most) = ("job.plates", MAX_PLATES);
    from.deserialize_seq(Count { name, most })
}

fn times<'de, D: Deserializer<'de>>(from: D) -> Result<(), D::Error> {
    let (name, most) = ("knots.t_s", MOST_KNOTS);
    from.deserialize_seq(Count { name, most })
}

/// Reader of a list that keeps nothing of it and refuses more than `most` elements.
struct Count {
    name: &'static str,
    most: usize,
}

impl<'de> Visitor<'de> for Count {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let Self { name, most } = self;
        for _ in 0..most {
            if list.next_element::<IgnoredAny>()?.is_none() {
                return Ok(());
            }
        }
        match list.next_element::<IgnoredAny>()? {
            None => Ok(()),
            Some(_) => Err(A::Error::custom(format_args!("{TOO_MANY}{most} elements in '{name}'"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(text: &str) -> Option<String> {
        check_sizes(text).err().map(|error| error.to_string())
    }

    #[test]
    fn rejects_long_lists_alone() {
        let long = " ".repeat(SMALL);
        let plates = |count: usize| format!("{long}{{\"job\":{{\"plates\":[{}{{}}]}}}}", "{},".repeat(count - 1));
        assert_eq!(refused(&plates(MAX_PLATES)), None);
        let words = refused(&plates(MAX_PLATES + 1)).unwrap();
        assert!(words.contains("more than 1000 elements in 'job.plates'"), "{words}");
        let knots = format!("{{\"knots\":{{\"t_s\":[{}0]}}}}", "0,".repeat(MOST_KNOTS));
        assert!(
            refused(&knots)
                .unwrap()
                .contains("more than 1000000 elements in 'knots.t_s'")
        );
        for other in [
            "",
            "{",
            "[]",
            "{\"job\":1}",
            "{\"job\":{\"plates\":3}}",
            "{\"knots\":{\"t_s\":null}}",
        ] {
            assert_eq!(refused(&(long.clone() + other)), None, "{other}");
        }
    }
}
