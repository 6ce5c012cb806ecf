//! Reasons that a mesh is not a valid body.

/// Greatest number of triangles of a mesh that is decomposed.
pub(super) const MOST_TRIANGLES: usize = 20_000;

/// Reason that a mesh is not a valid body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// The mesh has no triangles.
    #[error("it has no triangles")]
    Empty,
    /// A coordinate is not a number.
    #[error("a corner of triangle {triangle} is not a number")]
    NotFinite {
        /// Index of the triangle, from 0.
        triangle: usize,
    },
    /// The mesh lies in a plane.
    #[error("it is flat; a body needs a volume")]
    Flat,
    /// The mesh has too many corners.
    #[error("it has {found} distinct corners; at most {most} can be judged: simplify the mesh")]
    TooManyCorners {
        /// Number of corners.
        found: usize,
        /// Greatest number.
        most: usize,
    },
    /// The mesh has too many triangles.
    #[error("it has {found} triangles; at most {MOST_TRIANGLES} can be decomposed (its hull may have more)")]
    TooMany {
        /// Number of triangles.
        found: usize,
    },
    /// The collision library fails to decompose the mesh.
    #[error(
        "it cannot be cut into convex parts: the collision library fails; simplify the mesh, cut it into several, or let its hull stand for it"
    )]
    NotDecomposed,
}
