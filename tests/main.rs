//! The project as a Rust user meets it: real jobs are planned, proved, executed and exported, and the certificate is attacked.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::print_stderr,
    missing_docs
)]

mod align;
mod cells;
mod certified;
mod dry_run;
mod facade;
mod faces;
mod knots;
mod looser_limits;
mod mutation;
mod page_types;
mod plan_kinds;
mod plate_files;
mod programs;
mod proved_only;
mod random_jobs;
mod random_scenarios;
mod reachable_points;
mod recovery;
mod shipped;
mod simulation;
mod spiral_knots;
mod stays;
mod transit_gain;
mod turned_tool;
mod turned_world;
