//! Suggestions for an arm without a layout, held against planning.

mod home;
mod region;
mod sector;
