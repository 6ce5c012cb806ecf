//! The one rule by which verbs end; `docs/command.md` says it in words.

use super::failure::{self, ExitCode};
use platewash::scenario::OnFailure;
use platewash::{SimulationVerdict, Verdict};

/// How the work of a verb ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Outcome {
    /// As asked.
    Good,
    /// Done, but not proved, not washed, or not the plan that was written.
    NotVerified,
    /// It cannot be done, or no way was found.
    Infeasible,
}

impl Outcome {
    /// The exit code of an answer to a question about a file or a pose: `validate`, `verify`, `simulate`, `tune`, `ik`.
    pub fn answer(self) -> ExitCode {
        match self {
            Self::Good => ExitCode::SUCCESS,
            Self::NotVerified => ExitCode::from(failure::NOT_VERIFIED),
            Self::Infeasible => ExitCode::from(failure::INFEASIBLE),
        }
    }

    /// The exit code of a job carried out: `run`, `plan`, `sweep`. Its scenario says whether one that does not wash fails or is only
    /// reported.
    pub fn job(self, on_failure: OnFailure) -> ExitCode {
        match on_failure {
            OnFailure::Report => ExitCode::SUCCESS,
            OnFailure::Fail => self.answer(),
        }
    }
}

impl From<Verdict> for Outcome {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Washed | Verdict::Swept | Verdict::DryRun => Self::Good,
            Verdict::NotVerified => Self::NotVerified,
            Verdict::Infeasible | Verdict::NotFound => Self::Infeasible,
        }
    }
}

impl From<SimulationVerdict> for Outcome {
    fn from(verdict: SimulationVerdict) -> Self {
        if verdict.is_done() {
            Self::Good
        } else {
            Self::NotVerified
        }
    }
}
