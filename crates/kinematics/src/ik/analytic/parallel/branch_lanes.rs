//! The branches of an arm with parallel axes 2, 3 and 4, side by side in the lanes of vectors: front and back, wrist plain and flipped. The
//! elbows follow one after the other.

use crate::ik::analytic::branch::{Degeneracies, Label, OutOfReach, Shoulder, Wrist};
use crate::ik::analytic::branch_lanes::{
    Complexes, Rare, Swings, Triangles, Turns, Within, all_lanes, angles_of_both, degeneracies, product, splat, times,
    turned,
};
use crate::ik::analytic::links::Goal;
use crate::ik::analytic::parallel::arm::ParallelAxesArm;
use crate::ik::analytic::tolerances::FREE_WRIST_RAD;
use crate::ik::analytic::window::Window;
use crate::joints::JointVector;
use crate::lanes::{Kernel, LANES, Vector};
use crate::trig::atan2_vector;
use nalgebra::Complex;
use std::f64::consts::PI;

/// Lane of a branch.
#[inline(always)]
fn lane(shoulder: Shoulder, wrist: Wrist) -> usize {
    2 * shoulder as usize + wrist as usize
}

/// All branches of a target.
#[derive(Clone)]
pub(crate) struct BranchLanes<'a> {
    pub arm: &'a ParallelAxesArm,
    pub goal: &'a Goal,
    /// Limits and start, where each joint is to take the value within the limits that is nearest to the start.
    pub window: Option<&'a Window<'a>>,
}

/// Branches as the lanes have them.
pub(crate) struct AllBranches {
    /// In the order of [`Label::EIGHT`].
    pub branches: [Result<(JointVector, Degeneracies), OutOfReach>; 8],
    /// Branches within the limits, as bits in that order; all without a window.
    pub admitted: u8,
}

/// Joints in every lane.
struct Lanes<V> {
    /// Joints 1, 5 and 6.
    outer: [V; 3],
    /// Joints 2, 3 and 4, elbow up and down.
    inner: [[V; 3]; 2],
    reached: V,
    /// Axis 4 in the turned plane, from axis 2.
    end: Complexes<V>,
    meets: (bool, [f64; LANES]),
}

impl Kernel for BranchLanes<'_> {
    type Output = Result<AllBranches, Rare>;

    #[inline(always)]
    fn run<V: Vector>(self) -> Self::Output {
        let mut lanes = self.lanes::<V>()?;
        let admitted = match self.window {
            Some(window) => lanes.move_within(window)?,
            None => [!0; 2],
        };
        let (outer, inner) = (arrays(lanes.outer), [arrays(lanes.inner[0]), arrays(lanes.inner[1])]);
        let (reached, end) = (
            lanes.reached.sign_bits(),
            [lanes.end[0].to_array(), lanes.end[1].to_array()],
        );
        let mut all = AllBranches {
            branches: [Err(OutOfReach::NOWHERE); 8],
            admitted: 0,
        };
        for label in Label::EIGHT {
            let (l, elbow) = (lane(label.shoulder, label.wrist), label.elbow as usize);
            all.branches[label.index()] = if reached >> l & 1 == 1 {
                all.admitted |= (admitted[elbow] >> l & 1) << label.index();
                Ok((joints(&outer, &inner[elbow], l), degeneracies(lanes.meets, l)))
            } else {
                let miss = self.arm.links.triangle(Complex::new(end[0][l], end[1][l])).err();
                Err(miss.unwrap_or(OutOfReach::NOWHERE))
            };
        }
        Ok(all)
    }
}

impl<V: Vector> Lanes<V> {
    /// Moves each joint to its value within the limits that is nearest to the start; returns the lanes that have all of them, elbow up and down.
    #[inline(always)]
    fn move_within(&mut self, window: &Window<'_>) -> Result<[u8; 2], Rare> {
        let mut within = Within::all();
        let [q1, q5, q6] = self.outer;
        self.outer = [
            within.value(window, 0, q1),
            within.value(window, 4, q5),
            within.value(window, 5, q6),
        ];
        let mut admitted = [0; 2];
        for (inner, admitted) in self.inner.iter_mut().zip(&mut admitted) {
            let ([q2, q3, q4], mut within) = (*inner, within);
            *inner = [
                within.value(window, 1, q2),
                within.value(window, 2, q3),
                within.value(window, 3, q4),
            ];
            *admitted = within.admitted(self.reached)?;
        }
        Ok(admitted)
    }
}

#[inline(always)]
fn arrays<V: Vector>(joints: [V; 3]) -> [[f64; LANES]; 3] {
    [joints[0].to_array(), joints[1].to_array(), joints[2].to_array()]
}

/// Returns the configuration of a lane.
#[inline(always)]
fn joints(outer: &[[f64; LANES]; 3], inner: &[[f64; LANES]; 3], l: usize) -> JointVector {
    let ([q1, q5, q6], [q2, q3, q4]) = (outer, inner);
    JointVector::new(q1[l], q2[l], q3[l], q4[l], q5[l], q6[l])
}

