//! Files that are there whole or not at all.

use crate::error::StudyError;
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;

/// Writes a file that is there whole or not at all.
pub(crate) fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), StudyError> {
    let staged = path.with_extension("new");
    let written = File::create(&staged).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    written.map_err(StudyError::disk(&staged, "cannot be written"))?;
    fs::rename(&staged, path).map_err(StudyError::disk(path, "cannot be written"))
}
