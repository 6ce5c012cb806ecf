//! The one rule by which verbs end; `docs/command.md` says it in words.

use super::terminal::shown;
use platewash::scenario::OnFailure;
use platewash::study::StudyError;
use platewash::workcell::cancel::Cancelled;
use platewash::{SimulationVerdict, Verdict};
use std::io::Write;

/// Exit code of a verb.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExitCode {
    /// As asked.
    Done = 0,
    /// An internal error.
    Internal = 1,
    /// Bad usage or input.
    Input = 2,
    /// It cannot be done, or no way was found.
    Infeasible = 3,
    /// Done, but not proved, not washed, or not the plan that was written.
    NotVerified = 4,
    /// Given up: 128 and the number of the signal, as shells say it.
    Interrupted = 130,
}

impl ExitCode {
    /// Done if `is_good`, otherwise this.
    pub fn unless(self, is_good: bool) -> Self {
        if is_good { Self::Done } else { self }
    }

    /// The exit code of a job carried out: `run`, `plan`, `sweep`. Its scenario says whether one that does not wash fails or is only
    /// reported.
    pub fn job(self, on_failure: OnFailure) -> Self {
        self.unless(on_failure == OnFailure::Report)
    }
}

impl From<Verdict> for ExitCode {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Washed | Verdict::Swept | Verdict::DryRun => Self::Done,
            Verdict::NotVerified => Self::NotVerified,
            Verdict::Infeasible | Verdict::NotFound => Self::Infeasible,
        }
    }
}

impl From<SimulationVerdict> for ExitCode {
    fn from(verdict: SimulationVerdict) -> Self {
        Self::NotVerified.unless(verdict.is_done())
    }
}

/// An error with an exit code of its own.
#[derive(Debug, thiserror::Error)]
#[error("{error:#}")]
struct CodedError {
    code: ExitCode,
    error: anyhow::Error,
}

/// Something that must not happen.
pub fn internal(error: impl Into<anyhow::Error>) -> anyhow::Error {
    let (code, error) = (ExitCode::Internal, error.into());
    CodedError { code, error }.into()
}

/// A plan that is refused because it is not proved, or was changed after it was written.
pub fn not_verified(error: impl Into<anyhow::Error>) -> anyhow::Error {
    let (code, error) = (ExitCode::NotVerified, error.into());
    CodedError { code, error }.into()
}

/// The exit code of an error: bad input, where nothing else is known of it.
pub fn code(error: &anyhow::Error) -> ExitCode {
    use platewash::Failure::{File, Prove};
    if let Some(CodedError { code, .. }) = error.downcast_ref() {
        return *code;
    }
    if error.is::<Cancelled>() || matches!(error.downcast_ref(), Some(StudyError::Cancelled(_))) {
        return ExitCode::Interrupted;
    }
    match error.downcast_ref::<platewash::Failure>() {
        Some(failure) if failure.is_cancelled() => ExitCode::Interrupted,
        Some(failure) if failure.infeasibility().is_some() => ExitCode::Infeasible,
        // Of plans that were made here.
        Some(Prove(_) | File(_)) => ExitCode::Internal,
        _ => ExitCode::Input,
    }
}

/// Prints the message of an error; its exit code.
pub fn report(error: &anyhow::Error) -> ExitCode {
    let code = code(error);
    let message = match code {
        ExitCode::Interrupted => "interrupted".to_owned(),
        _ => shown(&format_args!("error: {error:#}")),
    };
    // Nothing is left to do when standard error is closed.
    let _ = writeln!(std::io::stderr(), "{message}");
    code
}
