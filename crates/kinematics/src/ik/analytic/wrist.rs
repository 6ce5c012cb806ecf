//! Joints 4 to 6: how the hand is turned.

use super::arm::AnalyticArm;
use super::label::Wrist;
use super::position::{Bend, Swing};
use super::tolerance::FREE_WRIST_RAD;
use super::window::Window;
use crate::trig::{atan2, sin_cos};
use nalgebra::{Complex, Matrix3};
use std::f64::consts::PI;

/// The wrist's angles as z–y–z form, for the plain branch.
#[derive(Clone, Copy)]
pub(super) struct Turn {
    /// `E = Rot_z(q₄) Rot_y(q₅ + α₅) Rot_z(q₆ + α₆)`.
    rotation: Matrix3<f64>,
    /// `[q₄, q₅ + α₅, q₆ + α₆]` \[rad\].
    angles: [f64; 3],
    /// Joint 4 is free.
    pub free: bool,
}

impl AnalyticArm {
    /// `E = Kᵀ Rot_y(−θ₂₃) Rot_z(−q₁) R`, split into its three turns.
    #[inline]
    pub(super) fn wrist(&self, swing: &Swing, bend: &Bend, previous_q4: f64) -> Turn {
        let rotation = self.wrist_from_shoulder * turned_about_y(&swing.rotation, bend.forearm);
        Turn::split(rotation, previous_q4)
    }

    /// `[q₄, q₅, q₆]` of one wrist branch: the flipped one has `[q₄ + π, −(q₅ + α₅) − α₅, q₆ + π]`.
    #[inline]
    pub(super) fn wrist_joints(&self, turn: &Turn, wrist: Wrist) -> [f64; 3] {
        let [first, second, third] = turn.angles;
        let [at_zero_5, at_zero_6] = self.wrist_at_zero;
        match wrist {
            Wrist::Flipped if !turn.free => [first + PI, -second - at_zero_5, third + PI - at_zero_6],
            _ => [first, second - at_zero_5, third - at_zero_6],
        }
    }

    /// `[q₄, q₅, q₆]` of one wrist branch, each the value within the limits that is nearest to the start.
    #[inline]
    pub(super) fn wrist_within(&self, turn: &Turn, wrist: Wrist, window: &Window<'_>) -> Option<[f64; 3]> {
        let [q4, q5, q6] = self.wrist_joints(turn, wrist);
        let (q4, q5) = (window.value(3, q4)?, window.value(4, q5)?);
        match window.value(5, q6) {
            Some(q6) => Some([q4, q5, q6]),
            None if turn.free => self.free_wrist_within(turn, q6, window),
            None => None,
        }
    }

    /// At the wrist singularity, when joint 6 cannot take the rest: it goes to a limit and joint 4 takes it, the
    /// limit that moves joint 4 less. `q₄ + q₆` stays, or `q₄ − q₆` where axes 4 and 6 are opposed.
    #[cold]
    fn free_wrist_within(&self, turn: &Turn, q6: f64, window: &Window<'_>) -> Option<[f64; 3]> {
        let kept = turn.angles[0];
        let sense = if turn.rotation.m33 < 0.0 { 1.0 } else { -1.0 };
        let moved = |limit: f64| window.value(3, kept + sense * (limit - q6));
        let candidates = [window.limits.lower[5], window.limits.upper[5]].map(moved);
        let q4 = candidates
            .into_iter()
            .flatten()
            .min_by(|a, b| (a - kept).abs().total_cmp(&(b - kept).abs()))?;
        let [_, q5, q6] = self.wrist_joints(&Turn::split(turn.rotation, q4), Wrist::Plain);
        Some([q4, window.value(4, q5)?, window.value(5, q6)?])
    }
}

impl Turn {
    /// Splits `E`; its third column is `(cos q₄ sin, sin q₄ sin, cos)` of the middle angle. The last angle is read
    /// off after undoing the first one as it was found, so that an uncertain q₄ costs no accuracy:
    /// the second row of `Rot_z(−q₄) E` is `(sin, cos, 0)` of it.
    #[inline]
    pub(super) fn split(e: Matrix3<f64>, previous_q4: f64) -> Self {
        let sine = (e.m13 * e.m13 + e.m23 * e.m23).sqrt();
        let free = sine <= FREE_WRIST_RAD;
        let (first, s, c) = if free {
            let (s, c) = sin_cos(previous_q4);
            (previous_q4, s, c)
        } else {
            (atan2(e.m23, e.m13), e.m23 / sine, e.m13 / sine)
        };
        let second = atan2(c * e.m13 + s * e.m23, e.m33);
        let third = atan2(c * e.m21 - s * e.m11, c * e.m22 - s * e.m12);
        Self {
            rotation: e,
            angles: [first, second, third],
            free,
        }
    }
}

/// `Rot_y(−θ) R` with `e^{iθ}`.
#[inline]
fn turned_about_y(r: &Matrix3<f64>, turn: Complex<f64>) -> Matrix3<f64> {
    let (c, s) = (turn.re, turn.im);
    let (x, z) = (r.row(0), r.row(2));
    Matrix3::from_rows(&[x * c - z * s, r.row(1).into(), x * s + z * c])
}
