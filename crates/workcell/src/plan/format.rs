//! Formats and kinds of plan files.

use crate::job::Planner;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The format that this version writes and reads.
pub const FORMAT: &str = "platewash-plan/2";

/// The format before it.
pub(super) const BEFORE: &str = "platewash-plan/1";

/// Kinds of plans.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Process {
    /// A washing, planned as a whole from home to home; what a certificate is about.
    Wash,
    /// A run of the paper's program: waypoint after waypoint. There is no certificate for it.
    Paper,
}

impl fmt::Display for Process {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Wash => "wash",
            Self::Paper => "paper",
        })
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
