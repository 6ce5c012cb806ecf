//! Joint limits, margins and violations.

use crate::joints::{AXES, JointVector};
use crate::words::angles_told_apart;
use serde::Serialize;
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Distance between the limits of a joint up to which all of it is sampled \[rad\]: joint 6 of many an arm turns by ±400°. One turn has all
/// poses, and in many turns a sample is seldom near the motion that is looked for.
pub const WIDE_RAD: f64 = 3.0 * TAU;

/// Position, speed and effort limits of the six joints, in joint order.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct JointLimits {
    /// Lowest position \[rad\]; −∞ for a continuous joint.
    pub lower: JointVector,
    /// Highest position \[rad\]; +∞ for a continuous joint.
    pub upper: JointVector,
    /// Highest speed, both ways \[rad/s\]; positive.
    pub velocity: JointVector,
    /// Highest torque \[N·m\], if the description states one: an effort of 0 means "unknown".
    pub effort: [Option<f64>; AXES],
    /// Highest acceleration and deceleration \[rad/s²\], the lesser one, if the description states one.
    #[serde(skip_serializing_if = "is_unstated")]
    pub acceleration: [Option<f64>; AXES],
    /// Highest jerk \[rad/s³\], if the description states one. Nothing keeps it: at knots the acceleration jumps.
    #[serde(skip_serializing_if = "is_unstated")]
    pub jerk: [Option<f64>; AXES],
    /// True for a lower and an upper position limit that a safety controller states: a soft one.
    #[serde(skip)]
    pub is_soft: [[bool; 2]; AXES],
}

fn is_unstated(limits: &[Option<f64>; AXES]) -> bool {
    limits.iter().all(Option::is_none)
}

/// Friction of the six joints as the description states it, in joint order; 0 where it states none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointFriction {
    /// Torque per speed \[N·m·s/rad\].
    pub viscous: [f64; AXES],
    /// Torque against any motion \[N·m\].
    pub coulomb: [f64; AXES],
}

/// Joint that is outside its position limits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LimitViolation {
    /// Joint index, 0 for joint 1.
    pub joint: usize,
    /// Position found \[rad\].
    pub position_rad: f64,
    /// Limit that is broken \[rad\].
    pub limit_rad: f64,
}

/// Decimals of an angle in degrees, if they are enough to tell the two apart.
const DECIMALS: usize = 2;

impl fmt::Display for LimitViolation {
    /// Writes the joint, its position and its limit, in degrees that differ.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [position, limit] = angles_told_apart(self.position_rad, self.limit_rad, DECIMALS);
        write!(
            f,
            "joint {} at {position} is beyond its limit of {limit}",
            self.joint + 1
        )
    }
}

impl JointLimits {
    /// Distance of each joint from its nearer limit \[rad\]: negative outside, +∞ for a continuous joint.
    #[must_use]
    pub fn margins(&self, q: &JointVector) -> JointVector {
        (q - self.lower).inf(&(self.upper - q))
    }

    /// True if every joint is at or inside its limits; false for NaN.
    #[must_use]
    pub fn contain(&self, q: &JointVector) -> bool {
        (0..AXES).all(|i| self.lower[i] <= q[i] && q[i] <= self.upper[i])
    }

    /// Returns the first joint outside its limits (or NaN), if any.
    #[must_use]
    pub fn violation(&self, q: &JointVector) -> Option<LimitViolation> {
        (0..AXES).find_map(|joint| self.violation_of(joint, q))
    }

    /// Returns every joint outside its limits (or NaN), in joint order.
    #[must_use]
    pub fn violations(&self, q: &JointVector) -> Vec<LimitViolation> {
        (0..AXES).filter_map(|joint| self.violation_of(joint, q)).collect()
    }

    fn violation_of(&self, joint: usize, q: &JointVector) -> Option<LimitViolation> {
        let (position_rad, lower, upper) = (q[joint], self.lower[joint], self.upper[joint]);
        let inside = lower <= position_rad && position_rad <= upper;
        let limit_rad = if position_rad < lower { lower } else { upper };
        (!inside).then_some(LimitViolation {
            joint,
            position_rad,
            limit_rad,
        })
    }

    /// Returns accelerations \[rad/s²\], each no greater than the description's limit.
    #[must_use]
    pub fn within_acceleration(&self, accelerations: &JointVector) -> JointVector {
        JointVector::from_fn(|i, _| self.acceleration[i].map_or(accelerations[i], |limit| accelerations[i].min(limit)))
    }

    /// Returns the nearest configuration inside the limits, joint by joint.
    #[inline]
    #[must_use]
    pub fn clamp(&self, q: &JointVector) -> JointVector {
        q.sup(&self.lower).inf(&self.upper)
    }

    /// The finite range that sampling uses \[rad\]: the limits; of a joint that turns further than [`WIDE_RAD`] or without limits the turn
    /// within them that is nearest to ±π, which has all of its poses.
    #[must_use]
    pub fn sampling_range(&self, joint: usize) -> [f64; 2] {
        self.sampling_range_around(joint, [0.0; 2])
    }

    /// The range of [`Self::sampling_range`] for motions between two positions \[rad\]: of a joint that turns further than [`WIDE_RAD`] the turn
    /// around their middle, and what lies between them.
    #[must_use]
    pub fn sampling_range_around(&self, joint: usize, positions: [f64; 2]) -> [f64; 2] {
        let (lower, upper) = (self.lower[joint], self.upper[joint]);
        if !self.is_wide(joint) {
            return [lower, upper];
        }
        let [a, b] = positions.map(|position| position.clamp(lower, upper));
        let middle = (0.5 * (a + b)).clamp(lower + PI, upper - PI);
        [
            a.min(b).min(lower.max(middle - PI)),
            a.max(b).max(upper.min(middle + PI)),
        ]
    }

    /// Returns a position of a joint, moved by the fewest whole turns to where it is half a turn or more from both limits \[rad\]; `None` where
    /// there is no such place.
    #[must_use]
    pub fn turned_inside(&self, joint: usize, position: f64) -> Option<f64> {
        let (lower, upper) = (self.lower[joint] + PI - position, self.upper[joint] - PI - position);
        let [least, most] = [(lower / TAU).ceil(), (upper / TAU).floor()];
        (least <= most).then(|| position + TAU * 0.0_f64.clamp(least, most))
    }

    /// True if a joint turns further than [`WIDE_RAD`], or without limits.
    #[must_use]
    pub fn is_wide(&self, joint: usize) -> bool {
        self.upper[joint] - self.lower[joint] > WIDE_RAD
    }
}
