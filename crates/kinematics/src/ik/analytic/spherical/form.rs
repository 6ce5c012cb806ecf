//! Equations of the arm and its branches side by side, as a closed form.

use crate::ik::analytic::branch::{Branch, Elbow, OutOfReach, Shoulder};
use crate::ik::analytic::branch_lanes::Rare;
use crate::ik::analytic::branches::Branches;
use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::closed_form::{Candidate, ClosedForm};
use crate::ik::analytic::spherical::arm::SphericalWristArm;
use crate::ik::analytic::spherical::branch_lanes::BranchLanes;
use crate::ik::analytic::window::{NearestConfiguration, Window};
use crate::joints::JointVector;
use crate::lanes::run_exact;
use crate::rotation::RigidTransform;
use nalgebra::Complex;

impl ClosedForm for SphericalWristArm {
    fn chain(&self) -> &Chain {
        &self.chain
    }

    fn structure(&self) -> &'static str {
        "spherical wrist, axes 2 and 3 parallel"
    }

    fn shoulder_sides_are_alike(&self) -> bool {
        false
    }

    fn all_branches(&self, target: &RigidTransform, previous: &JointVector) -> Branches<Result<Branch, OutOfReach>> {
        let branches = self.branches_with_turns(target, previous);
        Branches::of_eight(|label| Ok(branches[label.index()]?.0))
    }

    fn all_within(&self, target: &RigidTransform, window: &Window<'_>) -> Branches<Result<Candidate, OutOfReach>> {
        let branches = self.branches_with_turns(target, &window.anchor);
        Branches::of_eight(|label| {
            let (branch, turn) = branches[label.index()]?;
            let within = || {
                let [q1, q2, q3] = [0, 1, 2].map(|joint| window.value(joint, branch.q[joint]));
                let [q4, q5, q6] = self.wrist_within(&turn, branch.label.wrist, window)?;
                Some(JointVector::new(q1?, q2?, q3?, q4, q5, q6))
            };
            Ok((branch, within()))
        })
    }

    fn search(&self, target: &RigidTransform, window: &Window<'_>) -> Option<NearestConfiguration> {
        let goal = &self.links.goal(target);
        let branch_lanes = BranchLanes {
            arm: self,
            target,
            goal,
            window,
        };
        run_exact(branch_lanes).unwrap_or_else(|Rare| self.search_in_turn(target, goal, window))
    }

    /// Other values of joint 1, where it is free, nearest to the anchor first.
    fn elsewhere(&self, target: &RigidTransform, window: &Window<'_>) -> Vec<JointVector> {
        let goal = self.links.goal(target);
        let side = Shoulder::Front;
        let swing = self.links.swing(&goal, side, 0.0).ok().filter(|swing| swing.free);
        let Some(triangle) = swing.and_then(|swing| self.links.triangle(swing.wrist).ok()) else {
            return Vec::new();
        };
        let bends = [Elbow::Up, Elbow::Down].map(|elbow| self.links.bend(&triangle, side, elbow, window.anchor[1]));
        let roots = bends.iter().flat_map(|bend| self.roots(&goal, bend, window));
        let ends = [window.limits.lower[0], window.limits.upper[0]];
        window.anchors_with(0, roots.chain(ends).filter_map(|q1| window.value(0, q1)))
    }

    fn regularity(&self, q: &JointVector) -> f64 {
        self.links
            .regularity(q, Complex::default(), q[4] + self.turns.at_zero[0])
    }
}
