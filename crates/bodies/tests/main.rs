//! Bodies at one moment: distances, contact, coverage, masses; jobs whose bodies can stand.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod clearance;
mod clearance_motion;
mod contact;
mod coverage;
mod coverage_raster;
mod disc_area;
mod fixed_bodies;
mod job;
mod levers;
mod many_parts;
mod parts;
mod plate;
mod plate_load;
mod plates_beside;
mod still_pairs;
mod touching_pairs;
mod uniform;
