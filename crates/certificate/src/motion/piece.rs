//! One cubic or quintic of the motion, with its extremes, and bounds over several pieces.
//!
//! Formulas (12.1), of the cubic, and (12.2), of its rounding, in `docs/certificate.md`.
//!
//! The motion is what the numbers in the file say: the cubic c through the knots as they stand. What is computed is another one, ĉ,
//! and the shorter a piece, the farther its derivatives may be from those of c. With m = Δq/h, M = |m| + |v₀| + |v₁| and the unit
//! roundoff u = 2⁻⁵³ (Higham, *Accuracy and Stability of Numerical Algorithms*, §3.1): h, Δq and m are right to u, u and 3u as parts
//! of themselves, and every further operation adds one u to each term, so that to first order
//!
//! - |ĉ₂ − c₂| ≤ 8u (3|m| + 2|v₀| + |v₁|) / h ≤ 24 u M / h, |ĉ₃ − c₃| ≤ 8u (2|m| + |v₀| + |v₁|) / h² ≤ 16 u M / h²;
//! - 2c₂ + 6c₃u adds 2·24 + 6·16 = 144 u M / h to that, and its own evaluation, of terms up to 6M/h and 12M/h in four operations
//!   with an argument right to u, at most 54: 198 u M / h. Speed, position and jerk have smaller factors.
//!
//! 200 u = 100 ε holds for all of them, with the powers of h that belong to each; a position also has the rounding of the last sum. Bounds
//! include these. They are nothing for a piece of a millisecond (10⁻¹¹ rad/s² at 1 rad/s), and for one of 10⁻¹⁶ s they are whole
//! rad/s²: what such a piece does cannot be proved, and is not.
//!
//! For a quintic, with M = |m| + |v₀| + |v₁| + h |a₀| + h |a₁|, the same count gives |δc₃| ≤ 160 u M / h², |δc₄| ≤ 240 u M / h³ and
//! |δc₅| ≤ 96 u M / h⁴, and with the evaluation at most 1 000 u M h for positions, 3 200 u M for speeds, 9 400 u M / h for accelerations,
//! 20 300 u M / h² for jerks and 23 800 u M / h³ for their derivative. Its extremes are where a derivative is zero. These zeros are bracketed
//! between those of the next derivative; where rounding hides one, the derivative is of the wrong sign by no more than its own rounding, and
//! by what the next derivatives hide in turn. The sum of all is at most 57 700 u M h for positions, and less for the others; the brackets,
//! 2⁻³² h wide, add less than 1 u. 2¹⁶ u = 2¹⁵ ε holds for all of them.
//!
//! Where the times of a motion were rounded, h is off by more than u: by δh. With each 1/h that a coefficient has, its terms are off by δ as a
//! part of themselves. For a cubic |δ(2c₂)| ≤ 2 (6|m| + 2|v₀| + |v₁|) δ/h ≤ 12 M δ/h and |δ(6c₃u)| ≤ 6 (6|m| + 2|v₀| + 2|v₁|) δ/h
//! ≤ 36 M δ/h, so that 48 M δ holds. For a quintic the same sum over 6c₃u, 12c₄u² and 20c₅u³ is less than 4096 M δ.

use platewash_kinematics::{AXES, JointVector};
use platewash_motion::piecewise::MotionPiece;
use platewash_motion::plan::Knots;
use platewash_motion::trajectory::{KnotError, Trajectory};

/// `q(u) = Σ cₖuᵏ` for u in [0, length]; c₄ and c₅ are 0 for a cubic.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    /// Time of u = 0 \[s\].
    pub start_s: f64,
    /// Duration \[s\].
    pub length_s: f64,
    c: [JointVector; 6],
    /// Zeros of the derivatives of a quintic; `None` for a cubic, whose zeros have a closed form.
    zeros: Option<Box<[Zeros; AXES]>>,
    /// Speed that the knot at the end states \[rad/s\].
    end_speed: JointVector,
    rounding: Rounding,
}

