//! The arm as a plant: torques in, motion out.
//!
//! M(q) q̈ + C(q, q̇) q̇ + g(q) = τ + Jᵀ f − d(q̇) q̇, with f the plates' force on the sponge ([`sponge`]) and d the friction
//! ([`friction`]). Torque limits cut τ.
//!
//! | concept | file |
//! | --- | --- |
//! | the plant | `arm.rs` |
//! | state | `state.rs` |
//! | viscous and Coulomb friction | `friction.rs` |
//! | torque limits | `limits.rs` |
//! | foam: pressure and energy of a column | `foam.rs` |
//! | a sponge of it among plates; on a flat face | `sponge.rs`, `level.rs` |
//! | the longest step that is stable on it | `longest_step.rs` |
//! | one step of semi-implicit Euler; of Runge and Kutta | `euler.rs`, `rk4.rs` |

mod arm;
mod euler;
mod felt;
pub mod foam;
pub mod friction;
mod level;
mod limits;
mod longest_step;
mod rk4;
pub mod sponge;
mod state;

pub use arm::Plant;
pub use felt::Felt;
pub use foam::Foam;
pub use friction::Friction;
pub use limits::TorqueLimits;
pub use longest_step::longest_step_s;
pub use sponge::{ContactSlope, Push, SpongeOnPlates};
pub use state::PlantState;
