//! Closed form of arms with a spherical wrist and parallel axes 2 and 3: joints 1 to 3 from the position of the wrist centre, joints 4 to 6
//! from the orientation of the hand, and the values of joint 1 that are worth trying where the shoulder singularity leaves it free.
//!
//! With the wrist centre on axis 1, joints 2 and 3 do not depend on joint 1, and the wrist's rotation is
//! `E(q₁) = N Rot_z(−q₁) R` with a constant N. The values of q₁ that leave the wrist within its limits form
//! intervals; at their ends a wrist joint stands on a limit, and each such condition is one equation
//! `g · Rot_z(−q₁) d = h`, that is `A cos q₁ + B sin q₁ = C`:
//!
//! - joint 4 at λ: `(−sin λ, cos λ, 0) · E ẑ = 0`;
//! - joint 5 at λ: `ẑ · E ẑ = cos(λ + α₅)`;
//! - joint 6 at λ: `ẑ · E (sin(λ + α₆), cos(λ + α₆), 0) = 0`.

use crate::ik::analytic::branch::{Branch, Degeneracies, Elbow, Label, OutOfReach, Shoulder, Wrist};
use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::geometry::{Geometry, wrist_centre};
use crate::ik::analytic::links::{Bend, Goal, Links, Swing};
use crate::ik::analytic::mismatch::StructureMismatch;
use crate::ik::analytic::search::Search;
use crate::ik::analytic::window::{NearestConfiguration, Window};
use crate::ik::analytic::wrist::{Turn, Turns};
use crate::joints::JointVector;
use crate::rotation::RigidTransform;
use crate::trig::{acos, atan2, sin_cos};
use nalgebra::{Complex, Matrix3, Vector3};

/// Arm with a spherical wrist and parallel axes 2 and 3.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SphericalWristArm {
    pub chain: Chain,
    pub links: Links,
    pub turns: Turns,
}

impl SphericalWristArm {
    /// Recognises the arm by the geometry of its chain.
    ///
    /// # Errors
    /// [`StructureMismatch`]: the first property that fails by more than rounding.
    pub fn recognise(geometry: &Geometry) -> Result<Self, StructureMismatch> {
        let (centre, misses) = wrist_centre(&geometry.axes);
        let chain = geometry.chain(geometry.angles().into_iter().chain(misses))?;
        let (links, _) = geometry.links(&centre, None, chain.rounding)?;
        let turns = geometry.turns(&links);
        Ok(Self { chain, links, turns })
    }

    pub fn branches_with_turns(
        &self,
        target: &RigidTransform,
        previous: &JointVector,
    ) -> [Result<(Branch, Turn), OutOfReach>; 8] {
        let goal = self.links.goal(target);
        let of_side = |shoulder| {
            let swing = self.links.swing(&goal, shoulder, previous[0])?;
            let triangle = self.links.triangle(swing.wrist)?;
            let bends = [Elbow::Up, Elbow::Down].map(|elbow| self.links.bend(&triangle, shoulder, elbow, previous[1]));
            let turns = bends.map(|bend| self.turn(&swing, &bend, previous[3]));
            Ok((swing, bends, turns))
        };
        let sides = [Shoulder::Front, Shoulder::Back].map(of_side);
        Label::EIGHT.map(|label| {
            let (swing, bends, turns) = sides[label.shoulder as usize]?;
            let (bend, turn) = (bends[label.elbow as usize], turns[label.elbow as usize]);
            let [q4, q5, q6] = self.turns.joints(&turn, label.wrist);
            let q = JointVector::new(swing.q1, bend.q2, bend.q3, q4, q5, q6);
            Ok((Branch::new(q, label, Degeneracies::new(&swing, &bend, &turn)), turn))
        })
    }

    /// Splits `E = Kᵀ Rot_y(−θ₂₃) Rot_z(−q₁) R` into its three turns.
    #[inline]
    fn turn(&self, swing: &Swing, bend: &Bend, previous_q4: f64) -> Turn {
        let rotation = self.turns.from_shoulder * turned_about_y(&swing.rotation, bend.forearm);
        Turn::split(rotation, previous_q4)
    }

