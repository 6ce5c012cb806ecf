//! Errors of a job.

use crate::clearance::{ClearanceError, FixedBody, FixedOverlap, StillPair};
use crate::job::kind::PlanKind;
use crate::layout::MAX_PLATES;
use crate::obstacle::ObstacleFault;
use crate::plate::GREATEST_M;
use crate::words::{millimetres, plate_name, printable};
use crate::workcell::{ArmId, MOST_BODIES};
use platewash_kinematics::LimitViolation;
use serde::{Deserialize, Serialize};

/// Reason that a job is invalid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JobError {
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
    /// Obstacles reach into plates or the arm's base, or plates reach into the base.
    #[error("{}", overlaps(.0))]
    Standing(Vec<FixedOverlap>),
    /// Pairs of moving bodies are too near each other whose distance no joint changes.
    #[error("{}", too_near(.pairs, *.required_m))]
    StillNear {
        /// The pairs.
        pairs: Vec<StillPair>,
        /// Clearance that is required of most pairs \[m\].
        required_m: f64,
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
    /// The terms are for another arm.
    #[error("the job is for the arm \"{}\" with description {}; given is \"{}\" with {}", .job.name, .job.urdf_sha256, .given.name, .given.urdf_sha256)]
    OtherArm {
        /// Arm of the job.
        job: Box<ArmId>,
        /// Arm that was given.
        given: Box<ArmId>,
    },
    /// An end configuration is beyond the arm's limits.
    #[error("at the {end} of the motion: {violation}")]
    Home {
        /// End of the motion.
        end: End,
        /// Joint and violation.
        violation: LimitViolation,
    },
    /// A shape of the arm is invalid.
    #[error(transparent)]
    Clearance(#[from] ClearanceError),
}

/// Formats the first few overlaps.
fn overlaps(all: &[FixedOverlap]) -> String {
    const FEW: usize = 3;
    let one = |overlap: &FixedOverlap| {
        let FixedOverlap {
            body: standing,
            other,
            by_m,
        } = overlap;
        let parts = match standing {
            FixedBody::Parts(_) => " (in convex parts, which hold more than the mesh)",
            FixedBody::Obstacle(_) | FixedBody::Plate(_) => "",
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

fn too_near(pairs: &[StillPair], required_m: f64) -> String {
    let one = |still: &StillPair| {
        let [a, b] = [&still.pair.a, &still.pair.b].map(|name| printable(name));
        let required = match still.only_contact {
            true => "no contact is allowed".to_owned(),
            false => format!("{} are required", millimetres(still.pair.required_m(required_m))),
        };
        let kept = if still.at_least_m > 0.0 {
            format!("keeps {} from", millimetres(still.at_least_m))
        } else {
            format!("reaches {} into", millimetres(-still.at_least_m))
        };
        format!("{a} {kept} {b} at every configuration, and {required}: no motion changes that")
    };
    pairs.iter().map(one).collect::<Vec<_>>().join("; ")
}

/// End of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Start of the motion.
    Start,
    /// End of the motion.
    End,
}

impl std::fmt::Display for End {
    /// Writes the name that files have.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.serialize(f)
    }
}