/// Times at which speed, acceleration and jerk of a joint are zero \[s\], filled up with NaN.
type Zeros = [[f64; 4]; 3];

/// Derivatives whose zeros are extremes of the one before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Derivative {
    Speed,
    Acceleration,
    Jerk,
}

/// Bounds on the difference between computed values and those that the knots define, anywhere on a piece: see the head of this file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rounding {
    /// For positions \[rad\].
    pub position: JointVector,
    /// For speeds \[rad/s\].
    pub speed: JointVector,
    /// For accelerations \[rad/s²\].
    pub acceleration: JointVector,
}

/// Rounding relative to |m| + |v₀| + |v₁|: 200 u.
const ROUNDING: f64 = 100.0 * f64::EPSILON;

/// Same for a quintic, relative to |m| + |v₀| + |v₁| + h |a₀| + h |a₁|: 2¹⁶ u.
const ROUNDING_OF_QUINTIC: f64 = 32_768.0 * f64::EPSILON;

/// Effect of an error of the length, relative to that error as a part of the length and to the same sum: for a cubic and for a quintic.
const OF_LENGTH: [f64; 2] = [48.0, 4096.0];

/// Number of halvings of the time between two zeros of a derivative.
const HALVINGS: u32 = 32;

/// Bounds on the joints over a stretch of time. For a single piece they are exact but for its rounding.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Extent {
    /// Lowest positions \[rad\].
    pub least: JointVector,
    /// Highest positions \[rad\].
    pub most: JointVector,
    /// Greatest speeds \[rad/s\].
    pub speed: JointVector,
    /// Greatest accelerations, inside pieces \[rad/s²\].
    pub acceleration: JointVector,
    /// Sums of the jumps of speed at the knots inside \[rad/s\].
    pub jumps: JointVector,
}

/// The pieces of a plan's knots, in time order.
///
/// # Errors
/// [`KnotError`] for knots that are no motion.
pub(crate) fn pieces(knots: &Knots) -> Result<Vec<Piece>, KnotError> {
    let Knots { t_s, q_rad, qd_rad_s } = knots;
    // The checks are those of every motion; what follows from the knots is worked out here, on its own.
    Trajectory::from_knots(t_s.clone(), q_rad.clone(), qd_rad_s.clone())?;
    let piece = |k: usize| {
        Piece::new(
            [t_s[k], t_s[k + 1]],
            [q_rad[k], q_rad[k + 1]],
            [qd_rad_s[k], qd_rad_s[k + 1]],
        )
    };
    Ok((0..t_s.len().saturating_sub(1)).map(piece).collect())
}

impl From<&MotionPiece> for Piece {
    fn from(piece: &MotionPiece) -> Self {
        match piece.qdd_rad_s2 {
            None => Self::new(piece.t_s, piece.q_rad, piece.qd_rad_s),
            Some(qdd_rad_s2) => Self::quintic(piece.t_s, piece.q_rad, piece.qd_rad_s, qdd_rad_s2),
        }
    }
}

impl Piece {
    /// The cubic Hermite piece between two knots, formula (12.1): times \[s\], positions q₀ and q₁ \[rad\], speeds v₀ and v₁ \[rad/s\].
    pub fn new([from, to]: [f64; 2], [q0, q1]: [JointVector; 2], [v0, v1]: [JointVector; 2]) -> Self {
        let h = to - from;
        let mean = (q1 - q0) / h;
        let (c2, c3) = ((mean * 3.0 - v0 * 2.0 - v1) / h, (v0 + v1 - mean * 2.0) / (h * h));
        Self {
            start_s: from,
            length_s: h,
            c: [q0, v0, c2, c3, JointVector::zeros(), JointVector::zeros()],
            zeros: None,
            end_speed: v1,
            rounding: Rounding::new((mean.abs() + v0.abs() + v1.abs()) * ROUNDING, h, [q0, q1]),
        }
    }

