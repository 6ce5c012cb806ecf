//! Dynamics, control laws and executed plans, also beside other implementations.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod against_others;
mod closed_loop;
mod dynamics_laws;
mod dynamics_refused;
mod feasibility;
mod foam;
mod foam_law;
mod plant;
mod pressing;
mod stability;
mod washing;

#[path = "../../../tests/support/dynamics.rs"]
mod dynamics;
#[path = "../../../tests/support/two_plates.rs"]
mod two_plates;
