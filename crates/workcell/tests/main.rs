//! The words of the workcell: surfaces, plates, layouts, wash paths, coverage, plans.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod align;
mod coverage;
mod layout;
mod parts;
mod plan;
mod plate;
mod surface;
mod wash_path;
