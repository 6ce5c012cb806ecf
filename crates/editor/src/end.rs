//! Why an answer ends before its end.

use crate::protocol::Refusal;
use crate::refusal::of_failure;
use platewash_planner::PlanError;
use platewash_scenario::Failure;
use platewash_workcell::cancel::Cancelled;

/// Why an answer ends before its end.
pub enum End {
    /// The scenario is none, or states no job.
    Refused(Refusal),
    /// A later question came, or it takes too long.
    GivenUp,
    /// A fault of the program.
    Failed(String),
}

impl From<Refusal> for End {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<Failure> for End {
    fn from(failure: Failure) -> Self {
        match failure.is_cancelled() {
            true => Self::GivenUp,
            false => Self::Refused(of_failure(&failure)),
        }
    }
}

impl From<PlanError> for End {
    fn from(error: PlanError) -> Self {
        Failure::from(error).into()
    }
}

impl From<Cancelled> for End {
    fn from(_: Cancelled) -> Self {
        Self::GivenUp
    }
}
