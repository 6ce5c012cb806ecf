//! What goes wrong, as a message and an exit code.

use super::text::text;
use platewash::scenario::ScenarioError;
use platewash::study::StudyError;
use platewash::workcell::cancel::Cancelled;
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
/// Exit code of work that was given up: 128 and the number of the signal, as shells say it.
pub const INTERRUPTED: u8 = 130;

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

/// Why a verb ended without an answer.
#[derive(Debug)]
pub enum Failure {
    /// It was told to give up.
    Interrupted,
    /// Something is wrong: a message for standard error and an exit code.
    Wrong {
        /// The exit code.
        code: u8,
        /// The message.
        error: anyhow::Error,
    },
}

impl Failure {
    /// Bad usage or input.
    pub fn input(error: impl Into<anyhow::Error>) -> Self {
        Self::with_code(INPUT, error)
    }

    /// A plan that is refused because it is not proved, or was changed after it was written.
    pub fn not_verified(error: impl Into<anyhow::Error>) -> Self {
        Self::with_code(NOT_VERIFIED, error)
    }

    /// Something that must not happen.
    pub fn internal(error: impl Into<anyhow::Error>) -> Self {
        Self::with_code(INTERNAL, error)
    }

    fn with_code(code: u8, error: impl Into<anyhow::Error>) -> Self {
        let error = error.into();
        Self::Wrong { code, error }
    }

    /// Why a scenario could not be carried out, where that is it.
    pub fn of_scenario(&self) -> Option<&platewash::Failure> {
        match self {
            Self::Interrupted => None,
            Self::Wrong { error, .. } => error.downcast_ref(),
        }
    }

    /// Prints the message; the exit code.
    pub fn report(&self) -> ExitCode {
        let (code, message) = match self {
            Self::Interrupted => (INTERRUPTED, "interrupted".to_owned()),
            Self::Wrong { code, error } => (*code, text(&format_args!("error: {error:#}"))),
        };
        // Nothing is left to do when standard error is closed.
        let _ = writeln!(std::io::stderr(), "{message}");
        ExitCode::from(code)
    }
}

impl From<platewash::Failure> for Failure {
    fn from(error: platewash::Failure) -> Self {
        use platewash::Failure::{File, Prove};
        if error.is_cancelled() {
            return Self::Interrupted;
        }
        let code = match error {
            _ if error.infeasibility().is_some() => INFEASIBLE,
            // Of plans that were made here.
            Prove(_) | File(_) => INTERNAL,
            _ => INPUT,
        };
        Self::with_code(code, error)
    }
}

impl From<Cancelled> for Failure {
    fn from(_: Cancelled) -> Self {
        Self::Interrupted
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Cancelled(_) => Self::Interrupted,
            error => Self::input(error),
        }
    }
}

impl From<ScenarioError> for Failure {
    fn from(error: ScenarioError) -> Self {
        Self::input(error)
    }
}

impl From<CsvError> for Failure {
    fn from(error: CsvError) -> Self {
        Self::input(error)
    }
}
