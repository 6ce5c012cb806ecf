//! The table of all keys, and the lists: sections that a file may state several times, `[[name]]` each.

use crate::keys::key::Key;
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
use platewash_workcell::MOST_BODIES;
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
