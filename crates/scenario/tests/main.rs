//! Scenario files: what is read, what is refused, and what an edit changes.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod certified_keys;
mod contact;
mod draft;
mod draft_properties;
mod holder;
mod jobs;
mod loading;
mod measured;
mod measured_matrix;
mod mount_link;
mod notes;
mod obstacle_files;
mod obstacles;
mod plant;
mod plate_files;
mod plate_sections;
mod plates;
mod reference;
mod tool_bodies;
mod tool_meshes;

#[path = "../../../tests/support/texts.rs"]
mod texts;
