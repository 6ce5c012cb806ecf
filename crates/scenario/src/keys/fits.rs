//! Check that a value lies in a key's domain, and the message where it does not: the same for files and for edits.

use crate::error::Problem;
use crate::keys::key::{Domain, Key};
use crate::keys::likeness::nearest;
use platewash_kinematics::words::{is_hidden, rounded};
use platewash_workcell::surface::MOST_KNOTS;
use serde_json::Value;

/// More plates than any job has.
const MOST_PLATES: u64 = 1000;

/// Significant digits of a length that is suggested.
const METRE_DIGITS: usize = 6;

/// Refuses a value that lies outside a key's domain; `path` is the key as the text states it, `found` puts the value into words.
pub(crate) fn check(
    key: &Key,
    path: impl FnOnce() -> String,
    value: &Value,
    found: impl FnOnce() -> String,
) -> Result<(), Problem> {
    if fits(key.domain, value) {
        return Ok(());
    }
    Err(Problem::Value {
        key: path(),
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
