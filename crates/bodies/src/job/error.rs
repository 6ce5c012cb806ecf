//! Errors of a job.

use crate::clearance::{ClearanceError, FixedBody, FixedOverlap, StillPair};
use platewash_kinematics::LimitViolation;
use platewash_workcell::ArmId;
use platewash_workcell::job::TermsError;
use platewash_workcell::words::{millimetres, printable};
use serde::{Deserialize, Serialize};

/// Reason that a job is invalid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum JobError {
    /// The terms are invalid.
    #[error(transparent)]
    Terms(#[from] TermsError),
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
