//! Why no clearance model could be made.

/// Why no clearance model could be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ClearanceError {
    /// A mesh whose points span no volume.
    #[error("link '{link}': its collision mesh is flat; a convex hull needs a volume")]
    FlatHull {
        /// The link, the body of the tool or the obstacle.
        link: String,
    },
}
