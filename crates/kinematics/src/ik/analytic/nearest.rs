//! Analytic answer nearest to a start.

use crate::ik::analytic::all::{Rejection, Solutions};
use crate::ik::analytic::arm::AnalyticArm;
use crate::ik::analytic::branch::{Label, OutOfReach};
use crate::ik::analytic::error::{AnalyticError, check_finite};
use crate::ik::analytic::window::{NearestConfiguration, Window};
use crate::joints::JointVector;
use crate::limits::{JointLimits, LimitViolation};
use crate::rotation::RigidTransform;

impl AnalyticArm {
    /// Returns the configuration within `limits` that brings body 6 to `target` (`T_base_body6`, as for [`AnalyticArm::branches`]) and is
    /// nearest to `start` \[rad\]: `min ‖q − start‖`, Euclidean over the six joints, over all branches and whole turns. Ties go to the
    /// first in the order of [`Label::index`], and to the turn further from zero.
    ///
    /// Free joints keep their value in `start` (set to the nearer limit if it is outside), as far as the
    /// limits of the others allow. A continuous joint follows the start for up to [`crate::ik::analytic::tolerances::MOST_TURNS`] turns.
    ///
    /// # Errors
    /// [`AnalyticError`]: input that is not finite, or the branch that misses the reach or the limits by least.
    pub fn nearest(
        &self,
        target: &RigidTransform,
        start: &JointVector,
        limits: &JointLimits,
    ) -> Result<NearestConfiguration, AnalyticError> {
        check_finite(target, start)?;
        let window = Window::new(limits, start);
        match self.form.search(target, &window) {
            Some(found) => Ok(found),
            None => self.search_elsewhere(target, &window),
        }
    }

    /// Searches with other values of the joint that is free, if one is; otherwise returns the reason.
    #[cold]
    fn search_elsewhere(
        &self,
        target: &RigidTransform,
        window: &Window<'_>,
    ) -> Result<NearestConfiguration, AnalyticError> {
        (self.form.elsewhere(target, window).into_iter())
            .find_map(|anchor| self.form.search(target, &window.anchored(anchor)))
            .ok_or_else(|| least_miss(&self.all_within(target, window)))
    }
}

/// Returns the rejection by a limit that misses by least; without any, the least distance from reach.
fn least_miss(solutions: &Solutions) -> AnalyticError {
    let by = |violation: &LimitViolation| (violation.position_rad - violation.limit_rad).abs();
    let cost = |rejection: &Rejection| match rejection {
        Rejection::Limit(violation) => (0, by(violation)),
        Rejection::OutOfReach(miss) => (1, miss.by_m),
    };
    let less = |a: &Rejection, b: &Rejection| cost(a) < cost(b);
    let mut least = (Label::EIGHT[0], Rejection::OutOfReach(OutOfReach::NOWHERE));
    for (label, rejection) in solutions.rejections() {
        if less(&rejection, &least.1) {
            least = (label, rejection);
        }
    }
    match least {
        (label, Rejection::Limit(violation)) => AnalyticError::Limits { label, violation },
        (_, Rejection::OutOfReach(miss)) => AnalyticError::OutOfReach(miss),
    }
}
