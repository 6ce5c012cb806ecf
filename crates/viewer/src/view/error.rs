//! Why there is nothing to show.

use platewash_certificate::ProveError;
use platewash_motion::trajectory::KnotError;
use platewash_workcell::job::TermsError;

/// Reason that there is nothing to show.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// Knots that are no motion.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// A plan without knots.
    #[error("the plan has no knots: there is no motion to show")]
    NoMotion,
    /// A job with which nothing can be computed.
    #[error(transparent)]
    Job(#[from] TermsError),
    /// A plan that cannot be judged, so that no dose is proved.
    #[error(transparent)]
    Dose(#[from] ProveError),
    /// A motion that goes on long after the plan.
    #[error(
        "the motion ends at {end_s} s, more than {slack_s} s after the plan, which ends at {plan_s} s: it is not of this plan"
    )]
    BeyondEnd {
        /// The motion's last time \[s\].
        end_s: f64,
        /// The plan's \[s\].
        plan_s: f64,
        /// Largest delay allowed \[s\].
        slack_s: f64,
    },
}