    /// Searches branch by branch. A branch is left as soon as a joint is outside its limits or the joints so far are already further away
    /// than the best.
    pub fn search_in_turn(
        &self,
        target: &RigidTransform,
        goal: &Goal,
        window: &Window<'_>,
    ) -> Option<NearestConfiguration> {
        let mut search = Search::new(self, target, window);
        for side in [Shoulder::Front, Shoulder::Back] {
            self.search_side(goal, side, &mut search);
        }
        search.best
    }

    #[inline]
    fn search_side(&self, goal: &Goal, shoulder: Shoulder, search: &mut Search<'_, Self>) -> Option<()> {
        let window = search.window;
        let swing = self.links.swing(goal, shoulder, window.anchor[0]).ok()?;
        let q1 = window.value(0, swing.q1)?;
        let triangle = self.links.triangle(swing.wrist).ok()?;
        for elbow in [Elbow::Up, Elbow::Down] {
            let bend = self.links.bend(&triangle, shoulder, elbow, window.anchor[1]);
            let (Some(q3), Some(q2)) = (window.value(2, bend.q3), window.value(1, bend.q2)) else {
                continue;
            };
            if window.squared_distance(&[q1, q2, q3]) >= search.least {
                continue;
            }
            let turn = self.turn(&swing, &bend, window.anchor[3]);
            let degenerate = Degeneracies::new(&swing, &bend, &turn);
            for wrist in [Wrist::Plain, Wrist::Flipped] {
                if let Some([q4, q5, q6]) = self.wrist_within(&turn, wrist, window) {
                    let q = JointVector::new(q1, q2, q3, q4, q5, q6);
                    search.offer(q, Label::new(shoulder, elbow, wrist), degenerate);
                }
            }
        }
        Some(())
    }

    /// Returns `[q₄, q₅, q₆]` of one wrist branch, each the value within the limits that is nearest to the start.
    #[inline]
    pub fn wrist_within(&self, turn: &Turn, wrist: Wrist, window: &Window<'_>) -> Option<[f64; 3]> {
        let [q4, q5, q6] = self.turns.joints(turn, wrist);
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
        let moved = |limit: f64| window.value(3, turn.first_after(limit - q6));
        let candidates = [window.limits.lower[5], window.limits.upper[5]].map(moved);
        let q4 = candidates
            .into_iter()
            .flatten()
            .min_by(|a, b| (a - kept).abs().total_cmp(&(b - kept).abs()))?;
        let [_, q5, q6] = self.turns.joints(&Turn::split(turn.rotation, q4), Wrist::Plain);
        Some([q4, window.value(4, q5)?, window.value(5, q6)?])
    }

    /// Values of joint 1 at which a joint of the wrist stands on a limit \[rad\].
    pub fn roots(&self, goal: &Goal, bend: &Bend, window: &Window<'_>) -> impl Iterator<Item = f64> + use<> {
        let (c, s) = (bend.forearm.re, bend.forearm.im);
        let n = self.turns.from_shoulder * Matrix3::new(c, 0.0, -s, 0.0, 1.0, 0.0, s, 0.0, c);
        let rotation = goal.rotation;
        let [at_zero_5, at_zero_6] = self.turns.at_zero;
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

/// `Rot_y(−θ) R` with `e^{iθ}`.
#[inline]
fn turned_about_y(r: &Matrix3<f64>, turn: Complex<f64>) -> Matrix3<f64> {
    let (c, s) = (turn.re, turn.im);
    let (x, z) = (r.row(0), r.row(2));
    Matrix3::from_rows(&[x * c - z * s, r.row(1).into(), x * s + z * c])
}

/// Returns both q₁ with `g · Rot_z(−q₁) d = h`; if there is none, the q₁ that comes closest (twice).
fn turns_with(g: &Vector3<f64>, d: &Vector3<f64>, h: f64) -> [f64; 2] {
    let (a, b) = (g.x * d.x + g.y * d.y, g.x * d.y - g.y * d.x);
    let amplitude = (a * a + b * b).sqrt();
    let half = acos((h - g.z * d.z) / amplitude);
    let middle = atan2(b, a);
    [middle + half, middle - half]
}
