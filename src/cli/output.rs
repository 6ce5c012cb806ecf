//! Results: to standard output, and to files that appear whole or not at all.

use super::failure::Failure;
use anyhow::Context;
use serde::Serialize;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Prints to standard output; a reader that has gone away is no error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = std::io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::input(
            anyhow::Error::new(e).context("standard output cannot be written"),
        )),
        _ => Ok(()),
    }
}

/// A value as indented JSON with a final newline. NaN and infinity become `null`.
pub fn json(value: &impl Serialize) -> Result<String, Failure> {
    let mut text = serde_json::to_string_pretty(value).map_err(Failure::internal)?;
    text.push('\n');
    Ok(text)
}

/// Prints a value as JSON, or as text.
pub fn print_either(as_json: bool, value: &impl Serialize, text: impl FnOnce() -> String) -> Result<(), Failure> {
    if as_json { print(&json(value)?) } else { print(&text()) }
}

/// A message on standard error.
pub fn message(quiet: bool, text: &str) {
    if !quiet {
        // Nothing is left to do when standard error is closed.
        let _ = writeln!(std::io::stderr(), "{text}");
    }
}

/// Writes all files or none: each goes to a temporary file beside its place, and they are renamed once all are complete.
pub fn write_files(files: &[(PathBuf, String)]) -> Result<(), Failure> {
    let mut complete = Vec::new();
    for (path, text) in files {
        complete.push((stage(path, text).map_err(Failure::input)?, path));
    }
    for (staged, path) in complete {
        let renamed = staged.persist(path);
        renamed
            .with_context(|| format!("{}: cannot be written", path.display()))
            .map_err(Failure::input)?;
    }
    Ok(())
}

fn stage(path: &Path, text: &str) -> anyhow::Result<NamedTempFile> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    std::fs::create_dir_all(folder).with_context(|| format!("{}: folder cannot be made", folder.display()))?;
    if path.is_dir() {
        anyhow::bail!("{}: cannot be written: it is a folder", path.display());
    }
    let cannot = || format!("{}: cannot be written", path.display());
    let mut staged = tempfile::Builder::new()
        .prefix(".platewash-")
        .tempfile_in(folder)
        .with_context(cannot)?;
    staged.write_all(text.as_bytes()).with_context(cannot)?;
    readable_by_all(&staged).with_context(cannot)?;
    Ok(staged)
}

/// Temporary files are private; results are not.
#[cfg(unix)]
fn readable_by_all(file: &NamedTempFile) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.as_file().set_permissions(std::fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn readable_by_all(_file: &NamedTempFile) -> std::io::Result<()> {
    Ok(())
}
