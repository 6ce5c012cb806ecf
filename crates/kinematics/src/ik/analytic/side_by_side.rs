//! The search for the nearest answer with all four arm branches side by side in the lanes of vectors.
//!
//! The equations are those of `links`, `wrist` and `spherical`, operation by operation, so that the answers have the same bits. What is rare is left to the
//! search branch by branch: joints that are free, joints that only the second, wider tolerance of the limits admits, and rounded arms.

use crate::JointVector;
use crate::ik::analytic::branch::{Degeneracies, Elbow, Label, Shoulder, Wrist};
use crate::ik::analytic::links::{ELBOWS_MEET, Goal};
use crate::ik::analytic::nearest::{NearestConfiguration, Search, Window};
use crate::ik::analytic::spherical::SphericalWristArm;
use crate::ik::analytic::{FREE_SHOULDER_M, FREE_WRIST_RAD, LIMIT_NEAR_RAD, LIMIT_ROUNDING_RAD, REACH_ROUNDING_M};
use crate::lanes::{Kernel, LANES, Vector};
use crate::rotation::RigidTransform;
use crate::trig::atan2_vector;
use nalgebra::Matrix3;
use std::f64::consts::{PI, TAU};

/// Branches of the arm, in the order of the lanes.
const ARMS: [(Shoulder, Elbow); LANES] = [
    (Shoulder::Front, Elbow::Up),
    (Shoulder::Front, Elbow::Down),
    (Shoulder::Back, Elbow::Up),
    (Shoulder::Back, Elbow::Down),
];

/// Case that the lanes do not treat.
pub(crate) struct Rare;

/// The search for the nearest answer.
#[derive(Clone)]
pub(crate) struct SideBySide<'a> {
    pub arm: &'a SphericalWristArm,
    pub target: &'a RigidTransform,
    pub goal: &'a Goal,
    pub window: &'a Window<'a>,
}

/// Complex numbers lane by lane.
type Complexes<V> = [V; 2];

/// Joints 1 to 3 and the wrist's rotation in every lane.
struct Arms<V> {
    q: [V; 3],
    /// `E` by rows.
    wrist: [[V; 3]; 3],
    /// Lanes that reach the wrist centre.
    reached: V,
    /// Front and back meet; elbow up and down meet, by lane.
    meets: (bool, [f64; LANES]),
}

impl Kernel for SideBySide<'_> {
    type Output = Result<Option<NearestConfiguration>, Rare>;

    #[inline(always)]
    fn run<V: Vector>(self) -> Self::Output {
        let arms = self.arms::<V>()?;
        let [first, second, third] = arms.turns()?;
        let [at_zero_5, at_zero_6] = [V::splat(self.arm.turns.at_zero[0]), V::splat(self.arm.turns.at_zero[1])];
        let (half_turn, minus) = (V::splat(PI), V::splat(-0.0));
        let mut within = Within::all();
        let (q1, q2, q3) = (
            within.value(self.window, 0, arms.q[0]),
            within.value(self.window, 1, arms.q[1]),
            within.value(self.window, 2, arms.q[2]),
        );
        let (mut plain, mut flipped) = (within, within);
        let plain_q = [
            plain.value(self.window, 3, first),
            plain.value(self.window, 4, second - at_zero_5),
            plain.value(self.window, 5, third - at_zero_6),
        ];
        let flipped_q = [
            flipped.value(self.window, 3, first + half_turn),
            flipped.value(self.window, 4, second.xor(minus) - at_zero_5),
            flipped.value(self.window, 5, third + half_turn - at_zero_6),
        ];
        let (plain, flipped) = (plain.admitted(arms.reached)?, flipped.admitted(arms.reached)?);
        let arm_q = [q1, q2, q3];
        let distances = [
            self.squared_distances(&arm_q, &plain_q),
            self.squared_distances(&arm_q, &flipped_q),
        ];
        let rows = [q1.to_array(), q2.to_array(), q3.to_array()];
        let wrists = [
            [plain_q[0].to_array(), plain_q[1].to_array(), plain_q[2].to_array()],
            [
                flipped_q[0].to_array(),
                flipped_q[1].to_array(),
                flipped_q[2].to_array(),
            ],
        ];
        let admitted = [plain, flipped];
        let mut search = Search::new(self.arm, self.target, self.window);
        for (l, (shoulder, elbow)) in ARMS.into_iter().enumerate() {
            for (k, wrist) in [Wrist::Plain, Wrist::Flipped].into_iter().enumerate() {
                if admitted[k] >> l & 1 == 0 || distances[k][l] >= search.least {
                    continue;
                }
                let [q4, q5, q6] = [wrists[k][0][l], wrists[k][1][l], wrists[k][2][l]];
                let q = JointVector::new(rows[0][l], rows[1][l], rows[2][l], q4, q5, q6);
                let degenerate = Degeneracies {
                    shoulder: arms.meets.0,
                    elbow: arms.meets.1[l] <= ELBOWS_MEET,
                    wrist: false,
                };
                search.offer(q, Label::new(shoulder, elbow, wrist), degenerate);
            }
        }
        Ok(search.best)
    }
}

