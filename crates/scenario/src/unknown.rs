//! Keys that do not exist, and the nearest ones that do.

use crate::error::Problem;
use crate::keys::KEYS;
use platewash_workcell::words::printable;

/// Less like any key than this, nothing is suggested.
const LEAST_LIKENESS: f64 = 0.6;

/// What is said of a key that does not exist.
pub(crate) fn unknown(key: &str) -> Problem {
    let ranked = KEYS
        .iter()
        .map(|k| (strsim::normalized_damerau_levenshtein(k.path, key), k.path));
    let nearest = ranked
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .filter(|(likeness, _)| *likeness > LEAST_LIKENESS);
    Problem::UnknownKey {
        key: printable(key),
        nearest: nearest.map(|(_, path)| path.to_owned()),
    }
}
