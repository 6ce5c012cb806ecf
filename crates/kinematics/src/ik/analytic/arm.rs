//! Arm whose inverse kinematics has a closed form.

use crate::ik::analytic::branch::{Branch, OutOfReach};
use crate::ik::analytic::branches::Branches;
use crate::ik::analytic::closed_form::ClosedForm;
use crate::ik::analytic::error::{AnalyticError, check_finite};
use crate::ik::analytic::mismatch::StructureMismatch;
use crate::joints::{AXES, JointVector};
use crate::model::Frame;
use crate::rotation::RigidTransform;
use std::fmt::Debug;
use std::sync::Arc;

/// Arm whose inverse kinematics has a closed form: see the [module](super) text. Immutable; copies share it.
#[derive(Debug, Clone)]
pub struct AnalyticArm {
    pub(super) form: Arc<dyn ClosedForm>,
}

impl AnalyticArm {
    /// Returns all branches for `target`, `T_base_body6` of the folded chain (the pose of [`Frame`](crate::Frame) on body 6 without offset;
    /// its rotation orthonormal to rounding), each within reach or not. Free joints keep the value they have in `previous` \[rad\]. Limits are
    /// not checked.
    ///
    /// # Errors
    /// [`AnalyticError::Target`] and [`AnalyticError::Start`] for input that is not finite.
    pub fn branches(
        &self,
        target: &RigidTransform,
        previous: &JointVector,
    ) -> Result<Branches<Result<Branch, OutOfReach>>, AnalyticError> {
        check_finite(target, previous)?;
        Ok(self.form.all_branches(target, previous))
    }

    /// First property that holds only up to the rounding of the description's numbers; `None` if all hold to the tolerances.
    #[must_use]
    pub fn rounding(&self) -> Option<StructureMismatch> {
        self.form.chain().rounding
    }

    /// Words for the structure that makes a closed form possible: "spherical wrist, axes 2 and 3 parallel".
    #[must_use]
    pub fn structure(&self) -> &'static str {
        self.form.structure()
    }

    /// True if the arm works equally well with the wrist centre on either side of axis 1: with parallel axes 2, 3 and 4 a half turn of joint 1
    /// mirrors it. With a spherical wrist the back is over the shoulder.
    #[must_use]
    pub fn shoulder_sides_are_alike(&self) -> bool {
        self.form.shoulder_sides_are_alike()
    }

    /// Returns the target of body 6, `T_base_body6`, for a target of `frame` on it, `T_base_frame`.
    ///
    /// `None` unless body 6, the one behind joint 6, carries the frame.
    #[must_use]
    pub fn body_target(frame: &Frame, target: &RigidTransform) -> Option<RigidTransform> {
        (frame.body() == AXES).then(|| target.then(&frame.offset.inverse()))
    }
}
