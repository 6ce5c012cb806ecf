//! Why a plan cannot be judged at all.

use crate::robot::RobotError;
use crate::scenario::ScenarioError;
use platewash_kinematics::words::told_apart;
use platewash_workcell::clearance::ClearanceError;
use platewash_workcell::coverage::CoverageError;
use platewash_workcell::trajectory::KnotError;
use platewash_workcell::words::{counted, printable};

/// Why a plan cannot be judged at all; a plan that breaks its promises is no error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyError {
    /// The arm of the scenario cannot be made.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// The plan is about an arm that is not built in, and none was given.
    #[error("the plan is for the arm of \"{}\"; give its description", printable(.file))]
    NoDescription {
        /// File name of the description.
        file: String,
    },
    /// The scenario in the plan is none.
    #[error("the plan's scenario: {0}")]
    Scenario(ScenarioError),
    /// The knots are no motion.
    #[error("{0}")]
    Knots(KnotError),
    /// Fewer than two knots.
    #[error("{}; a motion has at least 2", counted(*.found, "knot"))]
    NoMotion {
        /// Knots found.
        found: usize,
    },
    /// A piece of the motion is so short that its cubic cannot be computed.
    #[error("the piece from knot {piece} to knot {} lasts {length_s:.3e} s; the shortest that can be judged lasts {least_s:e} s", .piece + 1)]
    TooShort {
        /// Index of the piece, and of the knot that it starts from.
        piece: usize,
        /// How long it lasts \[s\].
        length_s: f64,
        /// How long it must last \[s\].
        least_s: f64,
    },
    /// A joint turns so far that its sine means nothing any more.
    #[error("joint {} gets to {} rad; no more than ±{most_rad} rad can be judged", .joint + 1, far(*.position_rad, *.most_rad))]
    TurnsTooFar {
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// How far \[rad\].
        position_rad: f64,
        /// How far is possible \[rad\].
        most_rad: f64,
    },
    /// More plates than any layout may have.
    #[error("{found} plates; a layout has at most {most}")]
    TooManyPlates {
        /// Plates found.
        found: usize,
        /// Plates allowed.
        most: usize,
    },
    /// More segments than any job on that many plates has.
    #[error("{found} segments for {}; there are {most} at most", counted(*.plates, "plate"))]
    TooManySegments {
        /// Segments found, in time or in the tool path.
        found: usize,
        /// Plates.
        plates: usize,
        /// Segments possible.
        most: usize,
    },
    /// A plate is no cylinder.
    #[error("plate {plate}: its centre, height, radius and thickness must be finite, the latter two above 0")]
    NoPlate {
        /// Index of the plate.
        plate: usize,
    },
    /// The collision model cannot be made.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// Coverage cannot be measured.
    #[error("coverage: {0}")]
    Coverage(CoverageError),
}

/// An angle \[rad\] beyond a limit, as many digits as tell them apart.
fn far(position_rad: f64, most_rad: f64) -> String {
    const WRITTEN_OUT: f64 = 1e6;
    if position_rad < WRITTEN_OUT {
        let [far, _] = told_apart(position_rad, most_rad, 1);
        return far;
    }
    format!("{position_rad:.3e}")
}

// The messages above hold those of their causes, which are therefore not told again as sources.
impl From<ScenarioError> for VerifyError {
    fn from(error: ScenarioError) -> Self {
        Self::Scenario(error)
    }
}

impl From<KnotError> for VerifyError {
    fn from(error: KnotError) -> Self {
        Self::Knots(error)
    }
}

impl From<ClearanceError> for VerifyError {
    fn from(error: ClearanceError) -> Self {
        Self::Clearance(error)
    }
}

impl From<CoverageError> for VerifyError {
    fn from(error: CoverageError) -> Self {
        Self::Coverage(error)
    }
}
