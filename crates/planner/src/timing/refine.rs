//! Where further knots are needed: where a piece takes long, or leaves the path.

use super::error::TimingError;
use super::hermite::Piece;

/// The longest piece of a motion \[s\]; a fortieth of the duration of motions below 1 s, a thousandth of that of motions
/// above 25 s.
pub const LONGEST_PIECE_S: f64 = 0.025;

/// How far a joint may leave its path between knots \[rad\].
pub const PATH_ERROR_RAD: f64 = 5e-6;

/// Length of the new pieces over the longest allowed: some room for what the next round changes.
const ROOM: f64 = 0.8;
/// Pieces that one piece becomes at most, in one round.
const MOST_PARTS: f64 = 64.0;
/// Knots of a motion at most, for each sample of its path, and for any path.
const MOST_KNOTS: [usize; 2] = [16, 4096];

/// How a piece fares: x = ṡ² at its ends, length in s, duration and deviation from the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    /// x at both ends.
    pub x: [f64; 2],
    /// Duration \[s\].
    pub h: f64,
    /// Deviation from the path in its middle \[rad\].
    pub error_rad: f64,
}

impl Course {
    /// The share of the piece's length in s that is done after the share `t` of its duration, s̈ being constant.
    pub fn done(&self, t: f64) -> f64 {
        let [start, end] = self.x.map(f64::sqrt);
        (2.0 * start + (end - start) * t) * t / (start + end)
    }

    /// Measures a piece; `position` is the path's at a share of the piece's length.
    pub fn measured(x: [f64; 2], piece: &Piece, position: impl Fn(f64) -> platewash_kinematics::JointVector) -> Self {
        let mut course = Self {
            x,
            h: piece.h,
            error_rad: 0.0,
        };
        let [q, ..] = piece.at(0.5 * piece.h);
        course.error_rad = (q - position(course.done(0.5))).amax();
        course
    }

    /// Parts that this piece should become; 1 for none.
    fn parts(&self, longest_s: f64) -> usize {
        let slow = if self.h > longest_s {
            self.h / (ROOM * longest_s)
        } else {
            1.0
        };
        // The error of a piece falls with the fourth power of its length.
        let bent = if self.error_rad > PATH_ERROR_RAD {
            (self.error_rad / (0.5 * PATH_ERROR_RAD)).sqrt().sqrt().max(2.0)
        } else {
            1.0
        };
        slow.max(bent).min(MOST_PARTS).ceil() as usize
    }

    /// Places for further knots as shares of its length, equally far in time.
    pub fn shares(&self, longest_s: f64, shares: &mut Vec<f64>) {
        let parts = self.parts(longest_s);
        shares.extend((1..parts).map(|k| self.done(k as f64 / parts as f64)));
    }
}

/// The longest piece of a motion of this duration \[s\].
pub(super) fn longest_s(duration_s: f64) -> f64 {
    LONGEST_PIECE_S.clamp(1e-3 * duration_s, duration_s / 40.0)
}

/// Knots that are missing.
pub(super) fn missing(courses: &[Course], longest_s: f64) -> usize {
    courses.iter().map(|course| course.parts(longest_s) - 1).sum()
}

/// Whether a path of so many samples may have so many knots.
pub(super) fn affordable(samples: usize, knots: usize) -> bool {
    knots <= samples.saturating_mul(MOST_KNOTS[0]).saturating_add(MOST_KNOTS[1])
}

/// Refuses a motion that leaves its path too far; `u` is the path's parameter at a knot.
pub(super) fn close(courses: &[Course], u: impl Fn(usize) -> f64) -> Result<f64, TimingError> {
    let mut worst = (0, 0.0);
    for (k, course) in courses.iter().enumerate() {
        if course.error_rad > worst.1 {
            worst = (k, course.error_rad);
        }
    }
    if worst.1 <= PATH_ERROR_RAD {
        return Ok(worst.1);
    }
    Err(TimingError::PathError {
        u: u(worst.0),
        error_rad: worst.1,
        allowed_rad: PATH_ERROR_RAD,
        knots: courses.len() + 1,
    })
}
