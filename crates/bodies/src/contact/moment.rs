//! Moments of a wash, and bounds of the motion between two of them.

use crate::contact::sponge_pose::SpongePose;
use nalgebra::Vector3;

/// Moment of a wash, in the frame of the plate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Time \[s\].
    pub t_s: f64,
    /// Pose of the sponge.
    pub pose: SpongePose,
    /// Velocity of the tip \[m/s\].
    pub speed: Vector3<f64>,
    /// Angular velocity ω of the sponge \[rad/s\].
    pub turning: Vector3<f64>,
}

impl Moment {
    /// Sliding speed of the sponge over a point \[m/s\].
    pub(super) fn slide_m_s(&self, point: &Vector3<f64>) -> f64 {
        let slide = self.speed + self.turning.cross(&(point - self.pose.tip));
        (slide - self.pose.axis * slide.dot(&self.pose.axis)).norm()
    }
}

/// Upper bounds on the motion of a sponge over a stretch of time: h, V, A, ω, a₁ and a₂ of formula (28.1) in `docs/contact.md` and its derivation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drift {
    /// Length h of the stretch \[s\].
    pub length_s: f64,
    /// Speed V of the tip \[m/s\].
    pub tip_m_s: f64,
    /// Acceleration A of the tip \[m/s²\].
    pub tip_m_s2: f64,
    /// Angular speed ω of the tool \[rad/s\].
    pub turning: f64,
    /// Rate of change a₁ of the axis, a unit vector \[1/s\].
    pub axis: f64,
    /// Second derivative a₂ of any unit vector that turns with the tool \[1/s²\].
    pub bending: f64,
}

impl Drift {
    /// Motion of a sponge at rest.
    pub const NONE: Self = Self {
        length_s: 0.0,
        tip_m_s: 0.0,
        tip_m_s2: 0.0,
        turning: 0.0,
        axis: 0.0,
        bending: 0.0,
    };

    /// Bounds the motion over a stretch and the one after it together.
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
