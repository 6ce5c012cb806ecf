//! Errors of the terms of a job.

use crate::job::kind::PlanKind;
use crate::layout::MAX_PLATES;
use crate::obstacle::ObstacleFault;
use crate::plate::GREATEST_M;
use crate::words::{plate_name, printable};
use crate::workcell::MOST_BODIES;

/// Reason that the terms of a job are invalid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TermsError {
    /// The job has contact requirements, but the sponge states no stiffness.
    #[error(
        "workcell.tool.sponge.stiffness_pa is missing; a promise about contact needs the least and the greatest stiffness of the sponge"
    )]
    NoStiffness,
    /// The holder of the plates contradicts the rest of the job, or says too little.
    #[error("job: requirements.holder {0}")]
    Holder(&'static str),
    /// A number is out of range.
    #[error("job: {name} must be {expected}; found {found}")]
    Number {
        /// Path of the number in the job.
        name: &'static str,
        /// Allowed range, in words.
        expected: String,
        /// Number found.
        found: f64,
    },
    /// The seed is too large for JSON.
    #[error("job: seed must be at most 2^53 − 1; found {found}")]
    Seed {
        /// Seed found.
        found: u64,
    },
    /// The job has no plates, or too many.
    #[error("{found} plates; a job has at least 1 and at most {MAX_PLATES}")]
    PlateCount {
        /// Number of plates found.
        found: usize,
    },
    /// A plate has an invalid size or pose.
    #[error(
        "{}: its centre, height, radius and thickness must be finite, the latter two above 0; a foot has a height above 0 and \
         a radius above 0, within the rim",
        plate_name(*.plate)
    )]
    NoPlate {
        /// Index of the plate.
        plate: usize,
    },
    /// The pose of the arm's mount is invalid.
    #[error(
        "the mount of the arm must be a place within {GREATEST_M} m of the world's origin along each axis, and a rotation"
    )]
    Mount,
    /// There are more bodies than can be judged in reasonable time.
    #[error("{found} bodies of the tool and obstacles; {MOST_BODIES} can be judged at most")]
    TooManyBodies {
        /// Number of bodies.
        found: usize,
    },
    /// An obstacle is invalid.
    #[error("obstacle '{}': {fault}", printable(.name))]
    Obstacle {
        /// Name of the obstacle.
        name: String,
        /// Reason.
        fault: ObstacleFault,
    },
    /// A run of the paper's program is marked as a dry run.
    #[error("a run of the paper's program is not a dry run")]
    PaperDryRun,
    /// The parent of a dry run is not the hash of a plan.
    #[error("job: dry_run.parent must be the hash of a plan, 64 digits of lower-case hexadecimal")]
    Parent,
    /// The job makes a statement that its kind of plan has no use for, or lacks one that it needs.
    #[error("job: {kind} {} {path}", if *.is_needed { "needs" } else { "cannot have" })]
    Statement {
        /// Kind of the plan.
        kind: PlanKind,
        /// Path of the statement in a plan file.
        path: &'static str,
        /// True if the statement is missing.
        is_needed: bool,
    },
    /// The statement about a recovery does not fit the job.
    #[error("job: recovery: {fault}")]
    Recovery {
        /// Fault, in words.
        fault: &'static str,
    },
}
