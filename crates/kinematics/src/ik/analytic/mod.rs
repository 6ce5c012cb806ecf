//! Analytic inverse kinematics: all branches of an arm in closed form, for two structures of arms.
//!
//! # Which arms
//!
//! [`AnalyticArm::recognise`] looks at the folded chain alone, `T_base_6 = Π F_i Rot_z(q_i)`, so zero positions,
//! axis signs and the way frames are hung on the links do not matter. Of both structures it asks that
//!
//! - axes 2 and 3 are parallel, and axis 1 is perpendicular to them (it need not meet axis 2, nor be vertical,
//!   nor pass through the base's origin);
//! - axis 5 is perpendicular to axes 4 and 6;
//! - the upper arm (axis 2 to axis 3) and the forearm have a length.
//!
//! A **spherical wrist**: axes 4, 5 and 6 meet in one point, the *wrist centre*, where the forearm ends. That is the ortho-parallel basis
//! with spherical wrist (Brandstötter, Angerer & Hofbaur, 2014), with the direction of axis 4 left open.
//!
//! **Parallel axes 2, 3 and 4**, as of the UR series: axes 5 and 6 meet in the wrist centre, which has an offset along axis 2 from axis 1;
//! the forearm ends at axis 4. The order of the steps is that of IK-Geo for three parallel axes (Elias & Wen 2025).
//!
//! Each property must hold to [`GEOMETRY_TOLERANCE_M`] and
//! [`GEOMETRY_TOLERANCE_RAD`], or up to the rounding of printed numbers (1e-5 rad, 1e-6 m: [`AnalyticArm::rounding`]); anything else is
//! refused with the property and its deviation ([`StructureMismatch`]). The answers for a rounded arm are closed by Gauss–Newton steps on
//! the chain as described, until the pose is met to [`CLOSED`] m and rad; a branch whose steps do not get there counts as out of its
//! limits, as it may near a singularity.
//!
//! Each structure is a `ClosedForm`; what uses an [`AnalyticArm`] does not know which it has.
//!
//! # Equations
//!
//! The *shoulder frame* S stands on axis 1 at the height of axis 2: z along axis 1, y along ± axis 2, x = y × z to
//! the *front*. In it axis 2 passes through (a₁, ·, 0) and the wrist centre always has y = b.
//!
//! 1. Wrist centre `w` of the target, in S at q₁ = 0. Joint 1 (`links`, like step 2):
//!    `Rot_z(q₁) (X, b, Z) = w`, so `Z = w_z` and `X = ±√(w_x² + w_y² − b²)`: front or back.
//! 2. In the plane of the arm, with `p = Z + i (X − a₁)` and `θ` the turn about y:
//!    `p = L₂ e^{i φ₂} + L₃ e^{i (φ₂ + ψ)}`, so `cos ψ = (|p|² − L₂² − L₃²) / (2 L₂ L₃)`, `ψ = ±…`: elbow up or down, and
//!    `e^{i φ₂} ∥ p · conj(L₂ + L₃ e^{i ψ})`. Joints 2 and 3 are φ₂ and ψ less their values at the zero position.
//! 3. What is left for the wrist is a rotation of z–y–z form (`wrist`):
//!    `Kᵀ Rot_y(−θ₂₃) Rot_z(−q₁) R = Rot_z(q₄) Rot_y(q₅ + α₅) Rot_z(q₆ + α₆)`: plain or flipped.
//!
//! With parallel axes 2, 3 and 4, step 3 comes before step 2: `Kᵀ Rot_z(−q₁) R = Rot_z(θ) Rot_y(q₅ + α₅) Rot_z(q₆ + α₆)` has the turn θ of
//! joints 2 to 4 together. The vector `v` from axis 4 to the wrist centre turns by it, so that step 2 has `p − e^{iθ} v` in place of `p`;
//! joint 4 is what joints 2 and 3 leave of θ.
//!
//! Sines and cosines are carried through algebraically; each joint value costs one `atan2`.
//!
//! # Accuracy
//!
//! Every step uses the rounded result of the one before it: an elbow angle that full stretch leaves uncertain
//! by √ε is used as it is for joint 2 and the wrist, and joint 6 is read off after undoing the joint 4
//! that was found. So the pose is met to rounding (about 1e-15 m and rad on an arm of 1 m, or what the description's axes deviate within the
//! tolerances) even where single joints are ill-determined, and no iteration is needed.
//!
//! # Singularities
//!
//! - **Wrist** (`|sin(q₅ + α₅)| ≤` [`FREE_WRIST_RAD`]): joint 4, or the sum of joints 2 to 4 where these axes are parallel, keeps its previous
//!   value and joint 6 takes the rest; where a limit or the elbow's reach forbids that, it moves just as far as it must. Both wrist labels hold
//!   the same answer. Near the singularity that sum is uncertain; where it puts the elbow out of reach by no more than that, the elbow is
//!   stretched or folded.
//! - **Shoulder** (b = 0 and the wrist centre within [`FREE_SHOULDER_M`] of axis 1): joint 1 keeps its previous value;
//!   where limits forbid that, it moves to the next value at which they allow an answer ([`AnalyticArm::nearest`]).
//! - **Stretch, fold, and the column |b| around axis 1**: the two branches meet. A target up to
//!   [`REACH_ROUNDING_M`] beyond is answered by the pose on the border, one further out is refused.
//! - A wrist centre on axis 2 (arms with L₂ = L₃ only): joint 2 keeps its previous value; where limits forbid that, no other
//!   value is tried.
//!
//! # Limits
//!
//! A joint is taken as within its limits up to [`LIMIT_ROUNDING_RAD`] and set onto the limit. Near a singularity a
//! joint may be uncertain by more than that; a branch within [`LIMIT_NEAR_RAD`] is moved onto the limit and the other
//! joints closed by Gauss–Newton, and counts only if the pose is met to [`CLOSED`] m and rad.

