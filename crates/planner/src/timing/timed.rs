//! A path in time.

use platewash_workcell::trajectory::Trajectory;

/// A path in time.
#[derive(Debug, Clone, PartialEq)]
pub struct Timed {
    /// The motion, from time 0, at rest at both ends. Its knots are the path's samples and more between them.
    pub motion: Trajectory,
    /// The path's parameter at every knot; those of the samples are among them to the bit.
    pub parameters: Vec<f64>,
    /// Largest distance of a joint from the path \[rad\]: measured in the middle of every piece, where the leading term
    /// of the error of Hermite interpolation, `t² (h − t)²`, is largest.
    pub path_error_rad: f64,
}
