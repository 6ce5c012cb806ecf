//! Scenario files: what is read, what is refused, and what an edit changes.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod draft;
mod draft_properties;
mod measured;
mod obstacles;
mod plate_files;
mod plates;
mod tool_meshes;

#[path = "../../../tests/support/texts.rs"]
mod texts;
