//! Every scenario key: unit, range, meaning, as the fields of the sections state them.

use crate::control::ControlSection;
use crate::ik::IkSection;
use crate::job::JobSection;
use crate::key::Domain::{Integer, Text};
use crate::key::key;
pub use crate::key::{Domain, Key};
use crate::layout::LayoutSection;
use crate::limits::LimitsSection;
use crate::plant::PlantSection;
use crate::robot::RobotSection;
use crate::room::{FloorSection, TableSection};
use crate::tool::ToolSection;
use crate::transition::TransitionSection;
use crate::wash::WashSection;
use platewash_workcell::job::MAX_SEED;
use std::sync::LazyLock;

/// Every key, in the order of the reference; those of sections that may be stated several times are in [`LISTS`](crate::LISTS).
pub static KEYS: LazyLock<Vec<Key>> = LazyLock::new(|| {
    let sections = [
        TOP_LEVEL,
        JobSection::KEYS,
        RobotSection::KEYS,
        ToolSection::KEYS,
        LayoutSection::KEYS,
        WashSection::KEYS,
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
