//! Keys that do not exist.

use crate::error::Problem;
use crate::keys::KEYS;
use crate::lists::LISTS;
use crate::nearest::hint;
use platewash_workcell::words::printable;
use std::collections::BTreeSet;

/// What is said of a key that does not exist.
pub(crate) fn unknown(key: &str) -> Problem {
    let paths = || KEYS.iter().map(|key| key.path);
    let sections = paths().filter_map(|path| Some(path.split_once('.')?.0));
    let sections: BTreeSet<_> = sections.chain(LISTS.iter().map(|list| list.name)).collect();
    let hint = match key.split_once('.').filter(|(section, _)| sections.contains(section)) {
        Some((section, name)) => {
            let own: Vec<_> = paths()
                .filter_map(|path| path.strip_prefix(section)?.strip_prefix('.'))
                .collect();
            let elsewhere = paths().find(|path| path.split_once('.').is_some_and(|(_, other)| other == name));
            let in_full = |name: &str| format!("{section}.{name}");
            hint(name, &own, in_full, || match elsewhere {
                Some(path) => format!("did you mean '{path}'?"),
                None => format!("keys of [{section}]: {}", own.join(", ")),
            })
        }
        None => {
            let known: Vec<_> = sections.iter().copied().chain(paths()).collect();
            hint(key, &known, str::to_owned, || {
                let all: Vec<_> = sections.iter().copied().collect();
                format!("sections: {}", all.join(", "))
            })
        }
    };
    let key = printable(key);
    Problem::UnknownKey { key, hint }
}
