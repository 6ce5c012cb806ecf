//! Keys that do not exist.

use crate::error::Problem;
use crate::keys::KEYS;
use crate::lists::LISTS;
use crate::nearest::nearest;
use platewash_workcell::words::printable;

/// What is said of a key that does not exist.
pub(crate) fn unknown(key: &str) -> Problem {
    let known = KEYS
        .iter()
        .map(|key| key.path)
        .chain(LISTS.iter().map(|list| list.name));
    let nearest = nearest(key, known).map(str::to_owned);
    let key = printable(key);
    Problem::UnknownKey { key, nearest }
}
