//! Verdict on a job.

use serde::Serialize;

/// Verdict on a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every plate is washed and every limit is kept: pressed on the required share, for the required time and with the required dose.
    Washed,
    /// Every plate is swept and every limit is kept; contact is not required.
    Swept,
    /// The dry run is proved: its motion in the air keeps the limits. Nothing is washed.
    DryRun,
    /// The job cannot be done, or the plan fails: a waypoint out of reach, or too little clearance.
    Infeasible,
    /// No way to do the job was found; there may be one.
    NotFound,
    /// The plan is good, but its execution fails: coverage, limits or clearance.
    NotVerified,
}

/// Kind of infeasibility: proved, or only not found otherwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Infeasibility {
    /// It is proved that the job cannot be done.
    Proved,
    /// No way to do the job was found. That does not prove that there is none.
    NotFound,
}

impl Infeasibility {
    /// Returns `Proved` if `is_proved`, otherwise `NotFound`.
    #[must_use]
    pub fn proved_if(is_proved: bool) -> Self {
        if is_proved { Self::Proved } else { Self::NotFound }
    }
}
