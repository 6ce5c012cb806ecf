//! Studies: their rows and folders, also after a process is killed.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod kept;
mod kill;
mod rows;
mod self_contained;
mod summary;