    /// The quintic Hermite piece between two knots: as [`Piece::new`], and accelerations a₀ and a₁ \[rad/s²\].
    fn quintic(
        [from, to]: [f64; 2],
        [q0, q1]: [JointVector; 2],
        [v0, v1]: [JointVector; 2],
        [a0, a1]: [JointVector; 2],
    ) -> Self {
        let h = to - from;
        let mean = (q1 - q0) / h;
        let (b0, b1) = (a0 * h, a1 * h);
        let c = [
            q0,
            v0,
            a0 * 0.5,
            (mean * 10.0 - v0 * 6.0 - v1 * 4.0 - b0 * 1.5 + b1 * 0.5) / (h * h),
            (v0 * 8.0 + v1 * 7.0 - mean * 15.0 + b0 * 1.5 - b1) / (h * h * h),
            (mean * 6.0 - v0 * 3.0 - v1 * 3.0 - b0 * 0.5 + b1 * 0.5) / (h * h * h * h),
        ];
        let all = mean.abs() + v0.abs() + v1.abs() + b0.abs() + b1.abs();
        Self {
            start_s: from,
            length_s: h,
            zeros: Some(Box::new(std::array::from_fn(|joint| zeros(c.map(|c| c[joint]), h)))),
            c,
            end_speed: v1,
            rounding: Rounding::new(all * ROUNDING_OF_QUINTIC, h, [q0, q1]),
        }
    }

    /// Returns the piece for a length h that is known to `by_s` only \[s\]: with δ = `by_s`/h, its bounds of speed and acceleration are larger by
    /// 48 M δ and 48 M δ/h. M is that of formula (12.2); for a quintic 4096 and M + h |a₀| + h |a₁| take the places of 48 and M.
    pub fn with_length_within(mut self, by_s: f64) -> Self {
        let ([q0, v0, ..], h) = (&self.c, self.length_s);
        let ends = [*q0, self.position(h)];
        let mean = (ends[1] - ends[0]) / h;
        let rates = mean.abs() + v0.abs() + self.end_speed.abs();
        let [of_cubic, of_quintic] = OF_LENGTH;
        let more = match self.zeros {
            None => rates * of_cubic,
            Some(_) => (rates + (self.acceleration(0.0).abs() + self.acceleration(h).abs()) * h) * of_quintic,
        };
        let more = Rounding::new(more * (by_s / h), h, ends);
        self.rounding.speed += more.speed;
        self.rounding.acceleration += more.acceleration;
        self
    }

    /// Returns bounds on the rounding of positions, speeds and accelerations: |δq|, |δq̇| and |δq̈| of formula (12.2).
    pub fn rounding(&self) -> &Rounding {
        &self.rounding
    }

    /// Checks that a joint's coefficients are so small that their squares are finite.
    pub fn has_finite_squares(&self, joint: usize) -> bool {
        self.c.iter().all(|c| c[joint].abs() < 1e100)
    }

    pub fn position(&self, u: f64) -> JointVector {
        let [c0, c1, c2, c3, c4, c5] = &self.c;
        c0 + (c1 + (c2 + (c3 + (c4 + c5 * u) * u) * u) * u) * u
    }

    pub fn speed(&self, u: f64) -> JointVector {
        let [_, c1, c2, c3, c4, c5] = &self.c;
        c1 + (c2 * 2.0 + c3 * (3.0 * u) + (c4 * 4.0 + c5 * (5.0 * u)) * (u * u)) * u
    }

    pub fn acceleration(&self, u: f64) -> JointVector {
        let [_, _, c2, c3, c4, c5] = &self.c;
        c2 * 2.0 + c3 * (6.0 * u) + (c4 * 12.0 + c5 * (20.0 * u)) * (u * u)
    }

