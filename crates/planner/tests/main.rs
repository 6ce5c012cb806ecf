//! Plans of jobs, of which some cannot be done, edits of live cells, and the timing of paths.

// Tests compare with tolerances: the last bit of the C library's functions is of no matter.
#![allow(clippy::disallowed_methods)]
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

/// Longest wait for the end of work that was cancelled: a busy machine takes many times as long as an idle one.
const SOON: std::time::Duration = std::time::Duration::from_secs(60);

mod failures;
mod joint_path;
mod knots;
mod live_cell;
mod redundancy;
mod suggest;
mod timing;
mod timing_fixture;
mod transit;

#[path = "../../../tests/support/jobs.rs"]
mod jobs;
#[path = "../../../tests/support/wide.rs"]
mod wide;