impl<V: Vector> Arms<V> {
    /// Returns `[q₄, q₅ + α₅, q₆ + α₆]` of the plain wrist.
    #[inline(always)]
    fn turns(&self) -> Result<[V; 3], Rare> {
        let [e11, e12, e13] = self.wrist[0];
        let [e21, e22, e23] = self.wrist[1];
        let e33 = self.wrist[2][2];
        let sine = (e13 * e13 + e23 * e23).sqrt();
        if sine.at_most(V::splat(FREE_WRIST_RAD)).and(self.reached).sign_bits() != 0 {
            return Err(Rare);
        }
        let (s, c) = (e23 / sine, e13 / sine);
        Ok([
            atan2_vector(e23, e13),
            atan2_vector(c * e13 + s * e23, e33),
            atan2_vector(c * e21 - s * e11, c * e22 - s * e12),
        ])
    }
}

impl SideBySide<'_> {
    /// Computes joints 1 to 3 and the rest for the wrist.
    #[inline(always)]
    fn arms<V: Vector>(&self) -> Result<Arms<V>, Rare> {
        let (arm, w, b) = (self.arm, &self.goal.wrist, self.arm.links.lateral_offset);
        let r = (w.x * w.x + w.y * w.y).sqrt();
        let free = b == 0.0 && r <= FREE_SHOULDER_M;
        if arm.chain.rounding.is_some() || free || r < b.abs() - REACH_ROUNDING_M {
            return Err(Rare);
        }
        let out = ((r - b.abs()) * (r + b.abs())).max(0.0).sqrt();
        let x = V::from_array([out, out, -out, -out]);
        let s = x * V::splat(w.y) - V::splat(b * w.x);
        let c = x * V::splat(w.x) + V::splat(b * w.y);
        let swing = (s, c);
        let scale = V::splat(1.0) / (s * s + c * c).sqrt();
        let (s, c) = (s * scale, c * scale);

        let wrist = [V::splat(w.z), x - V::splat(arm.links.shoulder_offset)];
        let (bend, q, reached) = self.bend(wrist, swing)?;
        let [_, sine] = bend.bent;
        let rotation = self.rotation(s, c, bend.forearm);
        Ok(Arms {
            q,
            wrist: rotation,
            reached,
            meets: (out <= ELBOWS_MEET * r, positive(sine).to_array()),
        })
    }

    /// Computes the triangle and joints 1 to 3, and the lanes that reach the wrist centre. `swing` is `e^{iq₁}`, not of unit length.
    #[inline(always)]
    fn bend<V: Vector>(&self, wrist: Complexes<V>, swing: (V, V)) -> Result<(Bends<V>, [V; 3], V), Rare> {
        let arm = &self.arm.links;
        let [upper, fore] = arm.lengths;
        let (longest, shortest) = (upper + fore, (upper - fore).abs());
        let distance = squared_norm(wrist).sqrt();
        if distance.at_most(V::splat(FREE_SHOULDER_M)).sign_bits() != 0 {
            return Err(Rare);
        }
        let near = distance.at_most(V::splat(longest + REACH_ROUNDING_M));
        let reached = near.and(V::splat(shortest - REACH_ROUNDING_M).at_most(distance));
        let (zero, one) = (V::splat(0.0), V::splat(1.0));
        let share = |product: V| {
            let share = product / V::splat(4.0 * upper * fore);
            let above = zero.if_above(share, zero, share);
            above.if_above(one, one, above)
        };
        let sine_squared = share((V::splat(longest) - distance) * (V::splat(longest) + distance));
        let cosine_squared = share((distance - V::splat(shortest)) * (distance + V::splat(shortest)));
        let sine = V::splat(2.0) * (sine_squared * cosine_squared).sqrt();
        let cosine = cosine_squared - sine_squared;
        // Two lanes of each are the same.
        let of_both = |a: V, b: V| {
            let ([front, _, back, _], [front_2, _, back_2, _]) = (a.to_array(), b.to_array());
            V::from_array([front, back, front_2, back_2])
        };
        let both = atan2_vector(of_both(swing.0, sine), of_both(swing.1, cosine)).to_array();
        let q1 = V::from_array([both[0], both[0], both[1], both[1]]);
        let psi = V::from_array([both[2], both[2], both[3], both[3]]);

        // The elbow's side turns ψ round.
        let side = V::from_array([0.0, -0.0, -0.0, 0.0]);
        let (psi, bent) = (psi.xor(side), [cosine, sine.xor(side)]);
        let reach = [bent[0] * V::splat(fore) + V::splat(upper), bent[1] * V::splat(fore)];
        let turn = product(product(wrist, conjugate(reach)), conjugate(splat(arm.upper_at_zero)));
        let [sign_2, sign_3] = [V::splat(arm.signs[0]), V::splat(arm.signs[1])];
        let q2 = sign_2 * atan2_vector(turn[1], turn[0]);
        let norm = squared_norm(turn).sqrt();
        let forearm = product(
            product([turn[0] / norm, turn[1] / norm], bent),
            conjugate(splat(arm.turn_at_zero)),
        );
        let q3 = sign_3 * (psi - V::splat(arm.bend_at_zero));
        Ok((Bends { bent, forearm }, [q1, q2, q3], reached))
    }

    /// Returns `E = Kᵀ Rot_y(−θ₂₃) Rot_z(−q₁) R`.
    #[inline(always)]
    fn rotation<V: Vector>(&self, s: V, c: V, forearm: Complexes<V>) -> [[V; 3]; 3] {
        let (r, k): (&Matrix3<f64>, _) = (&self.goal.rotation, &self.arm.turns.from_shoulder);
        let [fore_c, fore_s] = forearm;
        let mut rotation = [[V::splat(0.0); 3]; 3];
        for column in 0..3 {
            let [x, y, z] = [
                V::splat(r[(0, column)]),
                V::splat(r[(1, column)]),
                V::splat(r[(2, column)]),
            ];
            let (x, y) = (x * c + y * s, y * c - x * s);
            let (x, z) = (x * fore_c - z * fore_s, x * fore_s + z * fore_c);
            for row in 0..3 {
                let [a, b, d] = [V::splat(k[(row, 0)]), V::splat(k[(row, 1)]), V::splat(k[(row, 2)])];
                rotation[row][column] = a * x + b * y + d * z;
            }
        }
        rotation
    }

    /// Squared distances from the start, joint after joint.
    #[inline(always)]
    fn squared_distances<V: Vector>(&self, arm: &[V; 3], wrist: &[V; 3]) -> [f64; LANES] {
        let square = |q: V, joint: usize| {
            let d = q - V::splat(self.window.start[joint]);
            d * d
        };
        let arm = square(arm[0], 0) + square(arm[1], 1) + square(arm[2], 2);
        (arm + square(wrist[0], 3) + square(wrist[1], 4) + square(wrist[2], 5)).to_array()
    }
}

