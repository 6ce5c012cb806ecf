//! Moments of a wash, what may happen between two of them, and what a place is wanted to get through them.

use super::SpongePose;
use nalgebra::Vector3;

/// A moment of a wash, in the frame of the plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Its time \[s\].
    pub t_s: f64,
    /// Where the sponge stands.
    pub pose: SpongePose,
    /// Speed of the tip \[m/s\].
    pub speed: Vector3<f64>,
    /// ω: how fast the sponge turns \[rad/s\].
    pub turning: Vector3<f64>,
}

/// What may be lost between two moments, against the line through both: h²/8 times what bounds the second derivative, h the time between.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sags {
    /// Of the compression at any point in contact \[m\].
    pub compression_m: f64,
    /// Of the distance of such a point from the sponge's axis \[m\].
    pub aside_m: f64,
    /// Of the way that the sponge slides over such a point: h times what its velocity across the axis may be off \[m\].
    pub slide_m: f64,
}

/// How a sponge moves over a stretch of time, at most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// h \[s\].
    pub length_s: f64,
    /// Speed of the tip \[m/s\].
    pub tip_m_s: f64,
    /// Its acceleration \[m/s²\].
    pub tip_m_s2: f64,
    /// ω: how fast the tool turns \[rad/s\].
    pub turning: f64,
    /// How fast the axis turns \[1/s\].
    pub axis: f64,
    /// The second derivative of any direction that turns with the tool \[1/s²\].
    pub bending: f64,
}

impl Drift {
    /// Of a sponge that does not move.
    pub const NONE: Self = Self {
        length_s: 0.0,
        tip_m_s: 0.0,
        tip_m_s2: 0.0,
        turning: 0.0,
        axis: 0.0,
        bending: 0.0,
    };

    /// That of a stretch and of the one after it together.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            length_s: self.length_s + next.length_s,
            tip_m_s: self.tip_m_s.max(next.tip_m_s),
            tip_m_s2: self.tip_m_s2.max(next.tip_m_s2),
            turning: self.turning.max(next.turning),
            axis: self.axis.max(next.axis),
            bending: self.bending.max(next.bending),
        }
    }
}

/// What is wanted of a place of a plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wanted {
    /// Least compression of the foam that counts \[m\].
    pub compression_m: f64,
    /// By how much a plate may lie higher or lower along its axis \[m\].
    pub height_error_m: f64,
    /// Least time in contact \[s\].
    pub time_s: f64,
    /// Least dose ∫ p dl in contact, of the least stiffness \[Pa·m\].
    pub dose_pa_m: f64,
}

/// What a place gets, at least: with the plate where it gets the least.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dwell {
    /// The greatest of its compressions at all moments \[m\].
    pub compression_m: f64,
    /// Time in contact \[s\].
    pub time_s: f64,
    /// Dose in contact \[Pa·m\].
    pub dose_pa_m: f64,
}

/// Where between 0 and 1 a line through two values is not below 0.
pub(super) fn at_least_0([from, to]: [f64; 2]) -> Option<[f64; 2]> {
    let crossing = from / (from - to);
    match (from >= 0.0, to >= 0.0) {
        (true, true) => Some([0.0, 1.0]),
        (true, false) => Some([0.0, crossing]),
        (false, true) => Some([crossing, 1.0]),
        (false, false) => None,
    }
}

/// What two ranges have in common; `None` where that has no length.
pub(super) fn both([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Option<[f64; 2]> {
    let common = [a.max(c), b.min(d)];
    (common[0] < common[1]).then_some(common)
}
