//! Documents of the page, and the server that answers it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, missing_docs)]

mod questions;
mod server;
mod view;

#[path = "../../../tests/support/toy.rs"]
mod toy;
#[path = "../../../tests/support/wire.rs"]
mod wire;
