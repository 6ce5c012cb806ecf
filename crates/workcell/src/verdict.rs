//! How a job ended.

use serde::Serialize;

/// How a job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every plate is washed and every limit kept: pressed on the share, for the time and with the dose required.
    Washed,
    /// Every plate is swept and every limit kept; contact is not required.
    Swept,
    /// A dry run that is proved: its motion in the air is. Nothing is washed.
    DryRun,
    /// The job cannot be done, or the plan itself fails: a waypoint out of reach, or too little clearance.
    Infeasible,
    /// No way to do the job was found; there may be one.
    NotFound,
    /// The plan would do, but its execution fails: coverage, limits or clearance.
    NotVerified,
}

/// Whether a job that is not done cannot be done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Infeasibility {
    /// It cannot be done.
    Proved,
    /// No way to do it was found, which does not prove that there is none.
    NotFound,
}

impl Infeasibility {
    /// Proved, or only not found.
    #[must_use]
    pub fn proved_if(is_proved: bool) -> Self {
        if is_proved { Self::Proved } else { Self::NotFound }
    }
}
