//! Why a plan file could not be written or read.

use super::format::{BEFORE, FORMAT, Process};
use crate::json::JsonError;
use crate::words::{printable, quoted};

/// Why a plan file could not be written or read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanFileError {
    /// A number in it is not finite, which JSON cannot say.
    #[error("plan cannot be written as JSON: {detail}")]
    Unwritable {
        /// The serialiser's words.
        detail: String,
    },
    /// Not a plan file.
    #[error("not a plan file: {0}")]
    Unreadable(#[from] JsonError),
    /// A key that no plan has.
    #[error("unknown key '{key}': a plan states what this program knows and nothing else")]
    UnknownKey {
        /// Its place, e.g. `wash_paths[2].extra`.
        key: String,
    },
    /// A key that is left out. Nothing is filled in: the hash is that of what the file says.
    #[error("'{key}' is missing: a plan states every value, defaults too; plan the scenario again")]
    MissingKey {
        /// Its place, e.g. `job.requirements.coverage`.
        key: String,
    },
    /// A value that says something else than what would be read.
    #[error("'{key}' is {found}; expected {read}")]
    Inexact {
        /// Its place.
        key: String,
        /// What the file says.
        found: String,
        /// What a plan file would say.
        read: String,
    },
    /// The format before this one.
    #[error(
        "this is a {BEFORE}: it carries a scenario, and this version reads {FORMAT}, which carries the resolved job; plan its \
         scenario again (platewash plan)"
    )]
    Before,
    /// The process and the planner contradict each other.
    #[error("process is \"{stated}\", and the job was planned as \"{planned}\"; a plan states one process")]
    Process {
        /// What the plan states.
        stated: Process,
        /// What its job says.
        planned: Process,
    },
    /// Lists that are longer than those of any job.
    #[error("the plan is too large: {detail}")]
    TooLarge {
        /// Which list, and where.
        detail: String,
    },
    /// A name that does not read as what it says.
    #[error("'{key}' is {}, a name with a control or direction character (escaped here): plan the scenario with another name", quoted(.found))]
    HiddenCharacter {
        /// Its place.
        key: String,
        /// The name.
        found: String,
    },
    /// Another format.
    #[error("plan format must be \"{FORMAT}\"; found \"{}\"", printable(.found))]
    Format {
        /// The format found.
        found: String,
    },
}
