//! How much a plan file states, counted before it is read: a file that states too much is refused at the cost of its text.

use super::error::PlanFileError;
use crate::layout::MAX_PLATES;
use serde::Deserialize;
use serde::de::{Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use std::fmt;

/// Most knots of a motion that is read: those of a thousand plates, twice.
const MOST_KNOTS: usize = 1_000_000;

/// Length of a text that is read without counting [bytes]: what it states takes some tens of megabytes.
const SMALL: usize = 2_000_000;

/// The lists of a plan that may be long.
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

/// Refuses a text with more plates or knots than are read. Whatever else is wrong with it is left to the reader.
pub(super) fn check(text: &str) -> Result<(), PlanFileError> {
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

/// How the message on a list that is too long begins.
const TOO_MANY: &str = "more than ";

fn plates<'de, D: Deserializer<'de>>(from: D) -> Result<(), D::Error> {
    let (name, most) = ("job.plates", MAX_PLATES);
    from.deserialize_seq(Count { name, most })
}

fn times<'de, D: Deserializer<'de>>(from: D) -> Result<(), D::Error> {
    let (name, most) = ("knots.t_s", MOST_KNOTS);
    from.deserialize_seq(Count { name, most })
}

/// Reads a list and keeps nothing of it, as long as it is no longer than `most`.
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
        check(text).err().map(|error| error.to_string())
    }

    #[test]
    fn long_lists_are_refused_and_everything_else_is_left_to_the_reader() {
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
