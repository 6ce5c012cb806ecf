//! Joint motion over time: knots (t, q, q̇) with cubic Hermite segments between them.
//!
//! Each segment is a cubic per joint, so that the extremes of position, speed and acceleration are exact: speed is a
//! parabola, acceleration a line.
//!
//! The segments of a motion have kinds.

use platewash_kinematics::{AXES, JointVector};
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Knots of a motion; times ascend strictly from 0.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Trajectory {
    /// Times \[s\].
    t_s: Vec<f64>,
    /// Joint positions \[rad\].
    q_rad: Vec<JointVector>,
    /// Joint speeds \[rad/s\].
    qd_rad_s: Vec<JointVector>,
}

/// State of the joints at a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointState {
    /// Positions \[rad\].
    pub q: JointVector,
    /// Speeds \[rad/s\].
    pub qd: JointVector,
    /// Accelerations \[rad/s²\], at a knot those after it.
    pub qdd: JointVector,
}

/// Extreme values within one segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentExtremes {
    /// Start and end \[s\].
    pub span_s: [f64; 2],
    /// Lowest and highest position of each joint \[rad\].
    pub position: [JointVector; 2],
    /// Largest speed of each joint \[rad/s\].
    pub speed: JointVector,
    /// Largest acceleration of each joint \[rad/s²\].
    pub acceleration: JointVector,
    /// Jerk of each joint, constant within the segment \[rad/s³\].
    pub jerk: JointVector,
}

/// Reason that knots do not form a motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KnotError {
    /// The lists differ in length.
    #[error("knots: {times} times, {positions} positions and {speeds} speeds; there must be as many of each")]
    Count {
        /// Number of times.
        times: usize,
        /// Number of positions.
        positions: usize,
        /// Number of speeds.
        speeds: usize,
    },
    /// A number is not finite.
    #[error("knot {knot}: not finite")]
    NotFinite {
        /// Index of the knot.
        knot: usize,
    },
    /// Times do not ascend strictly from 0.
    #[error("knot {knot}: time {t_s} s; times must ascend strictly, from 0")]
    Time {
        /// Index of the knot.
        knot: usize,
        /// Time of the knot \[s\].
        t_s: f64,
    },
    /// A piece does not begin where the one before ends.
    #[error("piece {knot} begins at other joint positions than the piece before it ends")]
    Apart {
        /// Index of the piece.
        knot: usize,
    },
}

impl Trajectory {
    /// Builds a motion from its knots.
    ///
    /// # Errors
    /// [`KnotError`] with the first knot that does not fit.
    pub fn from_knots(t_s: Vec<f64>, q_rad: Vec<JointVector>, qd_rad_s: Vec<JointVector>) -> Result<Self, KnotError> {
        if t_s.len() != q_rad.len() || t_s.len() != qd_rad_s.len() {
            return Err(KnotError::Count {
                times: t_s.len(),
                positions: q_rad.len(),
                speeds: qd_rad_s.len(),
            });
        }
        for (knot, &time) in t_s.iter().enumerate() {
            let numbers = q_rad[knot].iter().chain(qd_rad_s[knot].iter());
            if !time.is_finite() || !numbers.into_iter().all(|v| v.is_finite()) {
                return Err(KnotError::NotFinite { knot });
            }
            let fits = if knot == 0 { time == 0.0 } else { time > t_s[knot - 1] };
            if !fits {
                return Err(KnotError::Time { knot, t_s: time });
            }
        }
        Ok(Self { t_s, q_rad, qd_rad_s })
    }

    /// Builds a motion through positions at equal time steps: speeds at the knots are central differences, and zero at both ends (a
    /// Catmull–Rom curve at rest at its ends).
    #[must_use]
    pub fn through(positions: Vec<JointVector>, dt_s: f64) -> Self {
        let n = positions.len();
        let speed = |k: usize| match k {
            0 => JointVector::zeros(),
            _ if k + 1 == n => JointVector::zeros(),
            _ => (positions[k + 1] - positions[k - 1]) / (2.0 * dt_s),
        };
        Self {
            t_s: (0..n).map(|k| k as f64 * dt_s).collect(),
            qd_rad_s: (0..n).map(speed).collect(),
            q_rad: positions,
        }
    }

