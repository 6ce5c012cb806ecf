//! Rigid-body dynamics of the six-axis arm: M(q) q̈ + C(q, q̇) q̇ + g(q) = τ.
//!
//! The algorithms are those of R. Featherstone, *Rigid Body Dynamics Algorithms* (Springer, 2008), each in a file. Nothing
//! allocates. Not finite in, not finite out; with finite input and a model that was built here nothing is divided by zero,
//! because every body has inertia about its own axis ([`model`] says why that is enough).
//!
//! | concept | file |
//! | --- | --- |
//! | mass, centre and inertia of a body; whether a body can exist; the tool as a body | `body.rs` |
//! | the arm's bodies, joint by joint; axes and inertias in base axes | `model.rs` |
//! | inverse dynamics, gravity, bias | `rnea.rs` |
//! | mass matrix; kinetic and potential energy; the largest inertia that each joint meets | `mass_matrix.rs` |
//! | forward dynamics; torques of a force on the tool | `aba.rs` |

mod aba;
mod body;
pub(crate) mod mass_matrix;
pub mod model;
mod rnea;

pub use crate::dynamics::aba::FrameMotion;
pub use crate::dynamics::body::MassPropertiesError;
pub use crate::dynamics::mass_matrix::{Energy, MassMatrix, spread};
pub use crate::dynamics::model::{DynamicsError, DynamicsModel, STANDARD_GRAVITY_M_S2};
