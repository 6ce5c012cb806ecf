//! Errors of building a clearance model.

use crate::clearance::convex::{MOST_CORNERS, MOST_VERTICES};
use platewash_kinematics::ToolFrameError;
use platewash_workcell::words::printable;

/// Reason that no clearance model could be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClearanceError {
    /// The points of a hull span no volume.
    #[error("body '{}': its hull is flat; a convex hull needs a volume", printable(.link))]
    FlatHull {
        /// Name of the link, the body of the tool or the obstacle.
        link: String,
    },
    /// A mesh has too many vertices for its hull to be computed in time.
    #[error(
        "body '{}': its collision mesh has {found} vertices; at most {MOST_VERTICES} can be judged: simplify it",
        printable(.link)
    )]
    LargeMesh {
        /// Name of the link, or the body of the tool.
        link: String,
        /// Number of vertices.
        found: usize,
    },
    /// A hull has too many corners to be judged in time.
    #[error(
        "body '{}': its convex hull has {found} corners; at most {MOST_CORNERS} can be judged: simplify its collision mesh",
        printable(.link)
    )]
    LargeHull {
        /// Name of the link, or the body of the tool.
        link: String,
        /// Number of corners.
        found: usize,
    },
    /// A pair cannot have a clearance of its own.
    #[error(
        "reduced clearance of '{}' and '{}': {fault}; it is for two bodies of the arm or its tool that are checked against each other",
        printable(&.pair[0]), printable(&.pair[1])
    )]
    NotReducible {
        /// Names of the bodies.
        pair: [String; 2],
        /// Reason.
        fault: &'static str,
    },
    /// The arm has no link that carries the tool.
    #[error(transparent)]
    Mount(#[from] ToolFrameError),
}
