//! The table of keys as data, for whoever draws a form of it.

use crate::key::Domain;
use crate::keys::KEYS;
use crate::scenario::Scenario;
use crate::values::values_of;
use serde::Serialize;
use serde_json::{Number, Value};

/// A row of the table of keys.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FormKey {
    /// Dotted path.
    pub path: &'static str,
    /// Unit; empty for none.
    pub unit: &'static str,
    /// Values it takes.
    pub domain: FormDomain,
    /// The domain in words, as messages and the reference print it.
    pub expected: String,
    /// What it means.
    pub meaning: &'static str,
    /// Its value where a file states none; `None` where there is none then.
    pub default: Option<Value>,
}

/// What a key's value may be.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FormDomain {
    /// The kind of [`Domain`], in lower case with underscores.
    pub kind: &'static str,
    /// The words that it can be, where it is one of some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub words: Option<&'static [&'static str]>,
    /// The least number; of kinds that end in `_above` it is not reached.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub least: Option<Number>,
    /// The greatest number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub most: Option<Number>,
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
    let bare = |kind| FormDomain {
        kind,
        words: None,
        least: None,
        most: None,
    };
    let between = |kind, least, most| FormDomain {
        least: Number::from_f64(least),
        most: Number::from_f64(most),
        ..bare(kind)
    };
    match domain {
        Domain::Text => bare("text"),
        Domain::Path => bare("path"),
        Domain::Paths => bare("paths"),
        Domain::Bool => bare("bool"),
        Domain::Word(words) => FormDomain {
            words: Some(words),
            ..bare("word")
        },
        Domain::Integer(least, most) => FormDomain {
            least: Some(least.into()),
            most: Some(most.into()),
            ..bare("integer")
        },
        Domain::Number(least, most) => between("number", least, most),
        Domain::NumberAbove(above, most) => between("number_above", above, most),
        Domain::Range(least, most) => between("range", least, most),
        Domain::Joints(least, most) => between("joints", least, most),
        Domain::JointsAbove(above, most) => between("joints_above", above, most),
        Domain::Points(least, most) => between("points", least, most),
        Domain::PairAbove(above, most) => between("pair_above", above, most),
        Domain::Pair(least, most) => between("pair", least, most),
        Domain::Scale(least, most) => between("triple", least, most),
        Domain::Plates => bare("text"),
        Domain::Triple(least, most) => between("triple", least, most),
        Domain::TripleAbove(above, most) => between("triple_above", above, most),
        // Pairs, too; which of them are knots is for the scenario to say.
        Domain::Knots(most_m, most_deg) => between("points", -most_m.max(most_deg), most_m.max(most_deg)),
    }
}
