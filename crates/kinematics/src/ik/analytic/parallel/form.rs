//! Equations of the arm and its branches side by side, as a closed form.

use crate::ik::analytic::branch::{Branch, Label, OutOfReach, Shoulder, principal};
use crate::ik::analytic::branch_lanes::Rare;
use crate::ik::analytic::branches::Branches;
use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::closed_form::{Candidate, ClosedForm};
use crate::ik::analytic::parallel::arm::ParallelAxesArm;
use crate::ik::analytic::parallel::branch_lanes::BranchLanes;
use crate::ik::analytic::search::Search;
use crate::ik::analytic::window::{NearestConfiguration, Window};
use crate::joints::JointVector;
use crate::lanes::run_exact;
use crate::rotation::RigidTransform;

impl ClosedForm for ParallelAxesArm {
    fn chain(&self) -> &Chain {
        &self.chain
    }

    fn structure(&self) -> &'static str {
        "axes 2, 3 and 4 parallel, axes 5 and 6 meet"
    }

    fn shoulder_sides_are_alike(&self) -> bool {
        true
    }

    fn all_branches(&self, target: &RigidTransform, previous: &JointVector) -> Branches<Result<Branch, OutOfReach>> {
        let goal = &self.links.goal(target);
        let all = BranchLanes {
            arm: self,
            goal,
            window: None,
        };
        match run_exact(all) {
            Ok(all) => Branches::of_eight(|label| {
                let (q, degenerate) = all.branches[label.index()]?;
                Ok(Branch::new(q, label, degenerate))
            }),
            Err(Rare) => {
                let branches = self.branches_in_turn(goal, previous);
                Branches::of_eight(|label| branches[label.index()])
            }
        }
    }

    fn all_within(&self, target: &RigidTransform, window: &Window<'_>) -> Branches<Result<Candidate, OutOfReach>> {
        self.all_branches(target, &window.anchor).map(|slot| {
            let branch = (*slot)?;
            Ok((branch, window.nearest(&branch.q)))
        })
    }

    fn search(&self, target: &RigidTransform, window: &Window<'_>) -> Option<NearestConfiguration> {
        let goal = &self.links.goal(target);
        let all = BranchLanes {
            arm: self,
            goal,
            window: Some(window),
        };
        let mut search = Search::new(self, target, window);
        match run_exact(all) {
            Ok(all) => {
                for label in Label::EIGHT
                    .into_iter()
                    .filter(|label| all.admitted >> label.index() & 1 == 1)
                {
                    if let Ok((q, degenerate)) = all.branches[label.index()] {
                        search.offer(q, label, degenerate);
                    }
                }
            }
            Err(Rare) => {
                for branch in self.branches_in_turn(goal, &window.anchor).iter().flatten() {
                    if let Some(q) = window.nearest(&branch.q) {
                        search.offer(q, branch.label, branch.degenerate);
                    }
                }
            }
        }
        search.best
    }

    /// Other values of joint 4, where the sum of joints 2 to 4 is free, nearest to the anchor first.
    fn elsewhere(&self, target: &RigidTransform, window: &Window<'_>) -> Vec<JointVector> {
        let (goal, anchor) = (self.links.goal(target), &window.anchor);
        let of_side = |side| {
            let swing = self.links.swing(&goal, side, anchor[0]).ok()?;
            let turn = Some(self.turn(&swing, anchor)).filter(|turn| turn.free)?;
            Some(self.critical_sums(&swing, &turn, window))
        };
        let sums = [Shoulder::Front, Shoulder::Back]
            .into_iter()
            .filter_map(of_side)
            .flatten();
        let links = self.sign_4 * self.turn_of_links(anchor[1], anchor[2]);
        window.anchors_with(3, sums.map(|sum| anchor[3] + principal(sum - links - anchor[3])))
    }

    fn regularity(&self, q: &JointVector) -> f64 {
        let hand = self.turned_hand(self.sum(q));
        self.links.regularity(q, hand, q[4] + self.turns.at_zero[0])
    }
}
