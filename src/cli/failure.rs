//! What goes wrong, as a message and an exit code.

use super::output;
use platewash::PlanError;
use platewash::planner::plan::PlanFileError;
use platewash::planner::robot::RobotError;
use platewash::planner::scenario::ScenarioError;
use platewash::workcell::csv::CsvError;
use std::io::Write;

/// Exit code of an internal error.
pub const INTERNAL: u8 = 1;
/// Exit code of bad usage or input.
pub const INPUT: u8 = 2;
/// Exit code of a request that cannot be met.
pub const INFEASIBLE: u8 = 3;
/// Exit code of a job whose execution fails the checks.
pub const NOT_VERIFIED: u8 = 4;

/// How the command ended: a number that a caller can read, which the standard library's type hides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExitCode(pub u8);

impl ExitCode {
    /// Done.
    pub const SUCCESS: Self = Self(0);
}

impl From<u8> for ExitCode {
    fn from(code: u8) -> Self {
        Self(code)
    }
}

/// A message for standard error and an exit code.
#[derive(Debug)]
pub struct Failure {
    code: u8,
    error: anyhow::Error,
}

impl Failure {
    /// Bad usage or input.
    pub fn input(error: impl Into<anyhow::Error>) -> Self {
        Self {
            code: INPUT,
            error: error.into(),
        }
    }

    /// Something that must not happen.
    pub fn internal(error: impl Into<anyhow::Error>) -> Self {
        Self {
            code: INTERNAL,
            error: error.into(),
        }
    }

    /// What the planner said, where it was the planner.
    pub fn of_planner(&self) -> Option<&PlanError> {
        self.error.downcast_ref()
    }

    /// Prints the message; the exit code.
    pub fn report(&self) -> ExitCode {
        // Nothing is left to do when standard error is closed.
        let message = output::text(&format_args!("error: {:#}", self.error));
        let _ = writeln!(std::io::stderr(), "{message}");
        ExitCode::from(self.code)
    }
}

impl From<PlanError> for Failure {
    fn from(error: PlanError) -> Self {
        let code = if error.is_infeasible() { INFEASIBLE } else { INPUT };
        Self {
            code,
            error: error.into(),
        }
    }
}

impl From<ScenarioError> for Failure {
    fn from(error: ScenarioError) -> Self {
        Self::input(error)
    }
}

impl From<RobotError> for Failure {
    fn from(error: RobotError) -> Self {
        Self::input(error)
    }
}

impl From<CsvError> for Failure {
    fn from(error: CsvError) -> Self {
        Self::input(error)
    }
}

impl From<PlanFileError> for Failure {
    fn from(error: PlanFileError) -> Self {
        Self::internal(error)
    }
}
