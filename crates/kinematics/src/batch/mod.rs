//! Many configurations at once: forward kinematics, Jacobians and warm inverse kinematics, four to an instruction.
//!
//! | function | for every entry | against one at a time |
//! | --- | --- | --- |
//! | [`fk`], [`fk_into`], [`fk_matrices_into`] | pose of a frame | within 1e-12 |
//! | [`jacobian`], [`jacobian_into`] | geometric Jacobian of a frame | within 1e-12 |
//! | [`solve`], [`solve_into`] | joint positions for a pose, from a near seed | the same branch, both within tolerance |
//!
//! Configurations stand side by side in vectors of four doubles ([`Backend`] says with which instructions). Chunks of
//! fixed size go to rayon's current thread pool. No answer depends on its neighbours, on its place, or on the number
//! of threads; between processors with and without AVX2 the last bits differ, unless [`Backend::Portable`] is asked for.
//!
//! | concept | file |
//! | --- | --- |
//! | the chain folded for speed | `chain.rs` |
//! | poses of four configurations, columns of Jacobians | `forward.rs` |
//! | the two forward batches | `poses.rs` |
//! | pose errors and damped steps of four problems | `step.rs` |
//! | the inverse batch | `inverse.rs` |
//! | lengths of slices, chunks of work | `slices.rs` |

#![allow(clippy::needless_range_loop)] // a lane's or a joint's number indexes several arrays at once

mod chain;
mod forward;
mod inverse;
mod poses;
mod slices;
mod step;

pub use crate::batch::inverse::{solve, solve_into};
pub use crate::batch::poses::{fk, fk_into, fk_matrices_into, jacobian, jacobian_into};
pub use crate::batch::slices::BatchError;
pub use crate::lanes::Backend;
