//! Sections that a file may state several times, `[[name]]` each: their keys.

use crate::key::Key;
use crate::obstacle::OBSTACLE_KEYS;
use crate::plate::PlateSection;
use crate::tool_body::TOOL_BODY_KEYS;
use platewash_workcell::workcell::MOST_BODIES;

/// A section that may be stated several times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct List {
    /// Its name.
    pub name: &'static str,
    /// How often it may be stated.
    pub most: usize,
    /// Its keys, by their paths: those of the second one are told as `name[1].key`.
    pub keys: &'static [Key],
}

/// Every list, in the order of the reference.
pub const LISTS: &[List] = &[
    List {
        name: "tool_body",
        most: 50,
        keys: TOOL_BODY_KEYS,
    },
    List {
        name: "plate",
        most: 1000,
        keys: PlateSection::KEYS,
    },
    List {
        name: "obstacle",
        most: MOST_BODIES,
        keys: OBSTACLE_KEYS,
    },
];

/// The name of a key within its section.
pub(crate) fn own_name(key: &Key) -> &'static str {
    key.path.rsplit('.').next().unwrap_or(key.path)
}
