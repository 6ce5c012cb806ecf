//! Rigid-body dynamics of the six-axis arm: M(q) q̈ + C(q, q̇) q̇ + g(q) = τ.
//!
//! The algorithms are those of R. Featherstone, *Rigid Body Dynamics Algorithms* (Springer, 2008), each in a file. Nothing
//! allocates. Not finite in, not finite out; with finite input and a model that was built here nothing is divided by zero,
//! because every body has inertia about its own axis ([`model`] says why that is enough).
//!
//! | concept | file |
//! | --- | --- |
//! | mass, centre and inertia of a body | `body.rs` |
//! | whether a body can exist | `physical.rs` |
//! | the tool as a body | `tool.rs` |
//! | the arm's bodies, joint by joint | `model.rs` |
//! | inverse dynamics, gravity, bias | `rnea.rs` |
//! | axes and inertias in base axes | `pass.rs` |
//! | mass matrix | `crba.rs` |
//! | forward dynamics | `aba.rs` |
//! | torques of a force on the tool | `push.rs` |
//! | kinetic and potential energy | `energy.rs` |
//! | the largest inertia that each joint meets | `largest.rs` |

mod aba;
mod body;
mod crba;
mod energy;
mod largest;
pub mod model;
mod pass;
mod physical;
mod push;
mod rnea;
mod tool;

pub use crba::MassMatrix;
pub use energy::Energy;
pub use largest::spread;
pub use model::{DynamicsError, DynamicsModel, STANDARD_GRAVITY_M_S2};
pub use physical::Unphysical;
pub use push::FrameMotion;