mod all;
mod branch;
mod chain;
mod links;
mod nearest;
mod parallel;
mod recognise;
mod side_by_side;
mod spherical;
mod wrist;

pub use crate::ik::analytic::all::{Configurations, Rejection, Solution, Solutions};
pub use crate::ik::analytic::branch::{Branch, Degeneracies, Elbow, Label, OutOfReach, ReachBorder, Shoulder, Wrist};
pub use crate::ik::analytic::nearest::NearestConfiguration;
pub use crate::ik::analytic::recognise::StructureMismatch;

use crate::ik::analytic::chain::Chain;
use crate::ik::analytic::nearest::Window;
use crate::rotation::RigidTransform;
use crate::{AXES, JointLimits, JointVector, LimitViolation};
use std::fmt::Debug;
use std::sync::Arc;

/// Arm whose inverse kinematics has a closed form: see the [module](self) text. Immutable; copies share it.
#[derive(Debug, Clone)]
pub struct AnalyticArm {
    form: Arc<dyn ClosedForm>,
}

/// Branch, and its configuration within the limits or nearly so.
pub(crate) type Candidate = (Branch, Option<JointVector>);

/// Closed form of one structure of arm. Configurations are answers for body 6; `previous` and the window's anchor decide free joints.
pub(crate) trait ClosedForm: Debug + Send + Sync {
    /// Returns the chain as described.
    fn chain(&self) -> &Chain;
    /// Returns words for the structure.
    fn structure(&self) -> &'static str;
    /// See [`AnalyticArm::shoulder_sides_are_alike`].
    fn shoulder_sides_are_alike(&self) -> bool;
    /// Returns all branches in the order of [`Label::ALL`]; limits are not checked.
    fn all_branches(&self, target: &RigidTransform, previous: &JointVector) -> [Result<Branch, OutOfReach>; 8];
    /// Returns all branches, each with its configuration nearest to the start that is within the limits or nearly so.
    fn all_within(&self, target: &RigidTransform, window: &Window<'_>) -> [Result<Candidate, OutOfReach>; 8];
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

/// Largest deviation of a length that must be zero for an arm to be recognised \[m\].
pub const GEOMETRY_TOLERANCE_M: f64 = 1e-10;
/// Largest deviation of an angle that must be 0° or 90° for an arm to be recognised \[rad\].
pub const GEOMETRY_TOLERANCE_RAD: f64 = 5e-10;
/// Shortest upper arm and forearm \[m\].
pub const SHORTEST_LINK_M: f64 = 1e-3;
/// Distance of a target beyond full stretch, full fold or the column around axis 1 up to which it is still answered \[m\].
pub const REACH_ROUNDING_M: f64 = 5e-10;
/// Distance of a wrist centre from axis 1 (or axis 2, if the arm can fold so far) below which the joint is free \[m\].
pub const FREE_SHOULDER_M: f64 = 1e-10;
/// Angle between axes 4 and 6 below which joint 4 is free \[rad\].
pub const FREE_WRIST_RAD: f64 = 1e-10;
/// Distance beyond a limit up to which a joint is set onto it \[rad\].
pub const LIMIT_ROUNDING_RAD: f64 = 1e-11;
/// Distance beyond a limit up to which a branch is moved onto it, if the other joints can make up for it \[rad\].
pub const LIMIT_NEAR_RAD: f64 = 1e-5;
/// Error of the pose up to which those joints must make up for it \[m and rad\].
pub const CLOSED: f64 = 2e-10;
/// Greatest number of whole turns of a continuous joint that are followed, either way.
pub const MOST_TURNS: f64 = 1000.0;

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
