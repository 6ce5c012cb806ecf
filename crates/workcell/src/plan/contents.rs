//! Whether a plan file says what is read of it, and nothing else.
//!
//! Reading alone is not strict enough: tagged and flattened types swallow keys that they do not know, missing keys of a scenario
//! become defaults, and of a key that is stated twice the last one counts. The hash would then be that of other contents.

use super::error::PlanFileError;
use crate::differences::{Difference, NOTHING, by_place};
use crate::job::MAX_SEED;
use crate::json::JsonError;
use crate::words::shortened;
use serde::Serialize;
use serde_json::Value;

/// Longest value that a message repeats, in characters.
const LONGEST: usize = 60;

/// Refuses a text that says anything else than what was read of it, which is `written` as canonical JSON.
///
/// # Errors
/// [`PlanFileError`] with the key.
pub(super) fn check(text: &str, written: &str, plan: &impl Serialize) -> Result<(), PlanFileError> {
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
    // What is there says more of a slip than what is missing for it.
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

/// The keys of all tables of a value.
fn keys(value: &Value) -> usize {
    match value {
        Value::Object(table) => table.values().map(|value| 1 + keys(value)).sum(),
        Value::Array(list) => list.iter().map(keys).sum(),
        _ => 0,
    }
}

/// The keys of all tables of a text that is JSON, those that are stated twice counted twice: a colon outside of texts follows each.
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
