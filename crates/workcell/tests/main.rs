//! The words of the workcell: surfaces, plates, layouts, wash paths, coverage, plans.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod align;
mod coverage;
mod layout;
mod parts;
mod plan;
mod plate;
mod surface;
mod wash_path;
