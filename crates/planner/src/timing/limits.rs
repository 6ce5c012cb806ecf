//! Limits of a motion, and stretches of its path that are slower.

use platewash_kinematics::{AXES, JointVector};

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
