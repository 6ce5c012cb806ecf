//! Studies: their rows and folders, also after a process is killed.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod kept;
mod kill;
mod rows;
mod self_contained;
