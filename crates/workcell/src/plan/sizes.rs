//! How much a plan file states, counted before it is read: a file that states too much is refused at the cost of its text.

use super::error::PlanFileError;
use crate::layout::MAX_PLATES;
use serde::Deserialize;
use serde::de::{Deserializer, Error, IgnoredAny, SeqAccess, Visitor};
use std::fmt;

/// Most knots of a motion that is read: those of a thousand plates, twice.
const MOST_KNOTS: usize = 1_000_000;

/// The lists of a plan that may be long.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Sizes {
    job: Job,
    knots: Knots,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Job {
    plates: Count<MAX_PLATES>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Knots {
    t_s: Count<MOST_KNOTS>,
}

/// Refuses a text with more plates or knots than are read. Whatever else is wrong with it is left to the reader.
pub(super) fn check(text: &str) -> Result<(), PlanFileError> {
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

/// A list of at most so many elements, whatever they are.
#[derive(Default)]
struct Count<const MOST: usize>;

impl<'de, const MOST: usize> Deserialize<'de> for Count<MOST> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_seq(Self)
    }
}

impl<'de, const MOST: usize> Visitor<'de> for Count<MOST> {
    type Value = Self;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self, A::Error> {
        let mut found = 0;
        while list.next_element::<IgnoredAny>()?.is_some() {
            found += 1;
            if found > MOST {
                return Err(A::Error::custom(format_args!("{TOO_MANY}{MOST} elements")));
            }
        }
        Ok(self)
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
        let plates = |count: usize| format!("{{\"job\":{{\"plates\":[{}{{}}]}}}}", "{},".repeat(count - 1));
        assert_eq!(refused(&plates(MAX_PLATES)), None);
        let words = refused(&plates(MAX_PLATES + 1)).unwrap();
        assert!(words.contains("more than 1000 elements"), "{words}");
        let knots = format!("{{\"knots\":{{\"t_s\":[{}0]}}}}", "0,".repeat(MOST_KNOTS));
        assert!(refused(&knots).unwrap().contains("more than 1000000 elements"));
        for other in [
            "",
            "{",
            "[]",
            "{\"job\":1}",
            "{\"job\":{\"plates\":3}}",
            "{\"knots\":{\"t_s\":null}}",
        ] {
            assert_eq!(refused(other), None, "{other}");
        }
    }
}
