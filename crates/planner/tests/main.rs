//! Plans of jobs, of which some cannot be done, edits of live cells, and the timing of paths.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod failures;
mod knots;
mod live_cell;
mod timing_fixture;

#[path = "../../../tests/support/jobs.rs"]
mod jobs;
