//! Time-optimal timing along a path of the joints.
//!
//! [`time_optimal`] makes a [`JointPath`] a motion from rest to rest that is as fast as its limits allow. The limits hold for the
//! motion itself, cubic Hermite pieces between knots: they constrain the accelerations of these, not those of the path, and no
//! motion is returned that breaks a limit anywhere.
//!
//! | concept | file |
//! | --- | --- |
//! | [`time_optimal`]; limits; errors | here |
//! | knots on the path, and where more are needed | `grid.rs`, `rounds.rs` |
//! | how the tip moves | `tip_model.rs` |
//! | constraints of an interval; linear program of an interval | `interval.rs` |
//! | backward and forward pass; the rounds of all this | `rounds.rs` |
//! | a piece of the motion | `hermite.rs` |
//! | demand of a piece on its limits | `check.rs` |

mod check;
mod grid;
mod hermite;
mod interval;
mod rounds;
mod tip_model;

pub use crate::timing::rounds::{LONGEST_PIECE_S, PATH_ERROR_RAD, SHORTEST_PIECE_S};

use crate::joint_path::JointPath;
use crate::timing::grid::Grid;
use crate::timing::rounds::Rounds;
use crate::timing::tip_model::TipModel;
use platewash_kinematics::{AXES, Frame, JointVector, RobotModel};
use platewash_motion::trajectory::{KnotError, Trajectory};

/// The fastest motion along `path`, from rest to rest, within `limits`; `tip` is the point on `robot` that the limits of
/// the tip are for (unused without them).
///
/// - All samples of the path are knots; between them there are more where a piece would take longer than
///   [`LONGEST_PIECE_S`] or leave the path by more than [`PATH_ERROR_RAD`]. No piece is shorter than
///   [`SHORTEST_PIECE_S`], so that samples should not lie closer than the fastest motion passes in that time.
/// - Between neighbouring knots the acceleration of the path's parameter is constant. In this class the motion is
///   optimal up to the greed of the forward pass at points where a limit does not depend on that acceleration (Pham &
///   Pham 2018, §V), and up to about 1e-4 of its duration.
/// - Joint speeds and accelerations keep their limits exactly; so do the tip's, by a bound between samples of it
///   (see `check.rs`), all with a relative margin of 5e-7 that absorbs rounding.
/// - Where the path's own derivative is zero at an end, the motion rests there at any speed of the parameter.
///
/// The time is O(n) in the knots, with some five rounds at most; nothing depends on threads.
///
/// # Errors
/// [`TimingError`]: limits that are not positive, a path that does not move or that is out of the range of numbers.
pub fn time_optimal(
    path: &JointPath,
    robot: &RobotModel,
    tip: &Frame,
    limits: &MotionLimits,
) -> Result<TimedPath, TimingError> {
    time_optimal_slowed(path, robot, tip, limits, &[])
}

/// [`time_optimal`], with stretches of the path on which its parameter moves no faster than they say at any knot.
///
/// # Errors
/// As [`time_optimal`].
pub fn time_optimal_slowed(
    path: &JointPath,
    robot: &RobotModel,
    tip: &Frame,
    limits: &MotionLimits,
    slow_stretches: &[SlowStretch],
) -> Result<TimedPath, TimingError> {
    if let Some((limit, value)) = limits.unusable() {
        return Err(TimingError::Limit { limit, value });
    }
    let still = path.positions().iter().all(|q| *q == path.positions()[0]);
    if still && path.slopes().iter().all(|m| m.amax() == 0.0) {
        return Err(TimingError::NoMotion {
            samples: path.positions().len(),
        });
    }
    let tip = limits.tip.map(|_| TipModel::new(robot, tip));
    Rounds::new(Grid::of(path, tip)?, limits, slow_stretches).run()
}

/// A path in time.
#[derive(Debug, Clone, PartialEq)]
pub struct TimedPath {
    /// The motion, from time 0, at rest at both ends. Its knots are the path's samples and more between them.
    pub motion: Trajectory,
    /// The path's parameter at every knot; those of the samples are among them to the bit.
    pub parameters: Vec<f64>,
    /// Largest distance of a joint from the path \[rad\]: measured in the middle of every piece, where the leading term
    /// of the error of Hermite interpolation, `t² (h − t)²`, is largest.
    pub path_error_rad: f64,
}

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

/// Limits of a motion, the same in both directions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MotionLimits {
    /// Largest speed of each joint \[rad/s\]; positive, finite.
    pub velocity: JointVector,
    /// Largest acceleration of each joint \[rad/s²\]; positive, finite.
    pub acceleration: JointVector,
    /// Limits of the tip; `None` for none.
    pub tip: Option<TipLimits>,
}

/// Limits of the tip's origin in the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipLimits {
    /// Largest speed \[m/s\]; positive, finite.
    pub speed_m_s: f64,
    /// Largest magnitude of the acceleration, along and across the path together \[m/s²\]; positive, finite.
    pub acceleration_m_s2: f64,
}

/// A stretch of a path on which its parameter moves slowly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlowStretch {
    /// Range of the parameter, both ends included.
    pub u: [f64; 2],
    /// Largest speed of the parameter at a knot there, per second; positive.
    pub most: f64,
}

/// A limit by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Limit {
    /// Speed of a joint, by index.
    #[error("speed of joint {}", .0 + 1)]
    JointSpeed(usize),
    /// Acceleration of a joint, by index.
    #[error("acceleration of joint {}", .0 + 1)]
    JointAcceleration(usize),
    /// Speed of the tip.
    #[error("speed of the tip")]
    TipSpeed,
    /// Acceleration of the tip.
    #[error("acceleration of the tip")]
    TipAcceleration,
}

impl MotionLimits {
    /// The first limit that is no positive finite number, with its value.
    pub(crate) fn unusable(&self) -> Option<(Limit, f64)> {
        let joints = (0..AXES).flat_map(|joint| {
            [
                (Limit::JointSpeed(joint), self.velocity[joint]),
                (Limit::JointAcceleration(joint), self.acceleration[joint]),
            ]
        });
        let tip = self.tip.iter().flat_map(|tip| {
            [
                (Limit::TipSpeed, tip.speed_m_s),
                (Limit::TipAcceleration, tip.acceleration_m_s2),
            ]
        });
        joints.chain(tip).find(|(_, value)| !value.is_normal() || *value < 0.0)
    }

    /// The same limits, all of them multiplied by `share`.
    pub(crate) fn times(&self, share: f64) -> Self {
        Self {
            velocity: self.velocity * share,
            acceleration: self.acceleration * share,
            tip: self.tip.map(|tip| TipLimits {
                speed_m_s: tip.speed_m_s * share,
                acceleration_m_s2: tip.acceleration_m_s2 * share,
            }),
        }
    }
}
