//! One cubic of the motion, with its exact extremes, and what ranges of many have in common.

use crate::plan::Knots;
use crate::trajectory::{KnotError, Trajectory};
use platewash_kinematics::{AXES, JointVector};

/// `q(u) = c₀ + c₁u + c₂u² + c₃u³` for u in [0, length].
#[derive(Debug, Clone)]
pub(super) struct Piece {
    /// Time of u = 0 \[s\].
    pub start_s: f64,
    /// \[s\]
    pub length_s: f64,
    c: [JointVector; 4],
}

/// What the joints do within a stretch of time: bounds, exact for a single piece.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    /// Lowest positions \[rad\].
    pub least: JointVector,
    /// Highest positions \[rad\].
    pub most: JointVector,
    /// Greatest speeds \[rad/s\].
    pub speed: JointVector,
    /// Greatest accelerations \[rad/s²\].
    pub acceleration: JointVector,
}

/// The pieces of a plan's knots, in time order.
///
/// # Errors
/// [`KnotError`] for knots that are no motion.
pub(super) fn pieces(knots: &Knots) -> Result<Vec<Piece>, KnotError> {
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

impl Piece {
    /// The cubic Hermite piece between two knots: times \[s\], positions \[rad\], speeds \[rad/s\].
    pub fn new([from, to]: [f64; 2], [q0, q1]: [JointVector; 2], [v0, v1]: [JointVector; 2]) -> Self {
        let h = to - from;
        let mean = (q1 - q0) / h;
        Self {
            start_s: from,
            length_s: h,
            c: [
                q0,
                v0,
                (mean * 3.0 - v0 * 2.0 - v1) / h,
                (v0 + v1 - mean * 2.0) / (h * h),
            ],
        }
    }

    /// Whether a joint's cubic is made of numbers so small that their squares are numbers.
    pub fn is_sane(&self, joint: usize) -> bool {
        self.c.iter().all(|c| c[joint].abs() < 1e100)
    }

    pub fn position(&self, u: f64) -> JointVector {
        let [c0, c1, c2, c3] = &self.c;
        c0 + (c1 + (c2 + c3 * u) * u) * u
    }

    pub fn speed(&self, u: f64) -> JointVector {
        let [_, c1, c2, c3] = &self.c;
        c1 + (c2 * 2.0 + c3 * (3.0 * u)) * u
    }

    pub fn acceleration(&self, u: f64) -> JointVector {
        self.c[2] * 2.0 + self.c[3] * (6.0 * u)
    }

    /// The third derivative's magnitude, constant over the piece \[rad/s³\].
    pub fn jerk(&self) -> JointVector {
        (self.c[3] * 6.0).abs()
    }

    /// Greatest speed of each joint from `u0` to `u1`: a parabola's, at an end or where the acceleration is zero.
    pub fn greatest_speed(&self, [u0, u1]: [f64; 2]) -> JointVector {
        let mut greatest = self.speed(u0).abs().sup(&self.speed(u1).abs());
        for joint in 0..AXES {
            let u = -self.c[2][joint] / (3.0 * self.c[3][joint]);
            if u > u0 && u < u1 {
                greatest[joint] = greatest[joint].max(self.speed(u)[joint].abs());
            }
        }
        greatest
    }

    /// Greatest acceleration of each joint from `u0` to `u1`: a line's, at an end.
    pub fn greatest_acceleration(&self, [u0, u1]: [f64; 2]) -> JointVector {
        self.acceleration(u0).abs().sup(&self.acceleration(u1).abs())
    }

    /// All extremes from `u0` to `u1`.
    pub fn extent(&self, [u0, u1]: [f64; 2]) -> Extent {
        let (start, end) = (self.position(u0), self.position(u1));
        let mut extent = Extent {
            least: start.inf(&end),
            most: start.sup(&end),
            speed: self.greatest_speed([u0, u1]),
            acceleration: self.greatest_acceleration([u0, u1]),
        };
        for joint in 0..AXES {
            for u in self.turns(joint).into_iter().filter(|u| *u > u0 && *u < u1) {
                let q = self.position(u)[joint];
                extent.least[joint] = extent.least[joint].min(q);
                extent.most[joint] = extent.most[joint].max(q);
            }
        }
        extent
    }

    /// Moments at which a joint's position, speed or acceleration may be extreme \[s\].
    pub fn candidates(&self, joint: usize) -> Vec<f64> {
        let fastest = -self.c[2][joint] / (3.0 * self.c[3][joint]);
        let [a, b] = self.turns(joint);
        let inside = [a, b, fastest].into_iter().filter(|u| *u > 0.0 && *u < self.length_s);
        [0.0, self.length_s].into_iter().chain(inside).collect()
    }

    /// Where a joint's speed c₁ + 2c₂u + 3c₃u² is zero; NaN or far away where it nowhere is.
    fn turns(&self, joint: usize) -> [f64; 2] {
        let (a, half_b, c) = (3.0 * self.c[3][joint], self.c[2][joint], self.c[1][joint]);
        let root = (half_b * half_b - a * c).sqrt();
        // The pair of roots that does not cancel (Numerical Recipes, §5.6).
        let sum = -(half_b + if half_b < 0.0 { -root } else { root });
        [sum / a, c / sum]
    }
}

impl Extent {
    /// What two stretches have in common.
    pub fn and(&self, other: &Self) -> Self {
        Self {
            least: self.least.inf(&other.least),
            most: self.most.sup(&other.most),
            speed: self.speed.sup(&other.speed),
            acceleration: self.acceleration.sup(&other.acceleration),
        }
    }

    /// How far the joints get from `q` \[rad\].
    pub fn drift(&self, q: &JointVector) -> JointVector {
        (self.most - q).sup(&(q - self.least))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = JointVector> {
        prop::array::uniform6(-2.0..2.0f64).prop_map(JointVector::from)
    }

    proptest! {
        #[test]
        fn extremes_hold_between_and_are_attained(q in [vector(), vector()], v in [vector(), vector()], cut in [0.0..0.5f64, 0.5..1.0f64]) {
            let piece = Piece::new([1.0, 1.25], q, v);
            let u = cut.map(|c| c * piece.length_s);
            let extent = piece.extent(u);
            let mut seen = Extent { least: piece.position(u[0]), most: piece.position(u[0]), speed: JointVector::zeros(), acceleration: JointVector::zeros() };
            for k in 0..=2000 {
                let at = u[0] + (u[1] - u[0]) * f64::from(k) / 2000.0;
                let q = piece.position(at);
                seen = seen.and(&Extent { least: q, most: q, speed: piece.speed(at).abs(), acceleration: piece.acceleration(at).abs() });
            }
            for (bound, seen) in [(-extent.least, -seen.least), (extent.most, seen.most), (extent.speed, seen.speed), (extent.acceleration, seen.acceleration)] {
                for j in 0..AXES {
                    prop_assert!(seen[j] <= bound[j] + 1e-9 && seen[j] >= bound[j] - 1e-2 * (1.0 + bound[j].abs()), "{} {}", seen[j], bound[j]);
                }
            }
        }

        #[test]
        fn it_is_the_motion_that_the_plan_states(q in [vector(), vector()], v in [vector(), vector()], share in 0.0..0.999f64) {
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
