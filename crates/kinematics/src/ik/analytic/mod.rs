//! Analytic inverse kinematics: all branches of an arm in closed form, for two structures of arms.
//!
//! | concept | file |
//! | --- | --- |
//! | the arm with its closed form; how its structure is recognised, by its geometry | `arm`; `recognise`, `geometry`, `mismatch` |
//! | the contract of a closed form; the two that there are | `closed_form`; `spherical`, `parallel` |
//! | names of branches, and a value for each; four at a time | `branch`, `branches`; `branch_lanes` |
//! | parts of both forms: joint 1 and a triangle; three turns; Newton steps | `links`; `wrist`; `chain` |
//! | answers within the limits: all, and the nearest | `all`; `nearest`, `search`, `window` |
//! | tolerances; errors | `tolerances`; `error` |
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
//! Each structure is a `ClosedForm`; what uses an [`AnalyticArm`] does not know which it has, nor how many branches.
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
mod arm;
mod branch;
mod branch_lanes;
mod branches;
mod chain;
mod closed_form;
mod error;
mod geometry;
mod links;
mod mismatch;
mod nearest;
mod parallel;
mod recognise;
mod search;
mod spherical;
mod tolerances;
mod window;
mod wrist;

pub use crate::ik::analytic::all::{Configurations, Rejection, Solution, Solutions};
pub use crate::ik::analytic::arm::AnalyticArm;
pub use crate::ik::analytic::branch::{Branch, Degeneracies, Elbow, Label, OutOfReach, ReachBorder, Shoulder, Wrist};
pub use crate::ik::analytic::branches::Branches;
pub use crate::ik::analytic::error::AnalyticError;
pub use crate::ik::analytic::mismatch::StructureMismatch;
pub use crate::ik::analytic::tolerances::{
    CLOSED, FREE_SHOULDER_M, FREE_WRIST_RAD, GEOMETRY_TOLERANCE_M, GEOMETRY_TOLERANCE_RAD, LIMIT_NEAR_RAD,
    LIMIT_ROUNDING_RAD, MOST_TURNS, REACH_ROUNDING_M, SHORTEST_LINK_M,
};
pub use crate::ik::analytic::window::NearestConfiguration;