impl BranchLanes<'_> {
    #[inline(always)]
    fn lanes<V: Vector>(&self) -> Result<Lanes<V>, Rare> {
        let (arm, links) = (self.arm, &self.arm.links);
        let swings = Swings::<V>::new(links, self.goal)?;
        // `E = Kᵀ Rot_z(−q₁) R`.
        let rotation = times(&arm.turns.from_shoulder, turned(&self.goal.rotation, swings.unit));
        let turns = Turns::new(&rotation, all_lanes())?;
        let [q1, first] = angles_of_both(swings.swing, turns.first);
        let [second, third] = angles_of_both(turns.second, turns.third);

        // Flipped, the first and the third go on by half a turn and the second turns round.
        let (flip, half_turn) = (V::from_array([0.0, -0.0, 0.0, -0.0]), V::from_array([0.0, PI, 0.0, PI]));
        let sum = first + half_turn;
        let [at_zero_5, at_zero_6] = [V::splat(arm.turns.at_zero[0]), V::splat(arm.turns.at_zero[1])];
        let (q5, q6) = (second.xor(flip) - at_zero_5, third + half_turn - at_zero_6);
        let (s, c) = turns.unit;
        let (s, c) = (s.xor(flip), c.xor(flip));
        let hand = product([c, V::splat(arm.sign_4) * s], splat(arm.hand));
        let end = [swings.wrist[0] - hand[0], swings.wrist[1] - hand[1]];

        let triangles = Triangles::new(links, end)?;
        self.check_borders(&triangles, turns.sine)?;
        let psi = atan2_vector(triangles.sine, triangles.cosine);
        let front_up = V::from_array([0.0, 0.0, -0.0, -0.0]);
        let up = self.inner(&triangles, psi, front_up, sum);
        let down = self.inner(&triangles, psi, front_up.xor(V::splat(-0.0)), sum);
        Ok(Lanes {
            outer: [q1, q5, q6],
            inner: [up, down],
            reached: triangles.reached,
            end,
            meets: (swings.meets, triangles.sine.to_array()),
        })
    }

    /// Returns joints 2, 3 and 4; `side` holds the sign of ψ.
    #[inline(always)]
    fn inner<V: Vector>(&self, triangles: &Triangles<V>, psi: V, side: V, sum: V) -> [V; 3] {
        let (arm, links) = (self.arm, &self.arm.links);
        let turn = triangles.upper(links, [triangles.cosine, triangles.sine.xor(side)]);
        let [q2, q3] = triangles.joints(links, turn, psi.xor(side));
        let [sign_2, sign_3] = [V::splat(links.signs[0]), V::splat(links.signs[1])];
        [q2, q3, sum - V::splat(arm.sign_4) * (sign_2 * q2 + sign_3 * q3)]
    }

    /// Refuses lanes out of reach that the uncertainty of the turn can bring back: see [`ParallelAxesArm::on_border`].
    #[inline(always)]
    fn check_borders<V: Vector>(&self, triangles: &Triangles<V>, sine: V) -> Result<(), Rare> {
        let [longest, shortest] = self.arm.links.reach();
        let (longest, shortest) = (V::splat(longest), V::splat(shortest));
        let (beyond, short) = (triangles.distance - longest, shortest - triangles.distance);
        let miss = beyond.if_above(short, beyond, short);
        let uncertain = V::splat(2.0 * FREE_WRIST_RAD * self.arm.hand.norm_sqr().sqrt());
        let missed = triangles.reached.xor(all_lanes());
        match (miss * sine).at_most(uncertain).and(missed).sign_bits() {
            0 => Ok(()),
            _ => Err(Rare),
        }
    }
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use crate::RobotModel;
    use crate::ik::analytic::geometry::Geometry;
    use crate::lanes::tests::portable_and_exact;
    use crate::urdf::MeshSource;
    use proptest::prelude::*;

    fn arm() -> (RobotModel, ParallelAxesArm) {
        let text = include_str!("../../../../tests/fixtures/family_8.urdf");
        let robot = RobotModel::from_urdf(text, &MeshSource::none()).unwrap();
        let arm = ParallelAxesArm::recognise(&Geometry::from_robot(&robot))
            .unwrap()
            .unwrap();
        (robot, arm)
    }

    proptest! {
        #[test]
        fn branches_are_those_found_in_turn(
            q in prop::array::uniform6(prop_oneof![4 => -3.0..3.0f64, 1 => Just(0.0)]),
            start in prop::array::uniform6(-3.0..3.0f64),
            stretch in prop_oneof![3 => Just(1.0), 1 => 0.8..1.2f64],
        ) {
            let (robot, arm) = arm();
            let mut target = robot.fk(&q.into()).bodies[6];
            target.translation *= stretch;
            let goal = arm.links.goal(&target);
            let expected = arm.branches_in_turn(&goal, &start.into());
            for found in portable_and_exact(&BranchLanes { arm: &arm, goal: &goal, window: None }).into_iter().flatten() {
                for (found, expected) in found.branches.iter().zip(&expected) {
                    match (found, expected) {
                        (Ok((found, degenerate)), Ok(expected)) => {
                            prop_assert_eq!(*degenerate, expected.degenerate);
                            let apart = (found - expected.q).map(|d| (d / 2.0).sin());
                            prop_assert!(apart.amax() < 1e-7, "{} {}", found, expected.q);
                        }
                        (Err(found), Err(expected)) => prop_assert!((found.by_m - expected.by_m).abs() < 1e-7),
                        _ => prop_assert!(false, "{:?} {:?}", found, expected),
                    }
                }
            }
        }
    }

    #[test]
    fn ordinary_targets_are_not_rare() {
        let (robot, arm) = arm();
        let target = robot.fk(&JointVector::new(0.3, 0.2, 0.9, 0.5, -0.6, 0.7)).bodies[6];
        let all = BranchLanes {
            arm: &arm,
            goal: &arm.links.goal(&target),
            window: None,
        };
        assert!(portable_and_exact(&all).iter().all(Result::is_ok));
    }
}
