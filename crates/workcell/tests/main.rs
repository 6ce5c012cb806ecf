//! The world and its words: plates, layouts, wash paths, coverage, contact, distances between bodies, motions, jobs, plans and files.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod align;
mod arc;
mod atomic_file;
mod cancel;
mod clearance;
mod clearance_motion;
mod contact;
mod coverage;
mod coverage_raster;
mod csv;
mod differences;
mod disc_area;
mod fixed_bodies;
mod job;
mod json;
mod layout;
mod levers;
mod many_parts;
mod obstacle;
mod packing;
mod parts;
mod plan;
mod plate;
mod plate_load;
mod plates_beside;
mod random;
mod region;
mod still_pairs;
mod surface;
mod touching_pairs;
mod trajectory;
mod uniform;
mod wash_path;
mod words;
