//! The `[job]` section: which program, what is required, what follows where it fails.

use platewash_workcell::job::OrderRule;
use serde::{Deserialize, Serialize};

/// `[job]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct JobSection {
    /// How the job is planned.
    pub program: Program,
    /// Whether a job that does not wash ends with an error.
    pub on_failure: OnFailure,
    /// In which order plates are washed.
    pub order: OrderRule,
    /// Share of a plate that must be swept for it to count as washed.
    pub required_coverage: f64,
}

/// How a job is planned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Program {
    /// Waypoint after waypoint, each solved and followed by a control law: the paper's program.
    Paper,
    /// As a whole, from home to home: wash paths, redundancy, transits, timing, certificate.
    Certified,
}

/// What a job that does not wash leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum OnFailure {
    /// A report; exit code 0.
    Report,
    /// A report; exit code 3 (infeasible) or 4 (verification failed).
    Fail,
}

impl Default for JobSection {
    fn default() -> Self {
        Self {
            program: Program::Certified,
            on_failure: OnFailure::Report,
            order: OrderRule::Nearest,
            required_coverage: 0.99,
        }
    }
}
