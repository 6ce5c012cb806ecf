//! Why a cycle could not be planned.

use super::UnwashablePlate;
use crate::crossing::{CrossingError, TerminalError, TooNear};
use crate::error::Infeasibility;
use crate::joint_path::JointPathError;
use crate::posture::PostureError;
use crate::posture::settings::TILT_RESERVE_RAD;
use crate::timing::TimingError;
use crate::tool_path::SegmentKind;
use platewash_kinematics::LimitViolation;
use platewash_kinematics::ik::{IkPathError, IkSettingsError};
use platewash_workcell::clearance::ClearanceError;
use platewash_workcell::trajectory::KnotError;

/// Why a cycle could not be planned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CycleError {
    /// The end configuration lies outside the joint limits.
    #[error("robot.home_deg: {0}")]
    Home(LimitViolation),
    /// At an end configuration the arm is too near something.
    #[error("{key}: the arm is not clear at home: {too_near}")]
    HomeNotClear {
        /// The key that states the configuration.
        key: &'static str,
        /// The bodies.
        too_near: Box<TooNear>,
    },
    /// A certified job needs a tool that touches the plates.
    #[error(
        "tool.length_m is 0: a certified job needs a tool; the paper's program (job.program = \"paper\") hovers without one"
    )]
    NoTool,
    /// The tip washes above the plates or below their surface.
    #[error("wash.height_m must be 0 in a certified job, whose sponge touches the plates; found {height_m}")]
    NoContact {
        /// Height asked for \[m\].
        height_m: f64,
    },
    /// The collision model could not be made.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// An inverse-kinematics setting is out of range.
    #[error(transparent)]
    IkSettings(#[from] IkSettingsError),
    /// The arm does not suit the posture planner.
    #[error(transparent)]
    Cell(PostureError),
    /// A plate cannot be washed whole, or no way to was found.
    #[error("{0}")]
    Unwashable(Box<UnwashablePlate>),
    /// Of no layout drawn was a way found to wash it whole.
    #[error(
        "of none of {layouts} layouts drawn was a way found to wash it whole, as layout.only_washable asks; of the last one, {last}"
    )]
    NoneWashable {
        /// Layouts drawn.
        layouts: usize,
        /// What stands in the way in the last one.
        last: String,
    },
    /// From the posture found on a plate, the arm does not follow the line over it.
    #[error("no way was found for the arm to follow the line over plate {plate} up to wash.lift_m = {lift_m}: {error}")]
    Line {
        /// The plate.
        plate: usize,
        /// Height of the line \[m\].
        lift_m: f64,
        /// Why.
        error: Box<IkPathError>,
    },
    /// The tool would tilt too far between the points that were solved.
    #[error(
        "plate {plate}: in the motion found, the tool tilts by up to {:.4}° during its {}; wash.tilt_max_deg and the sponge allow \
         {:.4}°, and {:.4}° of it are needed as room: allow more",
        tilt_rad.to_degrees(), kind.name(), most_rad.to_degrees(), TILT_RESERVE_RAD.to_degrees()
    )]
    Tilt {
        /// The plate.
        plate: usize,
        /// The stage of the motion.
        kind: SegmentKind,
        /// The largest tilt seen \[rad\].
        tilt_rad: f64,
        /// What is allowed \[rad\].
        most_rad: f64,
    },
    /// The line over a plate is no path.
    #[error(transparent)]
    Terminal(#[from] TerminalError),
    /// There is no way between two plates, or from or to home.
    #[error(transparent)]
    Crossing(#[from] CrossingError),
    /// A path that cannot be splined.
    #[error(transparent)]
    Path(#[from] JointPathError),
    /// A path that cannot be timed.
    #[error("{0}; wash.speed_m_s, wash.acceleration_m_s2 and the keys of [limits] decide it")]
    Timing(TimingError),
    /// Motions that don't fit together.
    #[error(transparent)]
    Knots(#[from] KnotError),
}

impl CycleError {
    /// Whether the input was fine but no plan came of it (exit code 3).
    #[must_use]
    pub fn is_infeasible(&self) -> bool {
        self.infeasibility().is_some()
    }

    /// Whether the job cannot be done, or no way to do it was found; `None` for bad input.
    #[must_use]
    pub fn infeasibility(&self) -> Option<Infeasibility> {
        match self {
            Self::HomeNotClear { .. } | Self::Crossing(CrossingError::Home { .. }) => Some(Infeasibility::Proved),
            Self::Unwashable(plate) if plate.conclusion.is_proved() => Some(Infeasibility::Proved),
            Self::Unwashable(_) | Self::NoneWashable { .. } | Self::Line { .. } | Self::Tilt { .. } => {
                Some(Infeasibility::NotFound)
            }
            Self::Crossing(error) => error.is_infeasible().then_some(Infeasibility::NotFound),
            _ => None,
        }
    }
}

// The message above holds that of its cause, which is therefore not told again as a source.
impl From<TimingError> for CycleError {
    fn from(error: TimingError) -> Self {
        Self::Timing(error)
    }
}
