//! Reason that a path could not be timed.

use crate::timing::limits::Limit;
use platewash_motion::trajectory::KnotError;

/// Reason that a path could not be timed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TimingError {
    /// A limit is no positive finite number.
    #[error("limit of the {limit}: {value}; it must be a positive, finite number")]
    Limit {
        /// The limit.
        limit: Limit,
        /// Its value \[rad/s, rad/s², m/s, m/s²\].
        value: f64,
    },
    /// The path stays where it is, so that there is nothing to time.
    #[error("the path does not move: all of its {samples} configurations are the same")]
    NoMotion {
        /// Samples of the path.
        samples: usize,
    },
    /// The path is so steep, so slow or so finely sampled that its time cannot be computed.
    #[error("no time can be computed at the path's parameter {u:.6}: the numbers leave the range of a double")]
    Range {
        /// Position, as the path's parameter.
        u: f64,
    },
    /// Cubics in time would leave the path by more than allowed with as many knots as may be.
    #[error(
        "at the path's parameter {u:.6} the motion leaves the path by {error_rad:.1e} rad with {knots} knots; \
         at most {allowed_rad:.1e} rad is allowed"
    )]
    PathError {
        /// Position, as the path's parameter.
        u: f64,
        /// Largest deviation of a joint there \[rad\].
        error_rad: f64,
        /// Deviation allowed \[rad\].
        allowed_rad: f64,
        /// Knots of the motion.
        knots: usize,
    },
    /// The limits are not held however long the motion takes, because its times round too coarsely: the path has
    /// samples much too close together for its length.
    #[error("a motion of {duration_s:.1} s still exceeds its limits: time would have to be stretched by {excess:.1e}")]
    Unheld {
        /// Share by which time would have to be stretched further.
        excess: f64,
        /// Duration reached \[s\].
        duration_s: f64,
    },
    /// The knots are no motion.
    #[error(transparent)]
    Knots(#[from] KnotError),
}
