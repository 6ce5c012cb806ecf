//! Why a job could not be planned.

use crate::joint_path::JointPathError;
use crate::near_pair::NearPair;
use crate::out_of_range::OutOfRange;
use crate::pattern::Shortfall;
use crate::timing::TimingError;
use crate::transit::{ClearanceShortfall, LiftLineError, TransitError};
use crate::unwashable_plate::UnwashablePlate;
use platewash_bodies::clearance::ClearanceError;
use platewash_bodies::job::{End, JobError, PlateOverlap};
use platewash_kinematics::LimitViolation;
use platewash_kinematics::ik::{IkPathError, IkSettingsError};
use platewash_motion::plan::PlanFileError;
use platewash_motion::trajectory::{KnotError, SegmentKind};
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::layout::LayoutError;
use platewash_workcell::verdict::Infeasibility;
use platewash_workcell::words::{millimetres, plate_name, printable};

/// Reason that a job could not be planned.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The job is one of the paper's program.
    #[error("the job is one of the paper's program, which is not planned as a washing")]
    PaperJob,
    /// A setting with which nothing can be planned.
    #[error(transparent)]
    Setting(#[from] OutOfRange),
    /// There is no such plate.
    #[error("there is no {}; there are {count}", plate_name(*.plate))]
    Plate {
        /// Index of the plate.
        plate: usize,
        /// Number of plates of the job.
        count: usize,
    },
    /// An order that is none.
    #[error("an order of {count} plates must name each of them once")]
    Order {
        /// Number of plates of the job.
        count: usize,
    },
    /// The terms are no job.
    #[error(transparent)]
    Job(#[from] JobError),
    /// Plates share a place where the job allows none to.
    #[error("{}", first_overlaps(.0))]
    Overlap(Vec<PlateOverlap>),
    /// No layout could be drawn.
    #[error("layout: {0}")]
    Layout(LayoutError),
    /// An end configuration lies outside the joint limits.
    #[error("at the {end} of the motion: {violation}")]
    Home {
        /// The end at fault.
        end: End,
        /// The joint, its limit and its position.
        violation: LimitViolation,
    },
    /// The arm is too near a body at an end configuration.
    #[error("at the {end} of the motion the arm is not clear: {too_near}")]
    HomeNotClear {
        /// The end at fault.
        end: End,
        /// The bodies.
        too_near: Box<ClearanceShortfall>,
    },
    /// No end configuration was stated, and none was found that is clear.
    #[error(
        "no home was found: none of {tried} configurations over all of the joints' limits keeps clear of everything{}",
        pairs_in_the_way(in_the_way)
    )]
    NoHome {
        /// Configurations that were tried.
        tried: usize,
        /// Pairs of bodies that are too near, those first that are so in most of them.
        in_the_way: Vec<NearPair>,
    },
    /// The arm holds nothing that could touch a plate.
    #[error("the arm holds no tool; washing needs one that touches the plates")]
    NoTool,
    /// The collision model could not be made.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// The arm does not suit the inverse kinematics.
    #[error(transparent)]
    IkSettings(#[from] IkSettingsError),
    /// A plate cannot be washed, or no way to was found.
    #[error("{0}")]
    Unwashable(Box<UnwashablePlate>),
    /// No layout drawn has a known way to wash every plate whole.
    #[error("no plan was found for any of {layouts} random layouts; for the last one: {last}")]
    NoneWashable {
        /// Layouts drawn.
        layouts: usize,
        /// Obstruction in the last layout, in words.
        last: String,
    },
    /// The arm cannot follow the line over a plate from the configurations found there.
    #[error(
        "no way was found for the arm to follow the line over {} up to the lift of {}: {error}",
        plate_name(*.plate),
        millimetres(*.lift_m)
    )]
    Line {
        /// The plate.
        plate: usize,
        /// Height of the line \[m\].
        lift_m: f64,
        /// Error of the inverse kinematics along the line.
        error: Box<IkPathError>,
    },
    /// The arm can follow a wash path, but no path that was tried keeps the promises of the job.
    #[error("no way was found to wash {} as required: {shortfall}", plate_name(*.plate))]
    Promise {
        /// The plate.
        plate: usize,
        /// Promise that is not kept, with the value found and the value required.
        shortfall: Shortfall,
    },
    /// The tool would tilt too far between the points that were solved.
    #[error(
        "{}: in the motion found, the tool tilts by up to {:.4}° during its {}; the job and the sponge allow {:.4}°, and \
         some of it is needed as room: allow more",
        plate_name(*.plate), tilt_rad.to_degrees(), kind.name(), most_rad.to_degrees()
    )]
    Tilt {
        /// The plate.
        plate: usize,
        /// The segment of the motion.
        kind: SegmentKind,
        /// The largest tilt seen \[rad\].
        tilt_rad: f64,
        /// Largest angle allowed \[rad\].
        most_rad: f64,
    },
    /// The line over a plate is no path.
    #[error(transparent)]
    LiftLine(#[from] LiftLineError),
    /// There is no transit between two plates, or from or to home.
    #[error(transparent)]
    Transit(TransitError),
    /// A path that cannot be splined.
    #[error(transparent)]
    Path(#[from] JointPathError),
    /// A path that cannot be timed.
    #[error(transparent)]
    Timing(#[from] TimingError),
    /// Motions that don't fit together.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// The plan cannot be sealed.
    #[error(transparent)]
    Seal(#[from] PlanFileError),
    /// Planning was given up.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl PlanError {
    /// Returns true where the input is valid but no plan was found.
    #[must_use]
    pub fn is_infeasible(&self) -> bool {
        self.infeasibility().is_some()
    }

    /// Returns the verdict on a job without a plan: proved infeasible, or no way found; `None` for bad input.
    #[must_use]
    pub fn infeasibility(&self) -> Option<Infeasibility> {
        let found = |proved| Some(Infeasibility::proved_if(proved));
        match self {
            Self::Layout(error) => error.infeasibility(),
            Self::Overlap(_) => found(true),
            Self::HomeNotClear { too_near, .. } => found(too_near.is_below_asked()),
            Self::Transit(TransitError::Home { too_near }) => {
                found(too_near.as_ref().is_some_and(|too_near| too_near.is_below_asked()))
            }
            Self::Unwashable(plate) => found(plate.is_proved()),
            Self::NoHome { .. }
            | Self::NoneWashable { .. }
            | Self::Line { .. }
            | Self::Promise { .. }
            | Self::Tilt { .. } => found(false),
            Self::Transit(error) if error.is_infeasible() => found(false),
            _ => None,
        }
    }
}

// The messages above contain those of their causes. The causes are therefore not repeated as sources.
impl From<LayoutError> for PlanError {
    fn from(error: LayoutError) -> Self {
        Self::Layout(error)
    }
}

impl From<ClearanceError> for PlanError {
    fn from(error: ClearanceError) -> Self {
        Self::Clearance(error)
    }
}

impl From<TransitError> for PlanError {
    fn from(error: TransitError) -> Self {
        match error {
            TransitError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Transit(error),
        }
    }
}

/// Names the pair that is in the way most often, and one that is so by design, with advice; empty where there is none.
fn pairs_in_the_way(in_the_way: &[NearPair]) -> String {
    let names = |near: &NearPair| near.pair.each_ref().map(|name| printable(name)).join(" and ");
    let Some(first) = in_the_way.first() else {
        return String::new();
    };
    let most_often = format!("; most often too near are {}, in {} of them", names(first), first.count);
    let by_design = in_the_way.iter().find(|near| near.is_by_design());
    let advice = by_design.map_or_else(String::new, |near| {
        format!(
            "; {} are at most {:.1} mm apart in all of them: state a clearance of their own ([[reduced_clearance]])",
            names(near),
            1e3 * near.most_m
        )
    });
    most_often + &advice
}

/// The first of some overlaps, and how many more there are.
fn first_overlaps(overlaps: &[PlateOverlap]) -> String {
    const FEW: usize = 3;
    let told: Vec<_> = overlaps.iter().take(FEW).map(ToString::to_string).collect();
    let more = match overlaps.len().saturating_sub(FEW) {
        0 => String::new(),
        more => format!("; and {more} more"),
    };
    format!("{}{more}", told.join("; "))
}
