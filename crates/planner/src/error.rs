//! Why a job could not be carried out, whatever its program.

use crate::control::NotKinematic;
use crate::cycle::CycleError;
use crate::robot::RobotError;
use crate::scenario::ScenarioError;
use crate::tracking::TrackingError;
use platewash_kinematics::ik::{IkError, IkSettingsError};
use platewash_workcell::clearance::ClearanceError;
use platewash_workcell::coverage::CoverageError;
use platewash_workcell::layout::LayoutError;

/// Why a job could not be carried out; one variant a stage.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The scenario was refused.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The arm could not be made.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The plates could not be placed.
    #[error("layout: {0}")]
    Layout(LayoutError),
    /// An inverse-kinematics setting is out of range.
    #[error(transparent)]
    IkSettings(#[from] IkSettingsError),
    /// A waypoint or configuration is not finite.
    #[error("inverse kinematics: {0}")]
    Ik(IkError),
    /// The control law moves no waypoints.
    #[error("control.law: {0}")]
    Law(NotKinematic),
    /// The control law does not stay finite.
    #[error(transparent)]
    Tracking(#[from] TrackingError),
    /// The collision model could not be made.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// Coverage could not be measured.
    #[error("coverage: {0}")]
    Coverage(CoverageError),
    /// The cycle of a certified job could not be planned.
    #[error(transparent)]
    Cycle(#[from] CycleError),
    /// The caller asked to stop.
    #[error("stopped before the end")]
    Stopped,
}

// The messages above hold those of their causes, which are therefore not told again as sources.
impl From<LayoutError> for PlanError {
    fn from(error: LayoutError) -> Self {
        Self::Layout(error)
    }
}

impl From<NotKinematic> for PlanError {
    fn from(error: NotKinematic) -> Self {
        Self::Law(error)
    }
}

impl From<IkError> for PlanError {
    fn from(error: IkError) -> Self {
        Self::Ik(error)
    }
}

impl From<ClearanceError> for PlanError {
    fn from(error: ClearanceError) -> Self {
        Self::Clearance(error)
    }
}

impl From<CoverageError> for PlanError {
    fn from(error: CoverageError) -> Self {
        Self::Coverage(error)
    }
}

/// What is known of a job whose input was fine and for which there is no plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Infeasibility {
    /// It cannot be done: a bound or a complete search proves it.
    Proved,
    /// No way to do it was found; there may be one.
    NotFound,
}

impl PlanError {
    /// Whether the input was fine but no plan came of it (exit code 3), as opposed to bad input.
    #[must_use]
    pub fn is_infeasible(&self) -> bool {
        self.infeasibility().is_some()
    }

    /// Whether the job cannot be done, or no way to do it was found; `None` for bad input.
    #[must_use]
    pub fn infeasibility(&self) -> Option<Infeasibility> {
        use LayoutError::{EmptyRegion, NoRoom};
        match self {
            Self::Layout(error @ (NoRoom { .. } | EmptyRegion { .. })) => Some(if error.is_proven() {
                Infeasibility::Proved
            } else {
                Infeasibility::NotFound
            }),
            Self::Cycle(error) => error.infeasibility(),
            _ => None,
        }
    }
}
