//! Closed form of arms whose axes 2, 3 and 4 are parallel and whose axes 5 and 6 meet, such as those of the UR series: joint 1 from the
//! position of the wrist centre, the sum of joints 2 to 4 with joints 5 and 6 from the orientation of the hand, joints 2 and 3 from axis 4.
//!
//! The order of the subproblems is that of IK-Geo (Elias & Wen, *Mechanism and Machine Theory* 209, 2025) for three parallel axes.
//!
//! With axes 4 and 6 parallel, the sum θ of joints 2 to 4 is free; it keeps its previous value if that leads to an answer. The values that do
//! form intervals, at whose ends the elbow is stretched or folded or a joint stands on a limit. At each such end two points of the arm's
//! plane have a known distance: `|p − e^{iθ} v| = d`.

use crate::ik::analytic::branch::{Branch, Degeneracies, Elbow, Label, OutOfReach, Shoulder, Wrist, principal};
use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::geometry::{Geometry, meeting_point, nearly, parallel};
use crate::ik::analytic::links::{Goal, Links, Swing, Triangle};
use crate::ik::analytic::mismatch::StructureMismatch;
use crate::ik::analytic::tolerances::FREE_WRIST_RAD;
use crate::ik::analytic::window::Window;
use crate::ik::analytic::wrist::{Turn, Turns};
use crate::joints::JointVector;
use crate::trig::{acos, atan2, sin_cos};
use nalgebra::Complex;

/// Arm with parallel axes 2, 3 and 4.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ParallelAxesArm {
    pub chain: Chain,
    /// The forearm ends at axis 4.
    pub links: Links,
    /// The first turn is that of joints 2 to 4 together.
    pub turns: Turns,
    /// From axis 4 to the wrist centre in the arm's plane at q = 0, `Z + i X` \[m\].
    pub hand: Complex<f64>,
    /// +1 where axis 4 points along y of the shoulder frame, −1 where against it.
    pub sign_4: f64,
}

impl ParallelAxesArm {
    /// Recognises the arm by the geometry of its chain. `None` where axes 3 and 4 are not even nearly parallel.
    ///
    /// # Errors
    /// [`StructureMismatch`]: the first property that fails by more than rounding.
    pub fn recognise(geometry: &Geometry) -> Option<Result<Self, StructureMismatch>> {
        nearly(parallel(&geometry.axes, [2, 3])).then(|| Self::with_parallel_axes(geometry))
    }

    fn with_parallel_axes(geometry: &Geometry) -> Result<Self, StructureMismatch> {
        let axes = &geometry.axes;
        let (centre, meet) = meeting_point(axes);
        let angles = geometry.angles().into_iter().chain([parallel(axes, [2, 3])]);
        let chain = geometry.chain(angles.chain([meet]))?;
        let (links, hand) = geometry.links(&centre, Some(&axes[3].point), chain.rounding)?;
        if links.lateral_offset == 0.0 {
            return Err(StructureMismatch::NoLateralOffset);
        }
        let y = links.shoulder_from_base.rotation.row(1).transpose();
        Ok(Self {
            chain,
            turns: geometry.turns(&links),
            hand,
            sign_4: 1.0_f64.copysign(axes[3].direction.dot(&y)),
            links,
        })
    }

    pub fn branches_in_turn(&self, goal: &Goal, previous: &JointVector) -> [Result<Branch, OutOfReach>; 8] {
        let of_side = |shoulder| {
            let swing = self.links.swing(goal, shoulder, previous[0])?;
            let turn = self.turn(&swing, previous);
            let wrists = [Wrist::Plain, Wrist::Flipped].map(|wrist| {
                let joints = self.turns.joints(&turn, wrist);
                let triangle = self.triangle(&swing, joints[0]);
                let ([sum, q5, q6], triangle) = match triangle {
                    Ok(triangle) => (joints, triangle),
                    Err(miss) => self.on_border(&swing, &turn, wrist).ok_or(miss)?,
                };
                let bends =
                    [Elbow::Up, Elbow::Down].map(|elbow| self.links.bend(&triangle, shoulder, elbow, previous[1]));
                Ok((bends, [sum, q5, q6]))
            });
            Ok((swing, turn, wrists))
        };
        let sides = [Shoulder::Front, Shoulder::Back].map(of_side);
        Label::EIGHT.map(|label| {
            let (swing, turn, wrists) = sides[label.shoulder as usize]?;
            let (bends, [sum, q5, q6]) = wrists[label.wrist as usize]?;
            let bend = bends[label.elbow as usize];
            let q4 = sum - self.sign_4 * self.turn_of_links(bend.q2, bend.q3);
            let q = JointVector::new(swing.q1, bend.q2, bend.q3, q4, q5, q6);
            Ok(Branch::new(q, label, Degeneracies::new(&swing, &bend, &turn)))
        })
    }

