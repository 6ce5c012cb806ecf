//! Keys that do not exist, and the word that was probably intended.

use crate::error::Problem;
use crate::keys::likeness::nearest;
use crate::keys::table::{KEYS, LISTS};
use platewash_workcell::words::printable;
use std::collections::BTreeSet;

/// Problem for a key that does not exist.
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

/// Hint on a name that does not exist among `known`, which `in_full` writes out. It names the radius for a diameter, otherwise
/// the most similar name, or else returns the text of `otherwise`.
pub(crate) fn hint(
    name: &str,
    known: &[&str],
    in_full: impl Fn(&str) -> String,
    otherwise: impl FnOnce() -> String,
) -> String {
    let of_radius = name.replace("diameter", "radius");
    if of_radius != name && known.contains(&&*of_radius) {
        return format!("half of it, the radius, is stated: '{}'", in_full(&of_radius));
    }
    nearest(name, known.iter().copied()).map_or_else(otherwise, |other| format!("did you mean '{}'?", in_full(other)))
}
