//! Names that the controller has given: a program that gave them again would mean something else by them than is run here.

use super::predefined::predefined;
use super::types::RECORDS;
use super::unmodelled::is_unmodelled;

/// Instructions that are modelled, in small letters.
const INSTRUCTIONS: [&str; 10] = [
    "moveabsj", "waittime", "tperase", "tpwrite", "errwrite", "confj", "confl", "singarea", "accset", "velset",
];
/// Functions that are modelled, and types.
const OTHERS: [&str; 19] = [
    "abs", "sqrt", "sin", "cos", "tan", "round", "trunc", "atan2", "numtostr", "valtostr", "strlen", "dim", "present",
    "cjointt", "num", "byte", "errnum", "bool", "string",
];

/// Whether a routine of that name, in small letters, would stand in the way of one that is modelled.
#[must_use]
pub fn is_modelled(key: &str) -> bool {
    INSTRUCTIONS.contains(&key) || OTHERS.contains(&key)
}

/// Whether the controller has given a name to something that is known here, in any letters.
#[must_use]
pub fn is_taken(name: &str) -> bool {
    let key = name.to_lowercase();
    let is_type = RECORDS.iter().any(|(record, _)| *record == key);
    is_type || is_modelled(&key) || is_unmodelled(&key) || predefined(&key).is_some()
}
