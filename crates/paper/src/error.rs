//! Why the paper's program could not be carried out.

use crate::settings::SettingError;
use crate::tracking::TrackingError;
use crate::work::WorkError;
use platewash_bodies::clearance::ClearanceError;
use platewash_bodies::coverage::CoverageError;
use platewash_bodies::job::JobError;
use platewash_kinematics::ik::IkSettingsError;
use platewash_kinematics::irb120::EmbeddedModelError;
use platewash_motion::plan::PlanFileError;
use platewash_simulator::ControlError;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::layout::LayoutError;
use platewash_workcell::verdict::Infeasibility;

/// Reason that the paper's program could not be carried out; one variant per stage. A run that does not wash is no error. The messages
/// contain those of their causes, which are not repeated as sources.
#[derive(Debug, Clone, PartialEq, thiserror::Error, derive_more::From)]
#[non_exhaustive]
pub enum PaperError {
    /// A setting with which nothing can be computed.
    #[error(transparent)]
    Setting(SettingError),
    /// A job with which nothing can be computed, or a start beyond the arm's limits.
    #[error(transparent)]
    Job(JobError),
    /// The settings could not be stated.
    #[error(transparent)]
    Terms(PlanFileError),
    /// The run would take minutes.
    #[error(transparent)]
    Work(WorkError),
    /// The built-in arm is broken.
    #[error(transparent)]
    Arm(EmbeddedModelError),
    /// The plates could not be placed.
    #[error("layout: {0}")]
    Layout(LayoutError),
    /// A setting of the inverse kinematics is out of range.
    #[error(transparent)]
    IkSettings(IkSettingsError),
    /// The control law moves no waypoints.
    #[error(transparent)]
    Law(ControlError),
    /// A waypoint is not finite, or the control law does not stay finite.
    #[error(transparent)]
    #[from(skip)]
    Tracking(TrackingError),
    /// The collision model could not be made.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// Coverage could not be measured.
    #[error("coverage: {0}")]
    Coverage(CoverageError),
    /// The caller asked to stop.
    #[error(transparent)]
    Cancelled(Cancelled),
}

impl From<TrackingError> for PaperError {
    fn from(error: TrackingError) -> Self {
        match error {
            TrackingError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Tracking(error),
        }
    }
}

impl PaperError {
    /// Returns the verdict on plates without room: proved infeasible, or no room found; `None` for bad input.
    #[must_use]
    pub fn infeasibility(&self) -> Option<Infeasibility> {
        match self {
            Self::Layout(error) => error.infeasibility(),
            _ => None,
        }
    }
}
