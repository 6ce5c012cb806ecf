//! Files that a verb reads.

use anyhow::{Error, Result, anyhow};
use platewash::kinematics::urdf::file;
use std::fmt::Display;
use std::path::Path;

/// The text of an input file of at most `limit` bytes.
pub fn text(path: &Path, limit: u64) -> Result<String> {
    file::read_text(path, limit).map_err(|e| refused(path, format_args!("cannot be read: {e}")))
}

/// Something in a file that cannot be used.
pub fn refused(path: &Path, error: impl Display) -> Error {
    anyhow!("{}: {error}", path.display())
}
