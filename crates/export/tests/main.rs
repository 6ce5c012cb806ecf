//! Programs for robots: what is written, read back, refused and judged.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod csv;
mod rapid_read;
mod rapid_round_trip;
mod ros2;
mod ros2_refused;
mod urscript;
mod whole_plan;

#[path = "../../../tests/support/programs.rs"]
mod programs;
#[path = "../../../tests/support/rapid.rs"]
mod rapid;