    /// Times of the knots \[s\].
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.t_s
    }

    /// Positions at the knots \[rad\].
    #[must_use]
    pub fn positions(&self) -> &[JointVector] {
        &self.q_rad
    }

    /// Speeds at the knots \[rad/s\].
    #[must_use]
    pub fn speeds(&self) -> &[JointVector] {
        &self.qd_rad_s
    }

    /// Time of the last knot \[s\]; 0 for an empty motion.
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.t_s.last().copied().unwrap_or(0.0)
    }

    /// Returns the state at time `t` \[s\]; `None` for an empty motion or NaN. Before the first knot and after the last one the arm rests
    /// there, with zero speeds and accelerations.
    #[must_use]
    pub fn at(&self, t: f64) -> Option<JointState> {
        if t.is_nan() {
            return None;
        }
        let still = JointVector::zeros();
        let after = self.t_s.partition_point(|&knot| knot <= t);
        let k = after.saturating_sub(1).min(self.t_s.len().saturating_sub(2));
        let mut state = match self.cubic(k) {
            Some(cubic) => cubic.at((t - self.t_s[k]).clamp(0.0, cubic.h)),
            None => JointState {
                q: *self.q_rad.first()?,
                qd: still,
                qdd: still,
            },
        };
        if !(0.0..=self.duration_s()).contains(&t) {
            (state.qd, state.qdd) = (still, still);
        }
        Some(state)
    }

    /// Returns the extremes of every segment, in time order.
    pub fn extremes(&self) -> impl Iterator<Item = SegmentExtremes> + '_ {
        (0..self.t_s.len().saturating_sub(1)).filter_map(|k| {
            let span_s = [self.t_s[k], self.t_s[k + 1]];
            self.cubic(k).map(|cubic| cubic.extremes(span_s))
        })
    }

    fn cubic(&self, k: usize) -> Option<Cubic> {
        let h = self.t_s.get(k + 1)? - self.t_s[k];
        let (q0, q1) = (self.q_rad[k], self.q_rad[k + 1]);
        let (v0, v1) = (self.qd_rad_s[k], self.qd_rad_s[k + 1]);
        let slope = (q1 - q0) / h;
        Some(Cubic {
            h,
            c: [
                q0,
                v0,
                (slope * 3.0 - v0 * 2.0 - v1) / h,
                (v0 + v1 - slope * 2.0) / (h * h),
            ],
        })
    }
}

/// `q(u) = c₀ + c₁u + c₂u² + c₃u³` for u in [0, h].
struct Cubic {
    h: f64,
    c: [JointVector; 4],
}

impl Cubic {
    fn at(&self, u: f64) -> JointState {
        let [c0, c1, c2, c3] = &self.c;
        JointState {
            q: c0 + (c1 + (c2 + c3 * u) * u) * u,
            qd: c1 + (c2 * 2.0 + c3 * (3.0 * u)) * u,
            qdd: c2 * 2.0 + c3 * (6.0 * u),
        }
    }

    fn extremes(&self, span_s: [f64; 2]) -> SegmentExtremes {
        let (start, end) = (self.at(0.0), self.at(self.h));
        let mut extremes = SegmentExtremes {
            span_s,
            position: [start.q.inf(&end.q), start.q.sup(&end.q)],
            speed: start.qd.abs().sup(&end.qd.abs()),
            acceleration: start.qdd.abs().sup(&end.qdd.abs()),
            jerk: self.c[3].abs() * 6.0,
        };
        for joint in 0..AXES {
            for u in self.turning_points(joint) {
                let state = self.at(u);
                let [least, most] = &mut extremes.position;
                least[joint] = least[joint].min(state.q[joint]);
                most[joint] = most[joint].max(state.q[joint]);
                extremes.speed[joint] = extremes.speed[joint].max(state.qd[joint].abs());
            }
        }
        extremes
    }

    /// Times in (0, h) at which a joint's speed is zero (position turns) or extreme.
    fn turning_points(&self, joint: usize) -> impl Iterator<Item = f64> {
        let [a, b, c] = [3.0 * self.c[3][joint], 2.0 * self.c[2][joint], self.c[1][joint]];
        let discriminant = b * b - 4.0 * a * c;
        let root = discriminant.max(0.0).sqrt();
        // The numerically stable pair of roots of a u² + b u + c = 0 (Numerical Recipes, §5.6).
        let sum = -0.5 * (b + if b < 0.0 { -root } else { root });
        let stationary = [sum / a, c / sum].into_iter().filter(move |_| discriminant >= 0.0);
        let h = self.h;
        stationary.chain([-b / (2.0 * a)]).filter(move |u| *u > 0.0 && *u < h)
    }
}

/// Kind of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum SegmentKind {
    /// From the start to the first approach, or to the first waypoint.
    Depart,
    /// Down to a plate along its normal.
    Approach,
    /// Washing a plate.
    Wash,
    /// Up from a plate along its normal.
    Retreat,
    /// From one plate to the next.
    Transit,
    /// From the last plate home.
    Return,
}

impl SegmentKind {
    /// Returns the word used in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Depart => "depart",
            Self::Approach => "approach",
            Self::Wash => "wash",
            Self::Retreat => "retreat",
            Self::Transit => "transit",
            Self::Return => "return",
        }
    }

    /// True if the tip is on a plate, or on the normal over it.
    #[must_use]
    pub fn is_at_plate(self) -> bool {
        matches!(self, Self::Approach | Self::Wash | Self::Retreat)
    }
}

/// Segment of a plan in time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct PlanSegment {
    /// Kind of the segment.
    pub kind: SegmentKind,
    /// Index of the plate that is washed, or that the segment leads to.
    pub plate: usize,
    /// Start \[s\].
    pub t_start_s: f64,
    /// End \[s\].
    pub t_end_s: f64,
}
