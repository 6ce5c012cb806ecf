//! Reasons that a plan cannot be judged.

use platewash_bodies::clearance::ClearanceError;
use platewash_bodies::coverage::CoverageError;
use platewash_kinematics::words::distinct_decimals;
use platewash_motion::trajectory::KnotError;
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::job::TermsError;
use platewash_workcell::words::{count_with_noun, printable};

/// Reason that a plan cannot be judged. A plan that breaks a requirement is no error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ProveError {
    /// The plan is a run of the paper's program.
    #[error("the plan is a run of the paper's program; there is no certificate for one")]
    PaperRun,
    /// The work was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The job of the plan cannot be judged.
    #[error("the plan's job: {}", printable(&.0.to_string()))]
    Job(TermsError),
    /// A body of the tool or an obstacle has no finite size above 0 or no valid pose.
    #[error("\"{}\": a body must have a finite size above 0 and a pose; lengths up to 1000 m can be judged", printable(.name))]
    Body {
        /// Name of the body.
        name: String,
    },
    /// The knots do not form a motion.
    #[error(transparent)]
    Knots(#[from] KnotError),
    /// The motion has fewer than two knots.
    #[error("{}; a motion has at least 2", count_with_noun(*.found, "knot"))]
    NoMotion {
        /// Number of knots found.
        found: usize,
    },
    /// A piece of the motion is so short that its cubic cannot be computed.
    #[error("the piece from knot {piece} to knot {} lasts {length_s:.3e} s; the shortest that can be judged lasts {least_s:e} s", .piece + 1)]
    TooShort {
        /// Index of the piece, and of the knot that it starts from.
        piece: usize,
        /// Duration of the piece \[s\].
        length_s: f64,
        /// Least duration \[s\].
        least_s: f64,
    },
    /// A joint turns so far that its sine cannot be computed accurately.
    #[error("joint {} gets to {} rad; no more than ±{most_rad} rad can be judged", .joint + 1, far(*.position_rad, *.most_rad))]
    TurnsTooFar {
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Joint position \[rad\].
        position_rad: f64,
        /// Greatest position that can be judged \[rad\].
        most_rad: f64,
    },
    /// The plan has more of something than any plan for that many plates needs.
    #[error("{found} {what} for {}; there are {most} at most", count_with_noun(*.plates, "plate"))]
    TooMany {
        /// Kind of thing: segments, wash paths, or entries of the order.
        what: &'static str,
        /// Number found.
        found: usize,
        /// Number of plates.
        plates: usize,
        /// Greatest number allowed.
        most: usize,
    },
    /// The rules of a motion or its workcell cannot be judged.
    #[error("{}", printable(&.0.to_string()))]
    Rules(TermsError),
    /// Two bodies have the same name, by which pairs are left out.
    #[error("more than one body is named \"{}\"; each must have a name of its own", printable(.name))]
    NameTwice {
        /// The name.
        name: String,
    },
    /// The collision model cannot be built.
    #[error("clearance: {0}")]
    Clearance(ClearanceError),
    /// Coverage cannot be measured.
    #[error("coverage: {0}")]
    Coverage(CoverageError),
}

/// Formats an angle \[rad\] beyond a limit with enough digits to tell them apart.
fn far(position_rad: f64, most_rad: f64) -> String {
    const WRITTEN_OUT: f64 = 1e6;
    if position_rad < WRITTEN_OUT {
        let [far, _] = distinct_decimals(position_rad, most_rad, 1);
        return far;
    }
    format!("{position_rad:.3e}")
}

// The message above holds that of its cause, which is therefore not told again as a source.
impl From<ClearanceError> for ProveError {
    fn from(error: ClearanceError) -> Self {
        Self::Clearance(error)
    }
}
