//! The arm as a plant: torques in, motion out.
//!
//! M(q) q̈ + C(q, q̇) q̇ + g(q) = τ + Jᵀ f − d(q̇) q̇, with f the plate's force on the sponge and d the friction
//! ([`friction`]). Torque limits cut τ.
//!
//! | concept | file |
//! | --- | --- |
//! | the plant | `arm.rs` |
//! | state | `state.rs` |
//! | viscous and Coulomb friction | `friction.rs` |
//! | torque limits | `limits.rs` |
//! | one step of semi-implicit Euler; of Runge and Kutta | `euler.rs`, `rk4.rs` |

mod arm;
mod euler;
pub mod friction;
mod limits;
mod rk4;
mod state;

pub use arm::Plant;
pub use friction::Friction;
pub use limits::TorqueLimits;
pub use state::PlantState;
