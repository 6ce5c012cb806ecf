//! Programs for robots: what is written, read back, refused and judged.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod csv;
mod dialect;
mod judgement;
mod maker_joints;
mod rapid_accepts;
mod rapid_read;
mod rapid_round_trip;
mod ros2;
mod ros2_refused;
mod urscript;
mod whole_plan;

#[path = "../../../tests/support/linkage.rs"]
mod linkage;
#[path = "../../../tests/support/programs.rs"]
mod programs;
#[path = "../../../tests/support/rapid.rs"]
mod rapid;
