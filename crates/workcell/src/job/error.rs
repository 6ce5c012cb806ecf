//! Why a job is none.

use crate::clearance::{ClearanceError, Standing, StandingOverlap};
use crate::layout::MAX_PLATES;
use crate::obstacle::ObstacleFault;
use crate::plate::GREATEST_M;
use crate::words::{millimetres, printable};
use crate::workcell::{ArmId, MOST_BODIES};
use platewash_kinematics::LimitViolation;
use serde::{Deserialize, Serialize};

/// Why a job is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JobError {
    /// A promise about contact, and a sponge whose stiffness is not stated.
    #[error(
        "workcell.tool.sponge.stiffness_pa is missing; a promise about contact needs the least and the greatest stiffness of the sponge"
    )]
    NoStiffness,
    /// A number out of range.
    #[error("job: {name} must be {expected}; found {found}")]
    Number {
        /// Its place in the job.
        name: &'static str,
        /// What it must be.
        expected: String,
        /// What it is.
        found: f64,
    },
    /// A seed that JSON cannot say.
    #[error("job: seed must be at most 2^53 − 1; found {found}")]
    Seed {
        /// What it is.
        found: u64,
    },
    /// No plates, or too many.
    #[error("{found} plates; a job has at least 1 and at most {MAX_PLATES}")]
    PlateCount {
        /// Plates found.
        found: usize,
    },
    /// A plate of no size, or nowhere.
    #[error(
        "plate {plate}: its centre, height, radius and thickness must be finite, the latter two above 0; a foot has a height above 0 and \
         a radius above 0, within the rim"
    )]
    NoPlate {
        /// Index of the plate.
        plate: usize,
    },
    /// The arm is mounted nowhere.
    #[error(
        "the mount of the arm must be a place within {GREATEST_M} m of the world's origin along each axis, and a rotation"
    )]
    Mount,
    /// More bodies than can be judged soon.
    #[error("{found} bodies of the tool and obstacles; {MOST_BODIES} can be judged at most")]
    TooManyBodies {
        /// How many there are.
        found: usize,
    },
    /// An obstacle that is none.
    #[error("obstacle '{}': {fault}", printable(.name))]
    Obstacle {
        /// The obstacle.
        name: String,
        /// Why.
        fault: ObstacleFault,
    },
    /// Obstacles that reach into plates or the arm's base, plates that reach into the base.
    #[error("{}", overlaps(.0))]
    Standing(Vec<StandingOverlap>),
    /// A dry run of the paper's program.
    #[error("a run of the paper's program is no dry run")]
    PaperDryRun,
    /// A dry run of what is no plan.
    #[error("job: dry_run.parent must be the hash of a plan, 64 digits of lower-case hexadecimal")]
    Parent,
    /// The terms are for another arm.
    #[error("the job is for the arm \"{}\" with description {}; given is \"{}\" with {}", .job.name, .job.urdf_sha256, .given.name, .given.urdf_sha256)]
    OtherArm {
        /// That of the job.
        job: Box<ArmId>,
        /// The one given.
        given: Box<ArmId>,
    },
    /// An end configuration beyond the arm's limits.
    #[error("at the {end} of the motion: {violation}")]
    Home {
        /// Which end.
        end: End,
        /// Which joint, and by how much.
        violation: LimitViolation,
    },
    /// A shape of the arm is none.
    #[error(transparent)]
    Clearance(#[from] ClearanceError),
}

/// What stands where it cannot, the first few.
fn overlaps(all: &[StandingOverlap]) -> String {
    const FEW: usize = 3;
    let one = |overlap: &StandingOverlap| {
        let StandingOverlap { standing, other, by_m } = overlap;
        let parts = match standing {
            Standing::Parts(_) => " (in convex parts, which hold more than the mesh)",
            Standing::Obstacle(_) | Standing::Plate(_) => "",
        };
        format!(
            "{standing} reaches {} into {}{parts}",
            millimetres(*by_m),
            printable(other)
        )
    };
    let few: Vec<_> = all.iter().take(FEW).map(one).collect();
    let more = all.len().saturating_sub(FEW);
    let more = if more > 0 {
        format!("; and {more} more")
    } else {
        String::new()
    };
    format!("{}{more}", few.join("; "))
}

/// An end of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Where it starts.
    Start,
    /// Where it ends.
    End,
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Start => "start",
            Self::End => "end",
        })
    }
}