    /// Position of one joint \[rad\]: the bits of [`Piece::position`]; below its speed and acceleration alike.
    fn position_of(&self, joint: usize, u: f64) -> f64 {
        let [c0, c1, c2, c3, c4, c5] = self.c.each_ref().map(|c| c[joint]);
        c0 + (c1 + (c2 + (c3 + (c4 + c5 * u) * u) * u) * u) * u
    }

    fn speed_of(&self, joint: usize, u: f64) -> f64 {
        let [_, c1, c2, c3, c4, c5] = self.c.each_ref().map(|c| c[joint]);
        c1 + (c2 * 2.0 + c3 * (3.0 * u) + (c4 * 4.0 + c5 * (5.0 * u)) * (u * u)) * u
    }

    fn acceleration_of(&self, joint: usize, u: f64) -> f64 {
        let [_, _, c2, c3, c4, c5] = self.c.each_ref().map(|c| c[joint]);
        c2 * 2.0 + c3 * (6.0 * u) + (c4 * 12.0 + c5 * (20.0 * u)) * (u * u)
    }

    /// Upper bound D₃ on the third derivative of each joint over the piece \[rad/s³\], with |δq⃛| of formula (12.2); a cubic's is constant.
    pub fn jerk(&self) -> JointVector {
        let [_, _, _, c3, c4, c5] = self.c.each_ref().map(|c| c.abs());
        let h = self.length_s;
        c3 * 6.0 + (c4 * 24.0 + c5 * (60.0 * h)) * h + self.rounding.acceleration / h
    }

    /// Upper bound D₁ on the speed of each joint from `u[0]` to `u[1]` within the piece \[rad/s\], formulas (12.1) and (12.2). The speed is extreme
    /// at an end or where the acceleration is zero.
    pub fn greatest_speed(&self, u: [f64; 2]) -> JointVector {
        let ends = u.map(|u| self.speed(u));
        self.greatest(u, ends, Derivative::Acceleration, |joint, u| self.speed_of(joint, u)) + self.rounding.speed
    }

    /// Upper bound D₂ on the acceleration of each joint from `u[0]` to `u[1]` within the piece \[rad/s²\], formulas (12.1) and (12.2). The
    /// acceleration is extreme at an end or where the jerk is zero.
    pub fn greatest_acceleration(&self, u: [f64; 2]) -> JointVector {
        let ends = u.map(|u| self.acceleration(u));
        self.greatest(u, ends, Derivative::Jerk, |joint, u| self.acceleration_of(joint, u)) + self.rounding.acceleration
    }

    /// Greatest magnitude of a quantity at `u0`, `u1` and the zeros between them of its derivative. `ends` are its values at `u0` and
    /// `u1`, `value` is that of one joint.
    fn greatest(
        &self,
        [u0, u1]: [f64; 2],
        ends: [JointVector; 2],
        derivative: Derivative,
        value: impl Fn(usize, f64) -> f64,
    ) -> JointVector {
        let mut greatest = ends[0].abs().sup(&ends[1].abs());
        for joint in 0..AXES {
            for u in self.zeros(derivative, joint).into_iter().filter(|u| *u > u0 && *u < u1) {
                greatest[joint] = greatest[joint].max(value(joint, u).abs());
            }
        }
        greatest
    }

    /// Returns all bounds from `u0` to `u1` within the piece, formulas (12.1) and (12.2).
    pub fn extent(&self, [u0, u1]: [f64; 2]) -> Extent {
        let (start, end) = (self.position(u0), self.position(u1));
        let mut extent = Extent {
            least: start.inf(&end),
            most: start.sup(&end),
            speed: self.greatest_speed([u0, u1]),
            acceleration: self.greatest_acceleration([u0, u1]),
            jumps: JointVector::zeros(),
        };
        for joint in 0..AXES {
            let turns = self.zeros(Derivative::Speed, joint);
            for u in turns.into_iter().filter(|u| *u > u0 && *u < u1) {
                let q = self.position_of(joint, u);
                extent.least[joint] = extent.least[joint].min(q);
                extent.most[joint] = extent.most[joint].max(q);
            }
        }
        extent.least -= self.rounding.position;
        extent.most += self.rounding.position;
        extent
    }

