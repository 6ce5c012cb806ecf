//! Every scenario key: unit, range, meaning, as the fields of the sections state them.
//!
//! Sections that a file may state several times, `[[name]]` each: their keys.

pub(crate) mod document;
pub(crate) mod fits;
pub(crate) mod form;
pub(crate) mod key;
pub(crate) mod line;
pub(crate) mod listed;
pub(crate) mod toml_text;
pub(crate) mod unknown;
pub(crate) mod value;

pub use crate::keys::key::{Domain, Key};

use crate::scenario::Scenario;
use crate::sections::holder::HolderSection;
use crate::sections::layout::{LayoutSection, PlateSection};
use crate::sections::motion::{IkSection, JobSection, LimitsSection, TransitionSection};
use crate::sections::obstacle::OBSTACLE_KEYS;
use crate::sections::robot::{ReducedClearanceSection, RobotSection};
use crate::sections::room::{FloorSection, TableSection};
use crate::sections::simulation::{ControlSection, PlantSection};
use crate::sections::tool::{TOOL_BODY_KEYS, ToolSection};
use crate::sections::wash::WashSection;
use platewash_workcell::workcell::MOST_BODIES;
use serde::Serialize;
use std::sync::LazyLock;

/// Every key, in the order of the reference; those of sections that may be stated several times are in [`LISTS`].
pub static KEYS: LazyLock<Vec<Key>> = LazyLock::new(|| {
    let sections = [
        Scenario::KEYS,
        JobSection::KEYS,
        RobotSection::KEYS,
        ToolSection::KEYS,
        LayoutSection::KEYS,
        WashSection::KEYS,
        HolderSection::KEYS,
        FloorSection::KEYS,
        TableSection::KEYS,
        IkSection::KEYS,
        TransitionSection::KEYS,
        LimitsSection::KEYS,
        ControlSection::KEYS,
        PlantSection::KEYS,
    ];
    sections.concat()
});

/// A section that may be stated several times.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct List {
    /// Its name.
    pub name: &'static str,
    /// Greatest number of sections.
    pub most: usize,
    /// Its keys, by their paths: messages name those of the second section `name[1].key`.
    pub keys: &'static [Key],
}

/// Every list, in the order of the reference.
pub const LISTS: &[List] = &[
    list("reduced_clearance", 50, ReducedClearanceSection::KEYS),
    list("tool_body", 50, TOOL_BODY_KEYS),
    list("plate", 1000, PlateSection::KEYS),
    list("obstacle", MOST_BODIES, OBSTACLE_KEYS),
];

const fn list(name: &'static str, most: usize, keys: &'static [Key]) -> List {
    List { name, most, keys }
}

/// The first key of a section, of those wanted, that the section states. One with a default is always stated.
pub(crate) fn first_stated(
    section: &impl Serialize,
    keys: &'static [Key],
    wanted: impl Fn(&str) -> bool,
) -> Option<&'static Key> {
    let values = serde_json::to_value(section).unwrap_or_default();
    let is_stated = |name: &str| values.get(name).is_some_and(|value| !value.is_null());
    keys.iter()
        .find(|key| wanted(own_name(key)) && is_stated(own_name(key)))
}

/// The name of a key within its section.
pub(crate) fn own_name(key: &Key) -> &'static str {
    key.path.rsplit('.').next().unwrap_or(key.path)
}