/// Bends of the elbow.
struct Bends<V> {
    /// `e^{iψ}`.
    bent: Complexes<V>,
    /// `e^{iθ₂₃}`.
    forearm: Complexes<V>,
}

/// Lanes whose joints are within the limits so far.
#[derive(Clone, Copy)]
struct Within<V> {
    /// Up to [`LIMIT_ROUNDING_RAD`].
    exactly: V,
    /// Up to [`LIMIT_NEAR_RAD`].
    nearly: V,
}

impl<V: Vector> Within<V> {
    #[inline(always)]
    fn all() -> Self {
        let all = V::splat(0.0).at_most(V::splat(0.0));
        Self {
            exactly: all,
            nearly: all,
        }
    }

    /// Returns [`Window::value`] of the angles and takes out the lanes that have none.
    #[inline(always)]
    fn value(&mut self, window: &Window<'_>, joint: usize, angle: V) -> V {
        let turns = (V::splat(window.anchor[joint]) - angle) * V::splat(1.0 / TAU);
        let half = turns.and(V::splat(-0.0)).xor(V::splat(0.5));
        let turn = V::splat(TAU);
        let q = angle + turn * (turns + half).truncated();
        let (lower, upper) = (window.limits.lower[joint], window.limits.upper[joint]);
        let (lowest, highest) = (V::splat(lower - LIMIT_NEAR_RAD), V::splat(upper + LIMIT_NEAR_RAD));
        let q = q.if_above(highest, q - turn, lowest.if_above(q, q + turn, q));
        self.nearly = self.nearly.and(lowest.at_most(q)).and(q.at_most(highest));
        let (lowest, highest) = (
            V::splat(lower - LIMIT_ROUNDING_RAD),
            V::splat(upper + LIMIT_ROUNDING_RAD),
        );
        self.exactly = self.exactly.and(lowest.at_most(q)).and(q.at_most(highest));
        q
    }

