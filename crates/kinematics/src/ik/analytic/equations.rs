//! Equations of the closed form, joint by joint: joints 1 to 3 from the position of the wrist centre, joints 4 to 6 from the orientation of
//! the hand, and the values of joint 1 that are worth trying where the shoulder singularity leaves it free.
//!
//! With the wrist centre on axis 1, joints 2 and 3 do not depend on joint 1, and the wrist's rotation is
//! `E(q₁) = N Rot_z(−q₁) R` with a constant N. The values of q₁ that leave the wrist within its limits form
//! intervals; at their ends a wrist joint stands on a limit, and each such condition is one equation
//! `g · Rot_z(−q₁) d = h`, that is `A cos q₁ + B sin q₁ = C`:
//!
//! - joint 4 at λ: `(−sin λ, cos λ, 0) · E ẑ = 0`;
//! - joint 5 at λ: `ẑ · E ẑ = cos(λ + α₅)`;
//! - joint 6 at λ: `ẑ · E (sin(λ + α₆), cos(λ + α₆), 0) = 0`.

use crate::ik::analytic::branch::{Elbow, OutOfReach, ReachBorder, Shoulder, Wrist};
use crate::ik::analytic::nearest::Window;
use crate::ik::analytic::{AnalyticArm, FREE_SHOULDER_M, FREE_WRIST_RAD, REACH_ROUNDING_M};
use crate::rotation::RigidTransform;
use crate::trig::{acos, atan2, sin_cos};
use nalgebra::{Complex, Matrix3, Vector3};
use std::f64::consts::PI;

/// Sine of the elbow angle below which its two branches count as one.
pub(crate) const ELBOWS_MEET: f64 = 1e-7;

/// Target in the shoulder frame at q₁ = 0.
#[derive(Clone, Copy)]
pub(crate) struct Goal {
    /// `R_S_6`.
    pub rotation: Matrix3<f64>,
    /// The wrist centre \[m\].
    pub wrist: Vector3<f64>,
}

/// Joint 1 of one shoulder side.
#[derive(Clone, Copy)]
pub(crate) struct Swing {
    pub q1: f64,
    /// Wrist centre in the turned plane, from axis 2: `Z + i (X − a₁)` \[m\].
    wrist: Complex<f64>,
    /// `Rot_z(−q₁) R_S_6`.
    pub rotation: Matrix3<f64>,
    /// Front and back meet.
    pub meets: bool,
    /// Joint 1 is free.
    pub free: bool,
}

/// The triangle axis 2, axis 3, wrist centre.
pub(crate) struct Triangle {
    wrist: Complex<f64>,
    /// Distance of the wrist centre from axis 2 \[m\].
    distance: f64,
    /// `e^{iψ}` with ψ in [0, π], and ψ.
    bent: Complex<f64>,
    psi: f64,
}

/// Joints 2 and 3 of one elbow side.
#[derive(Clone, Copy)]
pub(crate) struct Bend {
    pub q2: f64,
    pub q3: f64,
    /// Turn of the forearm about y from its direction at q = 0, `e^{iθ₂₃}`.
    pub forearm: Complex<f64>,
    /// Elbow up and down meet.
    pub meets: bool,
}

impl AnalyticArm {
    #[inline]
    pub(crate) fn goal(&self, target: &RigidTransform) -> Goal {
        let seen = self.shoulder_from_base.then(target);
        Goal {
            rotation: seen.rotation,
            wrist: seen.translation + seen.rotation.column(2) * self.wrist_along_axis_6,
        }
    }

    /// `Rot_z(q₁) (X, b, Z) = w`: `X = ±√(r² − b²)` with `r² = w_x² + w_y²`, and
    /// `e^{iq₁} ∥ (X w_x + b w_y) + i (X w_y − b w_x)`.
    #[inline]
    pub(crate) fn swing(&self, goal: &Goal, side: Shoulder, previous_q1: f64) -> Result<Swing, OutOfReach> {
        let (w, b) = (&goal.wrist, self.lateral_offset);
        let r = (w.x * w.x + w.y * w.y).sqrt();
        if r < b.abs() - REACH_ROUNDING_M {
            return Err(beyond(ReachBorder::Column, b.abs() - r));
        }
        let free = b == 0.0 && r <= FREE_SHOULDER_M;
        let out = ((r - b.abs()) * (r + b.abs())).max(0.0).sqrt();
        let x = match side {
            Shoulder::Front => out,
            Shoulder::Back => -out,
        };
        let (q1, s, c) = if free {
            let (s, c) = sin_cos(previous_q1);
            (previous_q1, s, c)
        } else {
            let (s, c) = (x * w.y - b * w.x, x * w.x + b * w.y);
            let scale = 1.0 / (s * s + c * c).sqrt();
            (atan2(s, c), s * scale, c * scale)
        };
        Ok(Swing {
            q1,
            wrist: Complex::new(w.z, x - self.shoulder_offset),
            rotation: turned_about_z(&goal.rotation, s, c),
            meets: free || out <= ELBOWS_MEET * r,
            free,
        })
    }

