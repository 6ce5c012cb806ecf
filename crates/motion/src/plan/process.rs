//! Kind of a plan: the program that made it.

use platewash_workcell::job::Planner;
use serde::{Deserialize, Serialize};
use std::fmt;
use ts_rs::TS;

/// Kind of a plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Process {
    /// A washing, planned as a whole from home to home. Certificates are about these.
    Wash,
    /// A run of the paper's program, waypoint after waypoint. It has no certificate.
    Paper,
}

impl fmt::Display for Process {
    /// Writes the name that files have.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

impl From<&Planner> for Process {
    fn from(planner: &Planner) -> Self {
        match planner {
            Planner::Wash(_) => Self::Wash,
            Planner::Paper(_) => Self::Paper,
        }
    }
}
