//! The arm as a physical system: rigid-body dynamics, a plant, control laws, and the execution of a planned wash under them.
//!
//! Conventions (units, frames, joint order) are those of [`platewash_kinematics`]. Torques are in N·m, positive along the
//! joint's axis, and act on the link behind the joint.
//!
//! | concept | module |
//! | --- | --- |
//! | M(q) q̈ + C(q, q̇) q̇ + g(q) = τ | [`dynamics`] |
//! | the arm as torques move it | [`plant`] |
//! | laws behind one trait | [`control`] |
//! | a plan under a law, and the report of it | [`simulate`](mod@simulate) |

pub mod control;
pub mod dynamics;
pub mod plant;
pub mod simulate;

pub use crate::control::{Command, ControlError, ControlLaw, Gains};
pub use crate::dynamics::{DynamicsError, DynamicsModel, Energy};
pub use crate::plant::{Plant, PlantState};
pub use crate::simulate::{
    Execution, SimulationError, SimulationReport, SimulationVerdict, simulate, simulate_watched, simulate_with, tune,
};
