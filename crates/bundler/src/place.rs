//! Folders of the repository.

use std::path::{Path, PathBuf};

/// The repository.
pub fn root() -> PathBuf {
    // Cargo says where the package lies that it runs; the other is where this one was when it was built.
    let package = std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let mut folders = package.iter().flat_map(|package| package.ancestors());
    let found = folders.find(|folder| folder.join("crates/bundler/Cargo.toml").is_file());
    found.map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."),
        Path::to_path_buf,
    )
}

/// Folder in which cargo builds; it also holds the virtual environment of the Python tests.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}
