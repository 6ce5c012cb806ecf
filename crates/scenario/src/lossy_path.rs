//! Paths as text: TOML and JSON are UTF-8, the paths of the system need not be.

use serde::ser::{Serialize, Serializer};
use std::path::PathBuf;

/// A path with U+FFFD in place of bytes that are not UTF-8.
pub(crate) fn serialize_lossy<S: Serializer>(path: &Option<PathBuf>, serializer: S) -> Result<S::Ok, S::Error> {
    path.as_ref().map(|p| p.to_string_lossy()).serialize(serializer)
}

/// Several paths, each with U+FFFD in place of bytes that are not UTF-8.
pub(crate) fn lossy_all<S: Serializer>(paths: &[PathBuf], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(paths.iter().map(|p| p.to_string_lossy()))
}
