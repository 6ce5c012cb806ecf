//! Three turns of z–y–z form: joints 4 to 6 of a spherical wrist, or the sum of joints 2 to 4 with joints 5 and 6 where axes 2, 3 and 4 are
//! parallel.

use crate::ik::analytic::branch::Wrist;
use crate::ik::analytic::tolerances::FREE_WRIST_RAD;
use crate::trig::{atan2, sin_cos};
use nalgebra::Matrix3;
use std::f64::consts::PI;

/// Constants of the turns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Turns {
    /// `Kᵀ`, K the rotation from the first turn's frame to the shoulder frame at q₁ = q₂ = q₃ = q₄ = 0.
    pub from_shoulder: Matrix3<f64>,
    /// α₅ and α₆ \[rad\].
    pub at_zero: [f64; 2],
}

/// Angles of the wrist in z–y–z form, for the plain branch.
#[derive(Clone, Copy)]
pub(crate) struct Turn {
    /// `E = Rot_z(θ) Rot_y(q₅ + α₅) Rot_z(q₆ + α₆)`.
    pub rotation: Matrix3<f64>,
    /// `[θ, q₅ + α₅, q₆ + α₆]` \[rad\].
    pub angles: [f64; 3],
    /// Axes 4 and 6 are parallel: θ is free.
    pub free: bool,
}

impl Turns {
    /// Returns `[θ, q₅, q₆]` of one wrist branch: the flipped one has `[θ + π, −(q₅ + α₅) − α₅, q₆ + π]`.
    #[inline]
    pub fn joints(&self, turn: &Turn, wrist: Wrist) -> [f64; 3] {
        let [first, second, third] = turn.angles;
        let [at_zero_5, at_zero_6] = self.at_zero;
        match wrist {
            Wrist::Flipped if !turn.free => [first + PI, -second - at_zero_5, third + PI - at_zero_6],
            _ => [first, second - at_zero_5, third - at_zero_6],
        }
    }
}

impl Turn {
    /// Splits `E`; its third column is `(cos θ sin, sin θ sin, cos)` of the middle angle. The last angle is read
    /// off after undoing the first one as it was found, so that an uncertain θ costs no accuracy:
    /// the second row of `Rot_z(−θ) E` is `(sin, cos, 0)` of it.
    #[inline]
    pub fn split(e: Matrix3<f64>, previous_rad: f64) -> Self {
        let sine = (e.m13 * e.m13 + e.m23 * e.m23).sqrt();
        if sine <= FREE_WRIST_RAD {
            return Self {
                free: true,
                ..Self::at(e, previous_rad)
            };
        }
        Self::after(e, atan2(e.m23, e.m13), (e.m23 / sine, e.m13 / sine))
    }

    /// Splits `E` with a given first angle: exactly where axes 4 and 6 are parallel, otherwise with an error of that angle's error times
    /// [`Turn::sine`].
    #[inline]
    pub fn at(e: Matrix3<f64>, first: f64) -> Self {
        Self::after(e, first, sin_cos(first))
    }

    /// Returns the first angle once the third has moved on by `by` \[rad\], with axes 4 and 6 parallel or opposed: their sum or their difference
    /// stays.
    pub fn first_after(&self, by: f64) -> f64 {
        let sense = if self.rotation.m33 < 0.0 { 1.0 } else { -1.0 };
        self.angles[0] + sense * by
    }

    /// Sine of the angle between axes 4 and 6, not negative.
    pub fn sine(&self) -> f64 {
        let e = &self.rotation;
        (e.m13 * e.m13 + e.m23 * e.m23).sqrt()
    }

    #[inline]
    fn after(e: Matrix3<f64>, first: f64, (s, c): (f64, f64)) -> Self {
        let second = atan2(c * e.m13 + s * e.m23, e.m33);
        let third = atan2(c * e.m21 - s * e.m11, c * e.m22 - s * e.m12);
        Self {
            rotation: e,
            angles: [first, second, third],
            free: false,
        }
    }
}
