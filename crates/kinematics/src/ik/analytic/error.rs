//! Reasons that there is no analytic answer.

use crate::ik::analytic::branch::{Label, OutOfReach};
use crate::joints::{AXES, JointVector};
use crate::limits::LimitViolation;
use crate::rotation::RigidTransform;
use std::fmt::Debug;

/// Reason that there is no analytic answer.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnalyticError {
    /// The target has NaN or infinite entries.
    #[error("the target pose is not finite: position {position:?} m")]
    Target {
        /// Position of the target \[m\].
        position: [f64; 3],
    },
    /// The start has a NaN or infinite entry.
    #[error("the start of joint {} is not finite: {found}", .joint + 1)]
    Start {
        /// Joint index, 0 for joint 1.
        joint: usize,
        /// Value given \[rad\].
        found: f64,
    },
    /// No branch reaches the wrist centre; holds the one that misses it by least.
    #[error("out of reach: {0}")]
    OutOfReach(OutOfReach),
    /// Every branch that reaches the target breaks a limit; holds the one that breaks its worst limit by least.
    #[error(
        "outside the limits: the nearest branch needs joint {} at {} rad, limit {} rad",
        .violation.joint + 1, .violation.position_rad, .violation.limit_rad
    )]
    Limits {
        /// Label of the branch.
        label: Label,
        /// Violation of its worst joint.
        violation: LimitViolation,
    },
}

/// Refuses targets and starts with NaN or infinite entries.
#[inline]
pub(crate) fn check_finite(target: &RigidTransform, start: &JointVector) -> Result<(), AnalyticError> {
    // A sum is finite only if its terms are; targets so large that it overflows are no poses either.
    if !(target.rotation.sum() + target.translation.sum()).is_finite() {
        let position = target.translation.into();
        return Err(AnalyticError::Target { position });
    }
    match (0..AXES).find(|&joint| !start[joint].is_finite()) {
        Some(joint) => Err(AnalyticError::Start {
            joint,
            found: start[joint],
        }),
        None => Ok(()),
    }
}