    /// `cos ψ = (d² − L₂² − L₃²) / (2 L₂ L₃)` with `d = |p|`, by the half angle, which is exact at stretch and at fold:
    /// `sin²(ψ/2) = ((L₂ + L₃)² − d²) / (4 L₂ L₃)` and `cos²(ψ/2) = (d² − (L₂ − L₃)²) / (4 L₂ L₃)`.
    #[inline]
    pub(crate) fn triangle(&self, swing: &Swing) -> Result<Triangle, OutOfReach> {
        let [upper, fore] = self.lengths;
        let (longest, shortest) = (upper + fore, (upper - fore).abs());
        let distance = swing.wrist.norm_sqr().sqrt();
        if distance > longest + REACH_ROUNDING_M {
            return Err(beyond(ReachBorder::Stretch, distance - longest));
        }
        if distance < shortest - REACH_ROUNDING_M {
            return Err(beyond(ReachBorder::Fold, shortest - distance));
        }
        let share = |product: f64| (product / (4.0 * upper * fore)).clamp(0.0, 1.0);
        let sine_squared = share((longest - distance) * (longest + distance));
        let cosine_squared = share((distance - shortest) * (distance + shortest));
        let sine = 2.0 * (sine_squared * cosine_squared).sqrt();
        let cosine = cosine_squared - sine_squared;
        Ok(Triangle {
            wrist: swing.wrist,
            distance,
            bent: Complex::new(cosine, sine),
            psi: atan2(sine, cosine),
        })
    }

    /// `e^{iφ₂} ∥ p · conj(L₂ + L₃ e^{iψ})`; the forearm stands at `e^{i(φ₂ + ψ)}`.
    #[inline]
    pub(crate) fn bend(&self, triangle: &Triangle, side: Shoulder, elbow: Elbow, previous_q2: f64) -> Bend {
        let (psi, bent) = match (side, elbow) {
            (Shoulder::Front, Elbow::Up) | (Shoulder::Back, Elbow::Down) => (triangle.psi, triangle.bent),
            _ => (-triangle.psi, triangle.bent.conj()),
        };
        let [upper, fore] = self.lengths;
        let [sign_2, sign_3] = self.signs;
        let (q2, turn_2) = if triangle.distance <= FREE_SHOULDER_M {
            let (s, c) = sin_cos(sign_2 * previous_q2);
            (previous_q2, Complex::new(c, s))
        } else {
            let turn = triangle.wrist * (bent * fore + upper).conj() * self.upper_at_zero.conj();
            (sign_2 * atan2(turn.im, turn.re), turn / turn.norm_sqr().sqrt())
        };
        Bend {
            q2,
            q3: sign_3 * (psi - self.bend_at_zero),
            forearm: turn_2 * bent * self.turn_at_zero.conj(),
            meets: triangle.bent.im <= ELBOWS_MEET,
        }
    }
}

/// `Rot_z(−q) R` with the sine and cosine of q.
#[inline]
fn turned_about_z(r: &Matrix3<f64>, s: f64, c: f64) -> Matrix3<f64> {
    let (x, y) = (r.row(0), r.row(1));
    Matrix3::from_rows(&[x * c + y * s, y * c - x * s, r.row(2).into()])
}

fn beyond(border: ReachBorder, by_m: f64) -> OutOfReach {
    OutOfReach { border, by_m }
}

/// Angles of the wrist in z–y–z form, for the plain branch.
#[derive(Clone, Copy)]
pub(crate) struct Turn {
    /// `E = Rot_z(q₄) Rot_y(q₅ + α₅) Rot_z(q₆ + α₆)`.
    rotation: Matrix3<f64>,
    /// `[q₄, q₅ + α₅, q₆ + α₆]` \[rad\].
    angles: [f64; 3],
    /// Joint 4 is free.
    pub free: bool,
}

impl AnalyticArm {
    /// Splits `E = Kᵀ Rot_y(−θ₂₃) Rot_z(−q₁) R` into its three turns.
    #[inline]
    pub(crate) fn wrist(&self, swing: &Swing, bend: &Bend, previous_q4: f64) -> Turn {
        let rotation = self.wrist_from_shoulder * turned_about_y(&swing.rotation, bend.forearm);
        Turn::split(rotation, previous_q4)
    }

    /// Returns `[q₄, q₅, q₆]` of one wrist branch: the flipped one has `[q₄ + π, −(q₅ + α₅) − α₅, q₆ + π]`.
    #[inline]
    pub(crate) fn wrist_joints(&self, turn: &Turn, wrist: Wrist) -> [f64; 3] {
        let [first, second, third] = turn.angles;
        let [at_zero_5, at_zero_6] = self.wrist_at_zero;
        match wrist {
            Wrist::Flipped if !turn.free => [first + PI, -second - at_zero_5, third + PI - at_zero_6],
            _ => [first, second - at_zero_5, third - at_zero_6],
        }
    }

    /// Returns `[q₄, q₅, q₆]` of one wrist branch, each the value within the limits that is nearest to the start.
    #[inline]
    pub(crate) fn wrist_within(&self, turn: &Turn, wrist: Wrist, window: &Window<'_>) -> Option<[f64; 3]> {
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
    pub(crate) fn split(e: Matrix3<f64>, previous_q4: f64) -> Self {
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

/// Greatest number of candidates: two elbows, three joints, two limits, two roots, and the limits of joint 1.
const MOST: usize = 2 * 3 * 2 * 2 + 2;

impl AnalyticArm {
    /// Returns the candidates within joint 1's limits, nearest to the anchor first; none unless joint 1 is free.
    pub(crate) fn critical_turns(&self, goal: &Goal, window: &Window<'_>) -> impl Iterator<Item = f64> + use<> {
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

/// Returns both q₁ with `g · Rot_z(−q₁) d = h`; if there is none, the q₁ that comes closest (twice).
fn turns_with(g: &Vector3<f64>, d: &Vector3<f64>, h: f64) -> [f64; 2] {
    let (a, b) = (g.x * d.x + g.y * d.y, g.x * d.y - g.y * d.x);
    let amplitude = (a * a + b * b).sqrt();
    let half = acos((h - g.z * d.z) / amplitude);
    let middle = atan2(b, a);
    [middle + half, middle - half]
}
