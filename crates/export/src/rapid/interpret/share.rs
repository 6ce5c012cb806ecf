//! How a program states the share of its speed.

/// The data that state the share of the speed.
pub const SHARE: &str = "pwShare";
