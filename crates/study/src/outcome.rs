//! How a row ended, in a word.

use platewash_certificate::Verdict;
use platewash_scenario::Failure;
use platewash_workcell::verdict::Infeasibility;
use serde::{Deserialize, Serialize};

/// How a row ended. The words are those of `sweep`, and one more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Planned, and every requirement proved.
    Proved,
    /// Planned, but a requirement is violated or not proved.
    NotProved,
    /// The job cannot be done.
    Infeasible,
    /// No way to do it was found; there may be one.
    NotFound,
    /// The values of this row state no job.
    Error,
    /// The program failed on this row, which is a fault of the program.
    Crashed,
}

impl Outcome {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Proved,
        Self::NotProved,
        Self::Infeasible,
        Self::NotFound,
        Self::Error,
        Self::Crashed,
    ];

    /// Its code, as in rows.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::NotProved => "not_proved",
            Self::Infeasible => "infeasible",
            Self::NotFound => "not_found",
            Self::Error => "error",
            Self::Crashed => "crashed",
        }
    }

    /// Of a layout that was planned and judged.
    #[must_use]
    pub fn judged(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Pass => Self::Proved,
            Verdict::Fail => Self::NotProved,
        }
    }
}

impl From<&Failure> for Outcome {
    /// Of a layout that came to no plan, or to none that could be judged.
    fn from(error: &Failure) -> Self {
        match error.infeasibility() {
            Some(Infeasibility::Proved) => Self::Infeasible,
            Some(Infeasibility::NotFound) => Self::NotFound,
            None => Self::Error,
        }
    }
}