    /// Magnitude of the jump of speed from this piece to the next, as the knots state it \[rad/s\]. It is exactly 0 between pieces of a
    /// plan, which share their knots.
    pub fn jump_to(&self, next: &Self) -> JointVector {
        (next.c[1] - self.end_speed).abs()
    }

    /// Speeds at the start and at the end, as the knots state them \[rad/s\].
    pub fn end_speeds(&self) -> [JointVector; 2] {
        [self.c[1], self.end_speed]
    }

    /// Times at which a joint's position, speed or acceleration may be extreme \[s\].
    pub fn candidates(&self, joint: usize) -> Vec<f64> {
        let extremes = [Derivative::Speed, Derivative::Acceleration, Derivative::Jerk];
        let all = extremes
            .into_iter()
            .flat_map(|derivative| self.zeros(derivative, joint));
        let inside = all.filter(|u| *u > 0.0 && *u < self.length_s);
        [0.0, self.length_s].into_iter().chain(inside).collect()
    }

    /// Times at which a derivative of a joint's position is zero; NaN or far away if there are none.
    fn zeros(&self, derivative: Derivative, joint: usize) -> [f64; 4] {
        if let Some(zeros) = &self.zeros {
            return zeros[joint][derivative as usize];
        }
        let [_, c1, c2, c3, ..] = self.c.each_ref().map(|c| c[joint]);
        let none = f64::NAN;
        match derivative {
            Derivative::Speed => {
                // c₁ + 2c₂u + 3c₃u² = 0, by the pair of roots that does not cancel (Numerical Recipes, §5.6).
                let (a, half_b, c) = (3.0 * c3, c2, c1);
                let root = (half_b * half_b - a * c).sqrt();
                let sum = -(half_b + if half_b < 0.0 { -root } else { root });
                [sum / a, c / sum, none, none]
            }
            Derivative::Acceleration => [-c2 / (3.0 * c3), none, none, none],
            Derivative::Jerk => [none; 4],
        }
    }
}

/// Zeros of the derivatives of a quintic with coefficients `c` for u in [0, h].
fn zeros(c: [f64; 6], h: f64) -> Zeros {
    let [_, c1, c2, c3, c4, c5] = c;
    let mut turn = [-c4 / (5.0 * c5), f64::NAN, f64::NAN, f64::NAN];
    let mut next = |c: [f64; 5]| {
        turn = zeros_between(c, h, turn);
        turn
    };
    let jerk = next([6.0 * c3, 24.0 * c4, 60.0 * c5, 0.0, 0.0]);
    let acceleration = next([2.0 * c2, 6.0 * c3, 12.0 * c4, 20.0 * c5, 0.0]);
    let speed = next([c1, 2.0 * c2, 3.0 * c3, 4.0 * c4, 5.0 * c5]);
    [speed, acceleration, jerk]
}

/// Zeros in [0, h] of the polynomial Σ cₖuᵏ, in ascending order, from the zeros of its derivative, `turns`: one between two of them where the sign
/// changes.
fn zeros_between(c: [f64; 5], h: f64, turns: [f64; 4]) -> [f64; 4] {
    let value = |u: f64| c.iter().rev().fold(0.0, |sum, c| sum * u + c);
    let mut zeros = [f64::NAN; 4];
    let (mut count, mut from) = (0, 0.0);
    let mut is_above = value(from) > 0.0;
    let inside = turns.into_iter().filter(|u| *u > 0.0 && *u < h);
    for to in inside.chain([h]) {
        let was_above = std::mem::replace(&mut is_above, value(to) > 0.0);
        let mut ends = [std::mem::replace(&mut from, to), to];
        if was_above == is_above || count == zeros.len() {
            continue;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (ends[0] + ends[1]);
            ends[usize::from((value(middle) > 0.0) != was_above)] = middle;
        }
        zeros[count] = ends[1];
        count += 1;
    }
    zeros
}