    /// Returns the lanes that are left, as bits, of those that reach the target.
    #[inline(always)]
    fn admitted(&self, reached: V) -> Result<u8, Rare> {
        let [exactly, nearly] = [
            self.exactly.and(reached).sign_bits(),
            self.nearly.and(reached).sign_bits(),
        ];
        if exactly == nearly { Ok(exactly) } else { Err(Rare) }
    }
}

#[inline(always)]
fn positive<V: Vector>(x: V) -> V {
    x.xor(x.and(V::splat(-0.0)))
}

#[inline(always)]
fn splat<V: Vector>(z: nalgebra::Complex<f64>) -> Complexes<V> {
    [V::splat(z.re), V::splat(z.im)]
}

#[inline(always)]
fn conjugate<V: Vector>([re, im]: Complexes<V>) -> Complexes<V> {
    [re, im.xor(V::splat(-0.0))]
}

#[inline(always)]
fn product<V: Vector>(a: Complexes<V>, b: Complexes<V>) -> Complexes<V> {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

#[inline(always)]
fn squared_norm<V: Vector>([re, im]: Complexes<V>) -> V {
    re * re + im * im
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RobotModel;
    use crate::ik::analytic::recognise::Geometry;
    use crate::lanes::tests::portable_and_exact;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn answers_have_the_bits_of_the_search_branch_by_branch(
            q in prop::array::uniform6(prop_oneof![4 => -3.0..3.0f64, 1 => Just(0.0)]),
            start in prop::array::uniform6(-3.0..3.0f64),
            stretch in prop_oneof![3 => Just(1.0), 1 => 0.8..1.2f64],
        ) {
            let robot = RobotModel::irb120().map_err(|error| TestCaseError::fail(error.to_string()))?;
            let arm = Geometry::of(&robot).spherical().map_err(|error| TestCaseError::fail(error.to_string()))?;
            let mut target = robot.fk(&q.into()).bodies[6];
            target.translation *= stretch;
            let (goal, window) = (arm.links.goal(&target), Window::new(robot.limits(), &start.into()));
            let expected = arm.search_in_turn(&target, &goal, &window);
            let side_by_side = SideBySide { arm: &arm, target: &target, goal: &goal, window: &window };
            for found in portable_and_exact(&side_by_side).into_iter().flatten() {
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn ordinary_targets_are_not_rare() {
        let robot = RobotModel::irb120().unwrap();
        let arm = Geometry::of(&robot).spherical().unwrap();
        let target = robot.fk(&JointVector::new(0.3, 0.2, -0.4, 0.5, 0.6, -0.7)).bodies[6];
        let (goal, window) = (
            arm.links.goal(&target),
            Window::new(robot.limits(), &JointVector::zeros()),
        );
        let side_by_side = SideBySide {
            arm: &arm,
            target: &target,
            goal: &goal,
            window: &window,
        };
        assert!(portable_and_exact(&side_by_side).iter().all(Result::is_ok));
    }
}
