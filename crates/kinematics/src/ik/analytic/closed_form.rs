//! Closed form of one structure of arm.

use crate::ik::analytic::branch::{Branch, OutOfReach};
use crate::ik::analytic::branches::Branches;
use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::window::{NearestConfiguration, Window};
use crate::joints::JointVector;
use crate::limits::JointLimits;
use crate::rotation::RigidTransform;
use std::fmt::Debug;

/// Branch, and its configuration within the limits or nearly so.
pub(crate) type Candidate = (Branch, Option<JointVector>);

/// Closed form of one structure of arm. Configurations are answers for body 6; `previous` and the window's anchor decide free joints.
pub(crate) trait ClosedForm: Debug + Send + Sync {
    /// Returns the chain as described.
    fn chain(&self) -> &Chain;
    /// Returns words for the structure.
    fn structure(&self) -> &'static str;
    /// See [`AnalyticArm::shoulder_sides_are_alike`](crate::ik::analytic::arm::AnalyticArm::shoulder_sides_are_alike).
    fn shoulder_sides_are_alike(&self) -> bool;
    /// Returns all branches; limits are not checked.
    fn all_branches(&self, target: &RigidTransform, previous: &JointVector) -> Branches<Result<Branch, OutOfReach>>;
    /// Returns all branches, each with its configuration nearest to the start that is within the limits or nearly so.
    fn all_within(&self, target: &RigidTransform, window: &Window<'_>) -> Branches<Result<Candidate, OutOfReach>>;
    /// Returns the answer nearest to the start.
    fn search(&self, target: &RigidTransform, window: &Window<'_>) -> Option<NearestConfiguration>;
    /// Returns the anchors that remain to be tried where a joint is free and its value at the anchor led to no answer.
    fn elsewhere(&self, target: &RigidTransform, window: &Window<'_>) -> Vec<JointVector>;
    /// Returns |det J| up to a constant factor.
    fn regularity(&self, q: &JointVector) -> f64;

    /// Returns `q` within the limits: see [`Chain::move_within_limits`].
    #[inline]
    fn moved_within_limits(
        &self,
        target: &RigidTransform,
        q: JointVector,
        limits: &JointLimits,
    ) -> Option<JointVector> {
        let chain = self.chain();
        if chain.rounding.is_none() && limits.contain(&q) {
            return Some(q);
        }
        chain.move_within_limits(target, q, limits, || self.regularity(&q))
    }
}
