//! Trajectories of planners: files and messages that are read, points that are no motion, motions that are judged.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod trajectory;
mod trajectory_fields;
mod trajectory_messages;
