//! Keys that do not exist.

use crate::error::Problem;
use crate::keys::KEYS;
use crate::lists::LISTS;
use crate::nearest::hint;
use platewash_workcell::words::printable;
use std::collections::BTreeSet;

/// What is said of a key that does not exist.
pub(crate) fn unknown(key: &str) -> Problem {
    let paths = KEYS.iter().map(|key| key.path);
    let sections = paths.clone().filter_map(|path| Some(path.split_once('.')?.0));
    let beside = sections
        .chain(LISTS.iter().map(|list| list.name))
        .collect::<BTreeSet<_>>();
    let of_section = || match key.split_once('.') {
        Some((section, _)) if beside.contains(section) => {
            let own = paths
                .clone()
                .filter_map(|path| path.strip_prefix(section)?.strip_prefix('.'));
            format!("keys of [{section}]: {}", own.collect::<Vec<_>>().join(", "))
        }
        _ => {
            let all: Vec<_> = beside.iter().copied().collect();
            format!("sections: {}", all.join(", "))
        }
    };
    let hint = hint(key, paths.clone().chain(beside.iter().copied()), of_section);
    let key = printable(key);
    Problem::UnknownKey { key, hint }
}
