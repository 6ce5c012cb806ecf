//! Joint 1 and a triangle: the part that both closed forms share. The shoulder turns a plane, and two links in it reach a point.

use crate::ik::analytic::branch::{Degeneracies, Elbow, OutOfReach, ReachBorder, Shoulder};
use crate::ik::analytic::tolerances::{FREE_SHOULDER_M, REACH_ROUNDING_M};
use crate::ik::analytic::wrist::Turn;
use crate::joints::JointVector;
use crate::rotation::RigidTransform;
use crate::trig::{atan2, sin_cos};
use nalgebra::{Complex, Matrix3, Vector3};

/// Shoulder and two links. The links lie in a plane parallel to axis 1, perpendicular to axis 2.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Links {
    /// `T_S_base`: base coordinates to the shoulder frame at q₁ = 0.
    pub shoulder_from_base: RigidTransform,
    /// Wrist centre on the z axis of body 6 \[m\].
    pub wrist_along_axis_6: f64,
    /// x of axis 2 in the shoulder frame, a₁ \[m\].
    pub shoulder_offset: f64,
    /// y of the wrist centre in the shoulder frame, b \[m\]; exactly 0 when within tolerance.
    pub lateral_offset: f64,
    /// Upper arm L₂ and forearm L₃ \[m\].
    pub lengths: [f64; 2],
    /// +1 where axis 2 (axis 3) points along y of the shoulder frame, −1 where against it.
    pub signs: [f64; 2],
    /// `e^{i φ₂}` at q₂ = 0.
    pub upper_at_zero: Complex<f64>,
    /// ψ at q₃ = 0 \[rad\], and `e^{i ψ}` there.
    pub bend_at_zero: f64,
    pub turn_at_zero: Complex<f64>,
}

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
    pub wrist: Complex<f64>,
    /// `Rot_z(−q₁) R_S_6`.
    pub rotation: Matrix3<f64>,
    /// Front and back meet.
    pub meets: bool,
    /// Joint 1 is free.
    pub free: bool,
}

/// The triangle axis 2, axis 3, end of the forearm.
pub(crate) struct Triangle {
    /// End of the forearm: the wrist centre, or axis 4 where axes 2, 3 and 4 are parallel \[m\].
    wrist: Complex<f64>,
    /// Its distance from axis 2 \[m\].
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

impl Links {
    #[inline]
    pub fn goal(&self, target: &RigidTransform) -> Goal {
        let seen = self.shoulder_from_base.then(target);
        Goal {
            rotation: seen.rotation,
            wrist: seen.translation + seen.rotation.column(2) * self.wrist_along_axis_6,
        }
    }

    /// `Rot_z(q₁) (X, b, Z) = w`: `X = ±√(r² − b²)` with `r² = w_x² + w_y²`, and
    /// `e^{iq₁} ∥ (X w_x + b w_y) + i (X w_y − b w_x)`.
    #[inline]
    pub fn swing(&self, goal: &Goal, side: Shoulder, previous_q1: f64) -> Result<Swing, OutOfReach> {
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
    pub fn triangle(&self, wrist: Complex<f64>) -> Result<Triangle, OutOfReach> {
        let ([upper, fore], [longest, shortest]) = (self.lengths, self.reach());
        let distance = wrist.norm_sqr().sqrt();
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
            wrist,
            distance,
            bent: Complex::new(cosine, sine),
            psi: atan2(sine, cosine),
        })
    }

    /// `e^{iφ₂} ∥ p · conj(L₂ + L₃ e^{iψ})`; the forearm stands at `e^{i(φ₂ + ψ)}`.
    #[inline]
    pub fn bend(&self, triangle: &Triangle, side: Shoulder, elbow: Elbow, previous_q2: f64) -> Bend {
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

impl Links {
    /// Returns |det J| up to a constant factor, `|sin ψ · X / (L₂ + L₃) · sin(wrist)|`: zero at full stretch or fold, with the wrist centre
    /// beside axis 1, and with axes 4 and 6 parallel. `hand` goes from the end of the forearm to the wrist centre in the turned plane \[m\],
    /// `wrist` is q₅ + α₅ \[rad\].
    pub fn regularity(&self, q: &JointVector, hand: Complex<f64>, wrist: f64) -> f64 {
        let (end, elbow) = self.end(q);
        let out = self.shoulder_offset + (end + hand).im;
        let (wrist, _) = sin_cos(wrist);
        (elbow * out / self.reach()[0] * wrist).abs()
    }

    /// Returns the end of the forearm in the turned plane, from axis 2, `Z + i (X − a₁)` \[m\], and `sin ψ`.
    pub fn end(&self, q: &JointVector) -> (Complex<f64>, f64) {
        let [upper, fore] = self.lengths;
        let (s, c) = sin_cos(self.bend_at_zero + self.signs[1] * q[2]);
        (self.upper_arm(q[1]) * (Complex::new(c, s) * fore + upper), s)
    }

    /// Returns the direction of the upper arm, `e^{iφ₂}`.
    pub fn upper_arm(&self, q2: f64) -> Complex<f64> {
        let (s, c) = sin_cos(self.signs[0] * q2);
        self.upper_at_zero * Complex::new(c, s)
    }

    /// Lengths at full stretch and full fold \[m\].
    pub fn reach(&self) -> [f64; 2] {
        let [upper, fore] = self.lengths;
        [upper + fore, (upper - fore).abs()]
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

impl Degeneracies {
    #[inline]
    pub(crate) fn new(swing: &Swing, bend: &Bend, turn: &Turn) -> Self {
        Self {
            shoulder: swing.meets,
            elbow: bend.meets,
            wrist: turn.free,
        }
    }
}