    /// Splits `E = Kᵀ Rot_z(−q₁) R`, `E = Rot_z(θ) Rot_y(q₅ + α₅) Rot_z(q₆ + α₆)`.
    #[inline]
    pub fn turn(&self, swing: &Swing, previous: &JointVector) -> Turn {
        Turn::split(self.turns.from_shoulder * swing.rotation, self.sum(previous))
    }

    #[inline]
    fn triangle(&self, swing: &Swing, sum: f64) -> Result<Triangle, OutOfReach> {
        self.links.triangle(swing.wrist - self.turned_hand(sum))
    }

    /// Returns θ, joints 5 and 6, and the triangle with the elbow stretched or folded, if θ is so uncertain that this is within rounding: the
    /// sine of the angle between axes 4 and 6 times the error of θ is the error of the orientation.
    #[cold]
    fn on_border(&self, swing: &Swing, turn: &Turn, wrist: Wrist) -> Option<([f64; 3], Triangle)> {
        let [found, ..] = self.turns.joints(turn, wrist);
        let borders = self.links.reach().map(|d| turns_at(swing.wrist, self.hand, d));
        let moves = borders
            .as_flattened()
            .iter()
            .map(|about_y| principal(self.sign_4 * about_y - found));
        let by = moves.min_by(|a, b| a.abs().total_cmp(&b.abs()))?;
        if turn.sine() * by.abs() > FREE_WRIST_RAD {
            return None;
        }
        let moved = Turn {
            free: turn.free,
            ..Turn::at(turn.rotation, turn.angles[0] + by)
        };
        let joints = self.turns.joints(&moved, wrist);
        Some((joints, self.triangle(swing, joints[0]).ok()?))
    }

    /// Returns the turn of the forearm about y at joints 2 and 3 \[rad\].
    #[inline]
    pub fn turn_of_links(&self, q2: f64, q3: f64) -> f64 {
        let [sign_2, sign_3] = self.links.signs;
        sign_2 * q2 + sign_3 * q3
    }

    /// Returns θ: the turn of joints 2 to 4 together, about axis 4 \[rad\].
    #[inline]
    pub fn sum(&self, q: &JointVector) -> f64 {
        self.sign_4 * self.turn_of_links(q[1], q[2]) + q[3]
    }

    /// Returns the vector from axis 4 to the wrist centre at a turn θ \[m\].
    #[inline]
    pub fn turned_hand(&self, sum: f64) -> Complex<f64> {
        let (s, c) = sin_cos(self.sign_4 * sum);
        Complex::new(c, s) * self.hand
    }

    /// Returns the values of θ at which the elbow is stretched or folded, or a joint stands on a limit, with axes 4 and 6 parallel \[rad\];
    /// NaN where a joint has no limit.
    pub fn critical_sums(&self, swing: &Swing, turn: &Turn, window: &Window<'_>) -> impl Iterator<Item = f64> + use<> {
        let (links, wrist) = (&self.links, swing.wrist);
        let [upper, fore] = links.lengths;
        let [_, _, q6] = self.turns.joints(turn, Wrist::Plain);
        let mut found: Vec<f64> = links
            .reach()
            .iter()
            .flat_map(|d| turns_at(wrist, self.hand, *d))
            .collect();
        for limit in [window.limits.lower, window.limits.upper] {
            let (s4, c4) = sin_cos(limit[3]);
            let fore_at_zero = links.upper_at_zero * links.turn_at_zero * fore;
            let bent_hand = self.hand + fore_at_zero * Complex::new(c4, -self.sign_4 * s4);
            let (end, _) = links.end(&limit);
            found.extend(turns_at(wrist - links.upper_arm(limit[1]) * upper, self.hand, fore));
            found.extend(turns_at(wrist, self.hand, end.norm_sqr().sqrt()));
            found.extend(turns_at(wrist, bent_hand, upper));
            found.push(self.sign_4 * turn.first_after(limit[5] - q6));
        }
        let sign_4 = self.sign_4;
        found.into_iter().map(move |about_y| sign_4 * about_y)
    }
}

/// Returns both θ with `|p − e^{iθ} v| = d`; if there is none, the θ that comes closest (twice).
fn turns_at(p: Complex<f64>, v: Complex<f64>, d: f64) -> [f64; 2] {
    let between = p * v.conj();
    let cosine = (p.norm_sqr() + v.norm_sqr() - d * d) / (2.0 * between.norm_sqr().sqrt());
    let (middle, half) = (atan2(between.im, between.re), acos(cosine));
    [middle + half, middle - half]
}
