//! The planned motion, as the page has it.

use super::numbers::Numbers;
use platewash_kinematics::AXES;
use platewash_motion::trajectory::Trajectory;
use serde::Serialize;
use ts_rs::TS;

/// The planned motion: between two knots each joint is the cubic of their positions and speeds (Hermite).
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Motion {
    /// \[n\], from 0 \[s\].
    pub t_s: Numbers,
    /// \[n, 6\], in double precision: knots lie close, and the accelerations between them are differences of positions \[rad\].
    pub q_rad: Numbers,
    /// \[n, 6\] \[rad/s\].
    pub qd_rad_s: Numbers,
}

impl From<&Trajectory> for Motion {
    fn from(motion: &Trajectory) -> Self {
        let (times, positions) = (motion.times(), motion.positions());
        Self {
            t_s: Numbers::f64([times.len()], times.iter().copied()),
            q_rad: Numbers::f64([positions.len(), AXES], positions.iter().flatten().copied()),
            qd_rad_s: Numbers::f32_rows(motion.speeds().iter()),
        }
    }
}
