//! Why no clearance model could be made.

use super::convex::{MOST_CORNERS, MOST_VERTICES};
use crate::words::printable;
use platewash_kinematics::ToolFrameError;

/// Why no clearance model could be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClearanceError {
    /// A hull whose points span no volume.
    #[error("body '{}': its hull is flat; a convex hull needs a volume", printable(.link))]
    FlatHull {
        /// The link, the body of the tool or the obstacle.
        link: String,
    },
    /// A mesh of too many vertices for its hull to be made in time.
    #[error(
        "body '{}': its collision mesh has {found} vertices; at most {MOST_VERTICES} can be judged: simplify it",
        printable(.link)
    )]
    LargeMesh {
        /// The link, or the body of the tool.
        link: String,
        /// The vertices.
        found: usize,
    },
    /// A hull of too many corners to be judged in time.
    #[error(
        "body '{}': its convex hull has {found} corners; at most {MOST_CORNERS} can be judged: simplify its collision mesh",
        printable(.link)
    )]
    LargeHull {
        /// The link, or the body of the tool.
        link: String,
        /// The corners.
        found: usize,
    },
    /// The arm has no link that carries the tool.
    #[error(transparent)]
    Mount(#[from] ToolFrameError),
}
