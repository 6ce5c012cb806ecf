//! The `[job]` section: which program, what is required, what follows where it fails.

use platewash_keys::Section;
use platewash_workcell::job::OrderRule;
use serde::{Deserialize, Serialize};

/// `[job]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("job")]
#[serde(default, deny_unknown_fields)]
pub struct JobSection {
    /// Waypoint after waypoint as the paper's program, or planned as a whole, from home to home, with a certificate. Each uses the keys that
    /// it needs.
    #[key(domain = Word(&["paper", "certified"]), default = Program::Certified)]
    pub program: Program,
    /// A job that does not wash: report it (exit code 0), or also end with exit code 3 (infeasible) or 4 (verification failed).
    #[key(domain = Word(&["report", "fail"]), default = OnFailure::Report)]
    pub on_failure: OnFailure,
    /// Order of the plates: always the nearest unvisited centre, as listed, or the least travel time in all (certified only).
    #[key(domain = Word(&["nearest", "given", "fastest"]), default = OrderRule::Nearest)]
    pub order: OrderRule,
    /// Share of a plate's disc that the executed sponge must sweep for the plate to count as washed.
    #[key(domain = Number(0.0, 1.0), default = 0.99)]
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
