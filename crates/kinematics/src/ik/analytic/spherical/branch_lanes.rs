//! The search for the nearest answer with all four arm branches side by side in the lanes of vectors.
//!
//! The equations are those of `links`, `wrist` and `spherical`, operation by operation, so that the answers have the same bits.

use crate::ik::analytic::branch::{Elbow, Label, Shoulder, Wrist};
use crate::ik::analytic::branch_lanes::{
    Complexes, Rare, Swings, Triangles, Turns, Within, angles_of_both, conjugate, degeneracies, product, splat,
    squared_norm, times, turned,
};
use crate::ik::analytic::links::Goal;
use crate::ik::analytic::search::Search;
use crate::ik::analytic::spherical::arm::SphericalWristArm;
use crate::ik::analytic::window::{NearestConfiguration, Window};
use crate::joints::JointVector;
use crate::lanes::{Kernel, LANES, Vector};
use crate::rotation::RigidTransform;
use crate::trig::atan2_vector;
use std::f64::consts::PI;

/// Branches of the arm, in the order of the lanes.
const ARMS: [(Shoulder, Elbow); LANES] = [
    (Shoulder::Front, Elbow::Up),
    (Shoulder::Front, Elbow::Down),
    (Shoulder::Back, Elbow::Up),
    (Shoulder::Back, Elbow::Down),
];

/// The search for the nearest answer.
#[derive(Clone)]
pub(crate) struct BranchLanes<'a> {
    pub arm: &'a SphericalWristArm,
    pub target: &'a RigidTransform,
    pub goal: &'a Goal,
    pub window: &'a Window<'a>,
}

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

impl Kernel for BranchLanes<'_> {
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
                search.offer(q, Label::new(shoulder, elbow, wrist), degeneracies(arms.meets, l));
            }
        }
        Ok(search.best)
    }
}

impl<V: Vector> Arms<V> {
    /// Returns `[q₄, q₅ + α₅, q₆ + α₆]` of the plain wrist.
    #[inline(always)]
    fn turns(&self) -> Result<[V; 3], Rare> {
        let turn = Turns::new(&self.wrist, self.reached)?;
        Ok([
            atan2_vector(turn.first.0, turn.first.1),
            atan2_vector(turn.second.0, turn.second.1),
            atan2_vector(turn.third.0, turn.third.1),
        ])
    }
}

impl BranchLanes<'_> {
    /// Computes joints 1 to 3 and the rest for the wrist.
    #[inline(always)]
    fn arms<V: Vector>(&self) -> Result<Arms<V>, Rare> {
        let links = &self.arm.links;
        if self.arm.chain.rounding.is_some() {
            return Err(Rare);
        }
        let swings = Swings::<V>::new(links, self.goal)?;
        let triangles = Triangles::new(links, swings.wrist)?;
        let Triangles {
            cosine, sine, reached, ..
        } = triangles;
        let [q1, psi] = angles_of_both(swings.swing, (sine, cosine));

        // The elbow's side turns ψ round.
        let side = V::from_array([0.0, -0.0, -0.0, 0.0]);
        let (psi, bent) = (psi.xor(side), [cosine, sine.xor(side)]);
        let turn = triangles.upper(links, bent);
        let [q2, q3] = triangles.joints(links, turn, psi);
        let norm = squared_norm(turn).sqrt();
        let forearm = product(
            product([turn[0] / norm, turn[1] / norm], bent),
            conjugate(splat(links.turn_at_zero)),
        );
        Ok(Arms {
            q: [q1, q2, q3],
            wrist: self.rotation(swings.unit, forearm),
            reached,
            meets: (swings.meets, sine.to_array()),
        })
    }

    /// Returns `E = Kᵀ Rot_y(−θ₂₃) Rot_z(−q₁) R`.
    #[inline(always)]
    fn rotation<V: Vector>(&self, swing: (V, V), forearm: Complexes<V>) -> [[V; 3]; 3] {
        let [a, b, d] = turned(&self.goal.rotation, swing);
        let leant = [
            turned_about_y(a, forearm),
            turned_about_y(b, forearm),
            turned_about_y(d, forearm),
        ];
        times(&self.arm.turns.from_shoulder, leant)
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

/// Returns `Rot_y(−θ) v` with `e^{iθ}`.
#[inline(always)]
fn turned_about_y<V: Vector>([x, y, z]: [V; 3], [c, s]: Complexes<V>) -> [V; 3] {
    [x * c - z * s, y, x * s + z * c]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RobotModel;
    use crate::ik::analytic::geometry::Geometry;
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
            let arm = SphericalWristArm::recognise(&Geometry::from_robot(&robot)).map_err(|error| TestCaseError::fail(error.to_string()))?;
            let mut target = robot.fk(&q.into()).bodies[6];
            target.translation *= stretch;
            let (goal, window) = (arm.links.goal(&target), Window::new(robot.limits(), &start.into()));
            let expected = arm.search_in_turn(&target, &goal, &window);
            let branch_lanes = BranchLanes { arm: &arm, target: &target, goal: &goal, window: &window };
            for found in portable_and_exact(&branch_lanes).into_iter().flatten() {
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn ordinary_targets_are_not_rare() {
        let robot = RobotModel::irb120().unwrap();
        let arm = SphericalWristArm::recognise(&Geometry::from_robot(&robot)).unwrap();
        let target = robot.fk(&JointVector::new(0.3, 0.2, -0.4, 0.5, 0.6, -0.7)).bodies[6];
        let (goal, window) = (
            arm.links.goal(&target),
            Window::new(robot.limits(), &JointVector::zeros()),
        );
        let branch_lanes = BranchLanes {
            arm: &arm,
            target: &target,
            goal: &goal,
            window: &window,
        };
        assert!(portable_and_exact(&branch_lanes).iter().all(Result::is_ok));
    }
}
