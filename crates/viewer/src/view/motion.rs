//! The planned motion and its segments.

use super::numbers::Numbers;
use platewash_workcell::trajectory::{PlanSegment, SegmentKind, Trajectory};
use serde::Serialize;

/// A stretch of the motion.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Segment {
    /// What it is for.
    pub kind: SegmentKind,
    /// The plate washed, or the plate it leads to.
    pub plate: Option<usize>,
    /// Start \[s\].
    pub t_start_s: f64,
    /// End \[s\].
    pub t_end_s: f64,
}

impl From<&PlanSegment> for Segment {
    fn from(segment: &PlanSegment) -> Self {
        Self {
            kind: segment.kind,
            plate: Some(segment.plate),
            t_start_s: segment.t_start_s,
            t_end_s: segment.t_end_s,
        }
    }
}

/// The planned motion: between two knots each joint is the cubic of their positions and speeds (Hermite).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Motion {
    /// \[n\], from 0 \[s\].
    pub t_s: Numbers,
    /// \[n, 6\] \[rad\].
    pub q_rad: Numbers,
    /// \[n, 6\] \[rad/s\].
    pub qd_rad_s: Numbers,
}

impl From<&Trajectory> for Motion {
    /// Positions as the plan has them: knots lie close, and the accelerations between them are differences of positions.
    fn from(motion: &Trajectory) -> Self {
        Self {
            t_s: Numbers::f64(motion.times()),
            q_rad: Numbers::f64_rows(motion.positions().iter()),
            qd_rad_s: Numbers::f32_rows(motion.speeds().iter()),
        }
    }
}

/// The segment of a time \[s\]: at a boundary the later one.
pub(super) fn segment_at(segments: &[PlanSegment], t_s: f64) -> Option<usize> {
    segments
        .partition_point(|segment| segment.t_start_s <= t_s)
        .checked_sub(1)
}
