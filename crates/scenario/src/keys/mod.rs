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

use crate::keys::key::Domain::{Integer, Text};
use crate::keys::key::key;
use crate::sections::holder::HolderSection;
use crate::sections::layout::{LayoutSection, PlateSection};
use crate::sections::motion::{IkSection, JobSection, LimitsSection, TransitionSection};
use crate::sections::obstacle::OBSTACLE_KEYS;
use crate::sections::robot::{ReducedClearanceSection, RobotSection};
use crate::sections::room::{FloorSection, TableSection};
use crate::sections::simulation::{ControlSection, PlantSection};
use crate::sections::tool::{TOOL_BODY_KEYS, ToolSection};
use crate::sections::wash::WashSection;
use platewash_workcell::job::MAX_SEED;
use platewash_workcell::workcell::MOST_BODIES;
use std::sync::LazyLock;

/// Every key, in the order of the reference; those of sections that may be stated several times are in [`LISTS`].
pub static KEYS: LazyLock<Vec<Key>> = LazyLock::new(|| {
    let sections = [
        TOP_LEVEL,
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

/// Keys of no section.
const TOP_LEVEL: &[Key] = &[
    key("name", "", Text, "Name, for reports."),
    key(
        "seed",
        "",
        Integer(0, MAX_SEED as i64),
        "Seed of every random stream; the same seed gives the same bytes. Larger ones are no JSON numbers of their own.",
    ),
];

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
    List {
        name: "reduced_clearance",
        most: 50,
        keys: ReducedClearanceSection::KEYS,
    },
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
