//! The world and its words: layouts, surfaces, wash paths, obstacles and files.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod arc;
mod atomic_file;
mod cancel;
mod json;
mod layout;
mod obstacle;
mod packing;
mod random;
mod region;
mod surface;
mod wash_path;
mod words;
