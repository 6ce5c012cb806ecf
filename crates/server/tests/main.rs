//! The server as its clients meet it: pages, live runs, questions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod questions;
mod server;
mod toy;
mod wire;
