//! Time-optimal timing along a path of the joints.
//!
//! [`time_optimal`] makes a [`JointPath`] a motion from rest to rest that is as fast as its limits allow. The limits hold for the
//! motion itself, cubic Hermite pieces between knots: they constrain the accelerations of these, not those of the path, and no
//! motion is returned that breaks a limit anywhere.
//!
//! | concept | file |
//! | --- | --- |
//! | [`time_optimal`] | here |
//! | limits, and stretches that are slower; errors | `limits.rs`, `error.rs` |
//! | knots on the path, and where more are needed | `grid.rs`, `rounds.rs` |
//! | how the tip moves | `tip_model.rs` |
//! | constraints of an interval; linear program of an interval | `interval.rs` |
//! | backward and forward pass; the rounds of all this | `rounds.rs` |
//! | a piece of the motion | `hermite.rs` |
//! | demand of a piece on its limits | `check.rs` |

mod check;
mod error;
mod grid;
mod hermite;
mod interval;
mod limits;
mod rounds;
mod tip_model;

pub use crate::timing::error::TimingError;
pub use crate::timing::limits::{Limit, MotionLimits, SlowStretch, TipLimits};
pub use crate::timing::rounds::{LONGEST_PIECE_S, PATH_ERROR_RAD, SHORTEST_PIECE_S, TimedPath};

use crate::joint_path::JointPath;
use crate::timing::grid::Grid;
use crate::timing::rounds::Rounds;
use crate::timing::tip_model::TipModel;
use platewash_kinematics::{Frame, RobotModel};

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
    Rounds::new(Grid::new(path, tip)?, limits, slow_stretches).run()
}
