//! The table of keys as data, for programs that draw a form of it.

use crate::keys::key::Domain;
use crate::keys::table::KEYS;
use crate::keys::value::values_of;
use crate::scenario::Scenario;
use serde::Serialize;
use serde_json::Value;
use ts_rs::TS;

/// A row of the table of keys.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct FormKey {
    /// Dotted path.
    pub path: &'static str,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// Values it takes.
    pub domain: FormDomain,
    /// The domain in words, as messages and the reference print it.
    pub expected: String,
    /// Meaning of the key.
    pub meaning: &'static str,
    /// Its value where a file states none; `None` where it has no default.
    #[ts(type = "Value | null")]
    pub default: Option<Value>,
}

/// Domain of a key's values, with the control that it asks for.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum FormDomain {
    /// Text.
    Text,
    /// A path.
    Path,
    /// Paths or names, which are typed alike.
    Paths,
    /// `true` or `false`.
    Bool,
    /// One of some words.
    Word {
        /// The words.
        words: &'static [&'static str],
    },
    /// A whole number.
    Integer {
        /// The least one.
        least: i64,
        /// The greatest one.
        most: i64,
    },
    /// A number.
    Number(FormRange),
    /// A number above the least one.
    NumberAbove(FormRange),
    /// Two numbers, the first below the second.
    Range(FormRange),
    /// Six numbers.
    Joints(FormRange),
    /// Six numbers, each above the least one.
    JointsAbove(FormRange),
    /// Two numbers.
    Pair(FormRange),
    /// Two numbers, each above the least one.
    PairAbove(FormRange),
    /// Three numbers.
    Triple(FormRange),
    /// Three numbers, each above the least one.
    TripleAbove(FormRange),
    /// Pairs of numbers; which of them are knots is for the scenario to say.
    Points(FormRange),
    /// Numbers by name.
    Positions(FormRange),
}

/// Range of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, TS)]
pub struct FormRange {
    /// The least number; of kinds that end in `_above` it is not reached.
    pub least: f64,
    /// The greatest number.
    pub most: f64,
}

/// Every key, in the order of the reference.
#[must_use]
pub fn form() -> Vec<FormKey> {
    let mut defaults = values_of(&Scenario::default());
    let rows = KEYS.iter().map(|key| FormKey {
        path: key.path,
        unit: key.unit,
        domain: form_domain(key.domain),
        expected: key.domain.describe(),
        meaning: key.meaning,
        default: defaults.remove(key.path),
    });
    rows.collect()
}

fn form_domain(domain: Domain) -> FormDomain {
    let range = |least, most| FormRange { least, most };
    match domain {
        Domain::Text | Domain::Plates => FormDomain::Text,
        Domain::Path => FormDomain::Path,
        Domain::Paths | Domain::Names => FormDomain::Paths,
        Domain::Positions(least, most) => FormDomain::Positions(range(least, most)),
        Domain::Bool => FormDomain::Bool,
        Domain::Word(words) => FormDomain::Word { words },
        Domain::Integer(least, most) => FormDomain::Integer { least, most },
        Domain::Number(least, most) => FormDomain::Number(range(least, most)),
        Domain::NumberAbove(above, most) => FormDomain::NumberAbove(range(above, most)),
        Domain::Range(least, most) => FormDomain::Range(range(least, most)),
        Domain::Joints(least, most) => FormDomain::Joints(range(least, most)),
        Domain::JointsAbove(above, most) => FormDomain::JointsAbove(range(above, most)),
        Domain::Points(least, most) => FormDomain::Points(range(least, most)),
        Domain::PairAbove(above, most) => FormDomain::PairAbove(range(above, most)),
        Domain::Pair(least, most) => FormDomain::Pair(range(least, most)),
        Domain::Triple(least, most) | Domain::Scale(least, most) => FormDomain::Triple(range(least, most)),
        Domain::TripleAbove(above, most) => FormDomain::TripleAbove(range(above, most)),
        Domain::Knots(most_m, most_deg) => FormDomain::Points(range(-most_m.max(most_deg), most_m.max(most_deg))),
    }
}
