//! The text of a scenario: of a file, or of one that comes with the program.

use crate::error::{Problem, ScenarioError};
use crate::keys::likeness::nearest;
use platewash_kinematics::urdf::file::{self, FileError};
use platewash_scenarios::SHIPPED;
use std::path::{Path, PathBuf};

/// Longest text that is read \[bytes\].
pub(crate) const MAX_BYTES: u64 = 1 << 20;

/// A scenario's text, and where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ScenarioSource {
    /// Name that it was asked for by: a shipped name, or the file as it was given.
    pub name: String,
    /// Its TOML text, as it stands there; not checked.
    pub text: String,
    /// The file; `None` for one that comes with the program.
    pub file: Option<PathBuf>,
    /// The folder to which paths in the text are relative: that of the file.
    pub folder: Option<PathBuf>,
}

/// The text of a scenario: a shipped name (`paper-appendix`), or a file.
///
/// # Errors
/// [`ScenarioError`]: neither of them, no regular file, longer than 1 MiB, or no UTF-8.
pub fn source(name_or_file: &str) -> Result<ScenarioSource, ScenarioError> {
    if let Some(shipped) = SHIPPED.iter().find(|s| s.name == name_or_file) {
        return Ok(ScenarioSource {
            name: shipped.name.to_owned(),
            text: shipped.text.to_owned(),
            file: None,
            folder: None,
        });
    }
    let fail = |problem| ScenarioError::new(name_or_file, None, problem);
    let path = Path::new(name_or_file);
    if !path.exists() {
        let shipped: Vec<_> = SHIPPED.iter().map(|s| s.name).collect();
        let name = name_or_file.strip_suffix(".toml").unwrap_or(name_or_file);
        let nearest = nearest(name, shipped.iter().copied()).map(str::to_owned);
        let shipped = shipped.join(", ");
        return Err(fail(Problem::NotFound { nearest, shipped }));
    }
    let text = file::read_text(path, MAX_BYTES).map_err(|e| fail(unread(e)))?;
    Ok(ScenarioSource {
        name: name_or_file.to_owned(),
        text,
        file: Some(path.to_owned()),
        folder: Some(path.parent().unwrap_or(Path::new("")).to_owned()),
    })
}

pub(crate) fn unread(error: FileError) -> Problem {
    match error {
        FileError::TooLong { limit } => Problem::TooLarge { limit },
        other => Problem::Unreadable {
            detail: other.to_string(),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_regular_files_of_sensible_length_are_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long.toml");
        std::fs::write(&path, " ".repeat(MAX_BYTES as usize + 1)).unwrap();
        let problem = |path: &Path| source(&path.to_string_lossy()).unwrap_err().problem;
        assert_eq!(problem(&path), Problem::TooLarge { limit: MAX_BYTES });
        assert!(problem(folder.path()).to_string().contains("not a regular file"));
        assert!(matches!(
            problem(&folder.path().join("none.toml")),
            Problem::NotFound { .. }
        ));
        std::fs::write(&path, b"name = \"\xff\"").unwrap();
        assert!(problem(&path).to_string().contains("UTF-8"));
    }
}
