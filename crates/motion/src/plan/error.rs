//! Formats of plan files, and the errors of writing and reading them.

use super::process::Process;
use platewash_workcell::json::JsonError;
use platewash_workcell::words::{printable, quoted};

/// Format that this version writes and reads.
pub const FORMAT: &str = "platewash-plan/2";

/// Format of the version before.
pub(super) const BEFORE: &str = "platewash-plan/1";

/// Reason that a plan file cannot be written or read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanFileError {
    /// A number in the plan is not finite; JSON cannot represent it.
    #[error("plan cannot be written as JSON: {detail}")]
    Unwritable {
        /// Message of the serialiser.
        detail: String,
    },
    /// The text is not a plan file.
    #[error("not a plan file: {0}")]
    Unreadable(#[from] JsonError),
    /// There is a key that no plan has.
    #[error("unknown key '{key}': a plan states what this program knows and nothing else")]
    UnknownKey {
        /// Path of the key, e.g. `wash_paths[2].extra`.
        key: String,
    },
    /// A key is missing. Nothing is filled in, as the hash covers the file's contents.
    #[error("'{key}' is missing: a plan states every value, defaults too; plan the scenario again")]
    MissingKey {
        /// Path of the key, e.g. `job.requirements.coverage`.
        key: String,
    },
    /// A value would be read as another one.
    #[error("'{key}' is {found}; expected {read}")]
    Inexact {
        /// Path of the value.
        key: String,
        /// Value in the file.
        found: String,
        /// Value as it is read.
        read: String,
    },
    /// The file has the previous format.
    #[error(
        "this is a {BEFORE}: it carries a scenario, and this version reads {FORMAT}, which carries the resolved job; plan its \
         scenario again (platewash plan)"
    )]
    Before,
    /// Process and planner contradict each other.
    #[error("process is \"{stated}\", and the job was planned as \"{planned}\"; a plan states one process")]
    Process {
        /// Process that the plan states.
        stated: Process,
        /// Process that its job implies.
        planned: Process,
    },
    /// A list is longer than that of any job.
    #[error("the plan is too large: {detail}")]
    TooLarge {
        /// Name of the list and its position.
        detail: String,
    },
    /// A name has control or direction characters.
    #[error("'{key}' is {}, a name with a control or direction character (escaped here): plan the scenario with another name", quoted(.found))]
    HiddenCharacter {
        /// Path of the name.
        key: String,
        /// Name found.
        found: String,
    },
    /// The file has another format.
    #[error("plan format must be \"{FORMAT}\"; found \"{}\"", printable(.found))]
    Format {
        /// Format found.
        found: String,
    },
}
