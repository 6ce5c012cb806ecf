//! The arm as a plant: torques in, motion out.
//!
//! M(q) q̈ + C(q, q̇) q̇ + g(q) = τ + Jᵀ f − d(q̇) q̇, with f the plates' force on the sponge ([`sponge`]) and d the friction
//! (`arm.rs`). Torque limits cut τ.
//!
//! | concept | file |
//! | --- | --- |
//! | the plant; state; viscous and Coulomb friction; torque limits; one step of semi-implicit Euler; of Runge and Kutta | `arm.rs` |
//! | foam: pressure and energy of a column; the longest step that is stable on it | `foam.rs` |
//! | a sponge of it among plates; on a flat face | `sponge.rs`, `level.rs` |

mod arm;
pub mod foam;
mod level;
pub mod sponge;

pub use crate::plant::arm::{Friction, Plant, PlantState, TorqueLimits};
pub use crate::plant::foam::{Foam, FoamLoad, longest_step_s};
pub use crate::plant::sponge::{ContactSlope, Push, SpongeOnPlates};