impl Rounding {
    /// Rounding over a piece, formula (12.2). `speed` is |δq̇| \[rad/s\], `h` is the length \[s\], `q0` and `q1` are the positions at the ends
    /// \[rad\].
    fn new(speed: JointVector, h: f64, [q0, q1]: [JointVector; 2]) -> Self {
        Self {
            position: speed * h + q0.abs().sup(&q1.abs()) * f64::EPSILON,
            speed,
            acceleration: speed / h,
        }
    }
}

impl Extent {
    /// Combines the bounds of two stretches. The jump of speed at a knot between them is not included.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            least: self.least.inf(&other.least),
            most: self.most.sup(&other.most),
            speed: self.speed.sup(&other.speed),
            acceleration: self.acceleration.sup(&other.acceleration),
            jumps: self.jumps + other.jumps,
        }
    }

    /// Greatest distance of each joint from `q` \[rad\].
    pub fn drift(&self, q: &JointVector) -> JointVector {
        (self.most - q).sup(&(q - self.least))
    }
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from)
    }

    /// A number as a sum of two, right to 2⁻¹⁰⁴ of it (Dekker, Numer. Math. 18, 1971).
    #[derive(Clone, Copy)]
    struct DoubleDouble(f64, f64);

    impl DoubleDouble {
        fn sum(a: f64, b: f64) -> Self {
            let s = a + b;
            let t = s - a;
            Self(s, (a - (s - t)) + (b - t))
        }

        fn plus(self, other: Self) -> Self {
            let s = Self::sum(self.0, other.0);
            Self::sum(s.0, s.1 + self.1 + other.1)
        }

        fn times(self, by: f64) -> Self {
            let p = self.0 * by;
            Self::sum(p, self.0.mul_add(by, -p) + self.1 * by)
        }

        fn over(self, by: Self) -> Self {
            let first = self.0 / by.0;
            let rest = self.plus(by.times(-first));
            let second = rest.0 / by.0;
            Self::sum(first, second)
        }
    }

    /// Accelerations of one joint at both ends of a piece, from its knots as they stand \[rad/s²\]: (6m − 4v₀ − 2v₁)/h and
    /// (2v₀ + 4v₁ − 6m)/h.
    fn accelerations([from, to]: [f64; 2], [q0, q1]: [f64; 2], [v0, v1]: [f64; 2]) -> [f64; 2] {
        let h = DoubleDouble::sum(to, -from);
        let m = DoubleDouble::sum(q1, -q0).over(h).times(6.0);
        [[-4.0, -2.0, 1.0], [2.0, 4.0, -1.0]].map(|[a, b, sign]| {
            let sum = m
                .times(sign)
                .plus(DoubleDouble(a * v0, 0.0))
                .plus(DoubleDouble(b * v1, 0.0));
            sum.over(h).0
        })
    }

    proptest! {
        /// The knots' values are within the bounds, however short and however late a piece is. Speeds are those of an even motion, a few
        /// units in the last place off, where rounding is all there is.
        #[test]
        fn bounds_hold_for_the_exact_knots(
            start in 0.0..60.0f64, steps in 1..40i32, long in -16.0..0.0f64, q0 in -3.0..3.0f64, v in -2.0..2.0f64, off in [-4..4i32, -4..4i32],
        ) {
            let least = if start > 0.0 { start.next_up() - start } else { f64::EPSILON };
            let end = start + (least * f64::from(steps)).max(10f64.powf(long));
            let h = end - start;
            let q = [q0, q0 + v * h];
            let m = (q[1] - q[0]) / h;
            let speeds = off.map(|k| m + f64::from(k) * (m.abs().next_up() - m.abs()));
            let all = JointVector::repeat;
            let piece = Piece::new([start, end], q.map(all), speeds.map(all));
            let most = accelerations([start, end], q, speeds).into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
            let extent = piece.extent([0.0, h]);
            prop_assert!(most <= extent.acceleration[0], "{most} {}", extent.acceleration[0]);
            let jerk = {
                let [a, b] = accelerations([start, end], q, speeds);
                (b - a).abs() / h
            };
            prop_assert!(jerk <= piece.jerk()[0] * (1.0 + 1e-15), "{jerk} {}", piece.jerk()[0]);
            prop_assert!(extent.least[0] <= q[0].min(q[1]) && extent.most[0] >= q[0].max(q[1]));
            prop_assert!(extent.speed[0] >= speeds[0].abs().max(speeds[1].abs()));
            // And they are no more than rounding above it.
            let room = 4.0 * ROUNDING * speeds[0].abs().max(speeds[1].abs()) * 3.0 / h;
            prop_assert!(extent.acceleration[0] <= most + room);
        }

        #[test]
        fn extremes_hold_between_knots_and_are_attained(q in [vector(), vector()], v in [vector(), vector()], a in prop::option::of([vector(), vector()]), cut in [0.0..0.5f64, 0.5..1.0f64]) {
            let t = [1.0, 1.25];
            let piece = Piece::from(&MotionPiece { t_s: t, q_rad: q, qd_rad_s: v.map(|v| v * 5.0), qdd_rad_s2: a.map(|a| a.map(|a| a * 100.0)) });
            if a.is_some() {
                prop_assert!((piece.position(0.25) - q[1]).amax() < 1e-9 && (piece.speed(0.25) - v[1] * 5.0).amax() < 1e-8);
                prop_assert!((piece.acceleration(0.25) - a.unwrap()[1] * 100.0).amax() < 1e-7);
            }
            let u = cut.map(|c| c * piece.length_s);
            let extent = piece.extent(u);
            let mut seen = Extent { least: piece.position(u[0]), most: piece.position(u[0]), speed: JointVector::zeros(), acceleration: JointVector::zeros(), jumps: JointVector::zeros() };
            for k in 0..=2000 {
                let at = u[0] + (u[1] - u[0]) * f64::from(k) / 2000.0;
                let q = piece.position(at);
                seen = seen.and(&Extent { least: q, most: q, speed: piece.speed(at).abs(), acceleration: piece.acceleration(at).abs(), jumps: JointVector::zeros() });
            }
            for (bound, seen) in [(-extent.least, -seen.least), (extent.most, seen.most), (extent.speed, seen.speed), (extent.acceleration, seen.acceleration)] {
                for j in 0..AXES {
                    prop_assert!(seen[j] <= bound[j] + 1e-9 && seen[j] >= bound[j] - 1e-2 * (1.0 + bound[j].abs()), "{} {}", seen[j], bound[j]);
                }
            }
        }

        #[test]
        fn pieces_give_the_motion_that_the_plan_states(q in [vector(), vector()], v in [vector(), vector()], share in 0.0..0.999f64) {
            let knots = Knots { t_s: vec![0.0, 0.25], q_rad: q.to_vec(), qd_rad_s: v.to_vec() };
            let piece = &pieces(&knots).unwrap()[0];
            let motion = Trajectory::from_knots(knots.t_s, knots.q_rad, knots.qd_rad_s).unwrap();
            let state = motion.at(0.25 * share).unwrap();
            prop_assert!((piece.position(0.25 * share) - state.q).amax() < 1e-12);
            prop_assert!((piece.speed(0.25 * share) - state.qd).amax() < 1e-11);
            prop_assert!((piece.acceleration(0.25 * share) - state.qdd).amax() < 1e-9);
        }
    }
}
