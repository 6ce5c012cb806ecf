//! Motions: trajectories, plan files, tables, differences of jobs.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod csv;
mod differences;
mod plan;
mod trajectory;
