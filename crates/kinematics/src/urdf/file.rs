//! Input files: regular ones only (a pipe or device may never end), read up to a limit even if their stated length is smaller.

use std::fs::{File, metadata};
use std::io::Read;
use std::path::Path;

/// Reason that an input file was not read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// The file does not exist, or the system refuses it.
    #[error("{detail}")]
    System {
        /// Message of the system.
        detail: String,
        /// Kind of the system's error.
        kind: std::io::ErrorKind,
        /// Number of the system's error, if it has one.
        code: Option<i32>,
    },
    /// The path is a folder, pipe, socket or device.
    #[error("not a regular file, but a folder, pipe, socket or device")]
    NotRegular,
    /// The host has no files.
    #[error("a page in a browser reads no files; platewash on your computer does")]
    NoFiles,
    /// The file is too long.
    #[error("longer than {limit} bytes, the most that are read")]
    TooLong {
        /// Greatest length \[bytes\].
        limit: u64,
    },
    /// The file is not UTF-8 text.
    #[error("line {line}: not UTF-8 text (byte {position} of the file); save it in UTF-8")]
    NotText {
        /// Offset of the first invalid byte.
        position: usize,
        /// Its line, from 1.
        line: usize,
    },
}

/// Reads the bytes of a regular file of at most `limit` bytes.
///
/// # Errors
/// [`FileError`], without the file's name.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, FileError> {
    // Looked at before it is opened: opening a pipe waits for its writer.
    if !metadata(path).map_err(|e| system(&e))?.is_file() {
        return Err(FileError::NotRegular);
    }
    let file = File::open(path).map_err(|e| system(&e))?;
    let mut bytes = Vec::new();
    file.take(limit.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|e| system(&e))?;
    if bytes.len() as u64 > limit {
        return Err(FileError::TooLong { limit });
    }
    Ok(bytes)
}

/// Reads the text of a regular file of at most `limit` bytes.
///
/// # Errors
/// [`FileError`], without the file's name.
pub fn read_text(path: &Path, limit: u64) -> Result<String, FileError> {
    text(read_bytes(path, limit)?)
}

/// Converts bytes to text.
pub(crate) fn text(bytes: Vec<u8>) -> Result<String, FileError> {
    String::from_utf8(bytes).map_err(|e| {
        let position = e.utf8_error().valid_up_to();
        let before = e.as_bytes().iter().take(position);
        FileError::NotText {
            position,
            line: 1 + before.filter(|byte| **byte == b'\n').count(),
        }
    })
}

fn system(error: &std::io::Error) -> FileError {
    FileError::System {
        detail: error.to_string(),
        kind: error.kind(),
        code: error.raw_os_error(),
    }
}
