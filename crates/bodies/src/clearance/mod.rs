//! Smallest distances between the arm, its tool, the obstacles and the plates.
//!
//! The collision library (parry) appears in this folder only; its types do not leave it.
//!
//! # Accuracy
//!
//! Distances between spheres and over the floor are closed forms, right to rounding (`distance.rs` derives its bound, and what is allowed for). The others are proposed by a routine of
//! their own (for capsules a closed form too, for solids GJK) and held between two bounds, the gap along a direction and the distance of two
//! points, no more than [`ITERATIVE_ERROR_M`] apart; what is proved uses the lower one. Tests hold them against closed forms,
//! another method and an independent library. Yes-or-no questions of the planner ([`ClearanceModel::keeps_clearance`]) take the proposal,
//! which may be too great by some hundredths of a millimetre. Bodies that overlap have a distance ≤ 0; how far they overlap is only
//! a lower bound of the penetration depth.
//!
//! | concept | file |
//! | --- | --- |
//! | bodies of arm, tool, obstacles, plates | `body.rs` |
//! | a convex part of a body; convex hulls and their facets | `part.rs`; `convex.rs` |
//! | a body of many parts, from the outside in | `tree.rs` |
//! | which pairs are checked, and why the others are not; links that touch, as an SRDF | `pairs.rs` |
//! | the distance of two parts: quickly, and between bounds; how deep they overlap | `distance.rs`; `overlap.rs` |
//! | pairs whose distance no joint changes, judged once | `still.rs` |
//! | the distance of a pair and what is required of it | `pair_clearance.rs` |
//! | all pairs at one configuration | `model.rs` |
//! | a quick yes or no for planners | `washing.rs` |
//! | the convex parts of a mesh | `solid.rs` |
//! | how far those reach beyond the mesh | `excess.rs` |
//! | two plates; obstacles that reach into plates or the base | `fixed_bodies.rs` |
//! | bounds between configurations; of many obstacles at once; those that are near | `part_pair.rs`, `lever.rs`; `far.rs`; `crowd.rs` |

mod body;
mod convex;
mod crowd;
mod distance;
mod error;
mod excess;
pub mod far;
mod fixed_bodies;
pub mod lever;
mod model;
mod overlap;
mod pair_clearance;
mod pairs;
mod part;
pub mod part_pair;
mod solid;
mod still;
#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;
mod tree;
mod washing;

pub use crate::clearance::convex::{TriangleMesh, hull_triangles};
pub use crate::clearance::error::ClearanceError;
pub use crate::clearance::excess::excess_m;
pub use crate::clearance::fixed_bodies::{FixedBody, FixedOverlap, gap_of_plates, standing_overlaps};
pub use crate::clearance::model::{ClearanceModel, NearestBodies};
pub use crate::clearance::pair_clearance::{PairClearance, is_clear};
pub use crate::clearance::pairs::{TouchingPairs, exclusions};
pub use crate::clearance::solid::{SolidError, SolidParts, solid_parts};
pub use crate::clearance::still::{StillPair, still_pairs};

/// Greatest gap between the bounds of a stated distance between solids \[m\].
pub const ITERATIVE_ERROR_M: f64 = distance::ERROR_M;
