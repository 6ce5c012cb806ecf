//! Finds the Python interpreter.

use std::path::{Path, PathBuf};

/// The Python program on the PATH, or the one that the variable PYTHON names.
pub fn program() -> String {
    // On Windows, `python3` may be a stub that opens a shop.
    let usual = if cfg!(windows) { "python" } else { "python3" };
    std::env::var("PYTHON").unwrap_or_else(|_| usual.to_owned())
}

/// The interpreter in the folder of a virtual environment.
pub fn interpreter(folder: &Path) -> PathBuf {
    if cfg!(windows) {
        folder.join("Scripts").join("python.exe")
    } else {
        folder.join("bin").join("python")
    }
}
