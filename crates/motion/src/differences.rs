//! Differences between two values, field by field, in their JSON form.

use platewash_workcell::job::MAX_SEED;
use platewash_workcell::words::{printable, shortened};
use serde::Serialize;
use serde_json::{Number, Value};
use std::collections::BTreeSet;

/// Greatest number of characters of a value in a difference.
const LONGEST: usize = 80;

/// Text for a missing value. A string with that text has quotes.
pub(crate) const NOTHING: &str = "nothing";

/// Field in which two values differ.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, thiserror::Error)]
#[error("{}: {}; expected {}", printable(.key), printable(.found), printable(.expected))]
pub struct Difference {
    /// Path of the field, e.g. `plates[2].pose.position_m[0]`.
    pub key: String,
    /// Value found, as JSON; `nothing` if it is missing.
    pub found: String,
    /// Value expected, as JSON.
    pub expected: String,
}

/// Returns every field in which the value found differs from the one expected, ordered by name. In lists of elements with names, or pairs
/// of names, an added or missing element is one difference, at any position.
#[must_use]
pub fn differences<T: Serialize>(found: &T, expected: &T) -> Vec<Difference> {
    let [found, expected] = [found, expected].map(|value| serde_json::to_value(value).unwrap_or(Value::Null));
    DifferenceList::between(&found, &expected, true)
}

/// Same as [`differences`] for two JSON values; list elements are matched by position alone.
pub(crate) fn by_place(found: &Value, expected: &Value) -> Vec<Difference> {
    DifferenceList::between(found, expected, false)
}

/// Comparison of two values so far.
struct DifferenceList {
    by_name: bool,
    all: Vec<Difference>,
}

impl DifferenceList {
    fn between(found: &Value, expected: &Value, by_name: bool) -> Vec<Difference> {
        let mut compared = Self {
            by_name,
            all: Vec::new(),
        };
        compared.field("", Some(found), Some(expected));
        compared.all
    }

    fn field(&mut self, key: &str, found: Option<&Value>, expected: Option<&Value>) {
        match (found, expected) {
            (Some(Value::Object(found)), Some(Value::Object(expected))) => {
                let dot = if key.is_empty() { "" } else { "." };
                for name in found.keys().chain(expected.keys()).collect::<BTreeSet<_>>() {
                    let inside = format!("{key}{dot}{}", name.escape_debug());
                    self.field(&inside, found.get(name), expected.get(name));
                }
            }
            (Some(Value::Array(found)), Some(Value::Array(expected))) => self.lists(key, found, expected),
            (Some(Value::Number(found)), Some(Value::Number(expected))) if same(found, expected) => {}
            _ if found == expected && !found.is_some_and(Value::is_number) => {}
            _ => self.all.push(Difference {
                key: key.to_owned(),
                found: value_text(found),
                expected: value_text(expected),
            }),
        }
    }

    fn lists(&mut self, key: &str, found: &[Value], expected: &[Value]) {
        let Some([ours, theirs]) = self.labels(found, expected) else {
            for i in 0..found.len().max(expected.len()) {
                self.field(&format!("{key}[{i}]"), found.get(i), expected.get(i));
            }
            return;
        };
        let of = |labels: &[String], label| labels.iter().position(|other| other == label);
        for label in ours.iter().chain(&theirs).collect::<BTreeSet<_>>() {
            let found = of(&ours, label).and_then(|at| found.get(at));
            let expected = of(&theirs, label).and_then(|at| expected.get(at));
            self.field(&format!("{key}[{label}]"), found, expected);
        }
        let in_order = |labels: &[String], others: &[String]| {
            let both = labels.iter().filter(|label| others.contains(label)).cloned();
            both.collect::<Vec<_>>().join(", ")
        };
        let (found, expected) = (in_order(&ours, &theirs), in_order(&theirs, &ours));
        if found != expected {
            self.all.push(Difference {
                key: format!("order of {key}"),
                found: shortened(&found, LONGEST),
                expected: shortened(&expected, LONGEST),
            });
        }
    }

    /// Returns the labels that identify the elements of two lists: their names or pairs of names, where each is unique.
    fn labels(&self, found: &[Value], expected: &[Value]) -> Option<[Vec<String>; 2]> {
        let label = |value: &Value| value.get("name").or_else(|| value.get("pair")).map(Value::to_string);
        let labels = |list: &[Value]| {
            let labels: Vec<String> = list.iter().map(label).collect::<Option<_>>()?;
            let different: BTreeSet<_> = labels.iter().collect();
            (different.len() == labels.len()).then_some(labels)
        };
        let both = self.by_name.then(|| labels(found).zip(labels(expected)));
        both.flatten().map(|(ours, theirs)| [ours, theirs])
    }
}

/// Checks that two numbers are the same JSON number. Where a whole number is expected, it must be one that JSON represents exactly (RFC
/// 8785: numbers are doubles); seeds are bounded for that reason.
fn same(found: &Number, expected: &Number) -> bool {
    match expected.as_u64() {
        Some(whole) if !found.is_f64() => found.as_u64() == Some(whole) && whole <= MAX_SEED,
        _ => found.as_f64() == expected.as_f64(),
    }
}

/// Returns the beginning of a value.
fn value_text(value: Option<&Value>) -> String {
    shortened(&value.map_or_else(|| NOTHING.to_owned(), Value::to_string), LONGEST)
}
