//! Joints 1 to 3: where the wrist centre is.

use super::arm::AnalyticArm;
use super::label::{Elbow, OutOfReach, ReachBorder, Shoulder};
use super::tolerance::{FREE_SHOULDER_M, REACH_ROUNDING_M};
use crate::rotation::Rigid;
use crate::trig::{atan2, sin_cos};
use nalgebra::{Complex, Matrix3, Vector3};

/// Sine of the elbow angle below which its two branches count as one.
const ELBOWS_MEET: f64 = 1e-7;

/// The target seen from the shoulder frame at q₁ = 0.
#[derive(Clone, Copy)]
pub(super) struct Goal {
    /// `R_S_6`.
    pub rotation: Matrix3<f64>,
    /// The wrist centre \[m\].
    pub wrist: Vector3<f64>,
}

/// Joint 1 of one shoulder side.
#[derive(Clone, Copy)]
pub(super) struct Swing {
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
pub(super) struct Triangle {
    wrist: Complex<f64>,
    /// Distance of the wrist centre from axis 2 \[m\].
    distance: f64,
    /// `e^{iψ}` with ψ in [0, π], and ψ.
    bent: Complex<f64>,
    psi: f64,
}

/// Joints 2 and 3 of one elbow side.
#[derive(Clone, Copy)]
pub(super) struct Bend {
    pub q2: f64,
    pub q3: f64,
    /// `e^{iθ₂₃}`: how far the forearm is turned about y from where it stands at q = 0.
    pub forearm: Complex<f64>,
    /// Elbow up and down meet.
    pub meets: bool,
}

impl AnalyticArm {
    #[inline]
    pub(super) fn goal(&self, target: &Rigid) -> Goal {
        let seen = self.shoulder_from_base.then(target);
        Goal {
            rotation: seen.rotation,
            wrist: seen.translation + seen.rotation.column(2) * self.wrist_along_axis_6,
        }
    }

    /// `Rot_z(q₁) (X, b, Z) = w`: `X = ±√(r² − b²)` with `r² = w_x² + w_y²`, and
    /// `e^{iq₁} ∥ (X w_x + b w_y) + i (X w_y − b w_x)`.
    #[inline]
    pub(super) fn swing(&self, goal: &Goal, side: Shoulder, previous_q1: f64) -> Result<Swing, OutOfReach> {
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
    pub(super) fn triangle(&self, swing: &Swing) -> Result<Triangle, OutOfReach> {
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
    pub(super) fn bend(&self, triangle: &Triangle, side: Shoulder, elbow: Elbow, previous_q2: f64) -> Bend {
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
