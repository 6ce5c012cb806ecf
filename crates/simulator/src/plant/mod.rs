//! The arm as a plant: torques in, motion out.
//!
//! M(q) q̈ + C(q, q̇) q̇ + g(q) = τ + Jᵀ f − d(q̇) q̇, with f the plates' force on the sponge ([`sponge`]) and d the friction
//! (`arm.rs`). Torque limits cut τ.
//!
//! | concept | file |
//! | --- | --- |
//! | the plant; viscous and Coulomb friction; torque limits; one step of semi-implicit Euler; of Runge and Kutta | `arm.rs` |
//! | positions and speeds of the joints | `state.rs` |
//! | foam: pressure and energy of a column | `foam.rs` |
//! | a sponge of it among plates; on a flat face | `sponge.rs`, `level.rs` |
//! | the longest step that is stable on foam | `longest_step.rs` |

mod arm;
pub mod foam;
mod level;
mod longest_step;
pub mod sponge;
mod state;

pub use crate::plant::arm::{Friction, Plant, TorqueLimits};
pub use crate::plant::foam::{Foam, FoamLoad};
pub use crate::plant::longest_step::longest_step_s;
pub use crate::plant::sponge::{ContactSlope, Push, SpongeOnPlates};
pub use crate::plant::state::PlantState;
