//! Paths as text: TOML and JSON are UTF-8, the system's paths need not be.

use serde::ser::{Serialize, Serializer};
use std::path::PathBuf;

/// A path with U+FFFD in place of what is not UTF-8.
pub(super) fn lossy<S: Serializer>(path: &Option<PathBuf>, serializer: S) -> Result<S::Ok, S::Error> {
    path.as_ref().map(|p| p.to_string_lossy()).serialize(serializer)
}

/// The same for several paths.
pub(super) fn lossy_all<S: Serializer>(paths: &[PathBuf], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(paths.iter().map(|p| p.to_string_lossy()))
}
