//! The shoulder singularity under limits: which values of the free joint 1 are worth trying.
//!
//! With the wrist centre on axis 1, joints 2 and 3 do not depend on joint 1, and the wrist's rotation is
//! `E(q₁) = N Rot_z(−q₁) R` with a constant N. The values of q₁ that leave the wrist within its limits form
//! intervals; at their ends a wrist joint stands on a limit, and each such condition is one equation
//! `g · Rot_z(−q₁) d = h`, that is `A cos q₁ + B sin q₁ = C`:
//!
//! - joint 4 at λ: `(−sin λ, cos λ, 0) · E ẑ = 0`;
//! - joint 5 at λ: `ẑ · E ẑ = cos(λ + α₅)`;
//! - joint 6 at λ: `ẑ · E (sin(λ + α₆), cos(λ + α₆), 0) = 0`.

use super::arm::AnalyticArm;
use super::label::{Elbow, Shoulder};
use super::position::{Bend, Goal};
use super::window::Window;
use crate::trig::{acos, atan2, sin_cos};
use nalgebra::{Matrix3, Vector3};

/// Two elbows, three joints, two limits, two roots, and the limits of joint 1.
const MOST: usize = 2 * 3 * 2 * 2 + 2;

impl AnalyticArm {
    /// The candidates within joint 1's limits, nearest to the anchor first; none unless joint 1 is free.
    pub(super) fn critical_turns(&self, goal: &Goal, window: &Window<'_>) -> impl Iterator<Item = f64> + use<> {
        let mut found = [f64::NAN; MOST];
        let side = Shoulder::Front;
        let swing = self.swing(goal, side, 0.0).ok().filter(|swing| swing.free);
        if let Some(triangle) = swing.and_then(|swing| self.triangle(&swing).ok()) {
            let bends = [Elbow::Up, Elbow::Down].map(|elbow| self.bend(&triangle, side, elbow, window.anchor[1]));
            let roots = bends.iter().flat_map(|bend| self.roots(goal, bend, window));
            let ends = [window.limits.lower[0], window.limits.upper[0]];
            for (slot, q1) in found.iter_mut().zip(roots.chain(ends)) {
                *slot = window.value(0, q1).filter(|q| q.is_finite()).unwrap_or(f64::NAN);
            }
        }
        let anchor = window.anchor[0];
        found.sort_by(|a, b| (a - anchor).abs().total_cmp(&(b - anchor).abs()));
        found.into_iter().filter(|q1| q1.is_finite())
    }

    fn roots(&self, goal: &Goal, bend: &Bend, window: &Window<'_>) -> impl Iterator<Item = f64> + use<> {
        let (c, s) = (bend.forearm.re, bend.forearm.im);
        let n = self.wrist_from_shoulder * Matrix3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
        let rotation = goal.rotation;
        let [at_zero_5, at_zero_6] = self.wrist_at_zero;
        let third_row = n.row(2).transpose();
        [window.limits.lower, window.limits.upper]
            .into_iter()
            .flat_map(move |limit| {
                let [(s4, c4), (_, c5), (s6, c6)] = [limit[3], limit[4] + at_zero_5, limit[5] + at_zero_6].map(sin_cos);
                let hand = rotation.column(2).into_owned();
                let fourth = n.tr_mul(&Vector3::new(-s4, c4, 0.0));
                let sixth = rotation * Vector3::new(s6, c6, 0.0);
                [(fourth, hand, 0.0), (third_row, hand, c5), (third_row, sixth, 0.0)]
                    .into_iter()
                    .flat_map(|(g, d, h)| turns_with(&g, &d, h))
            })
    }
}

/// Both q₁ with `g · Rot_z(−q₁) d = h`; where there is none, the q₁ that comes closest (twice).
fn turns_with(g: &Vector3<f64>, d: &Vector3<f64>, h: f64) -> [f64; 2] {
    let (a, b) = (g.x * d.x + g.y * d.y, g.x * d.y - g.y * d.x);
    let amplitude = (a * a + b * b).sqrt();
    let half = acos((h - g.z * d.z) / amplitude);
    let middle = atan2(b, a);
    [middle + half, middle - half]
}
