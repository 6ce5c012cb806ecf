//! A study out of its file, or out of the folder that keeps its rows.

use crate::error::StudyError;
use crate::kept::{PARTS, read_manifest};
use crate::manifest::Manifest;
use crate::parts::StudyParts;
use crate::study::Study;
use platewash_kinematics::urdf::file::{FileError, read_text};
use std::fs;
use std::path::Path;

/// Longest study file that is read \[bytes\].
const MOST_BYTES: u64 = 16 << 20;

impl Study {
    /// Reads a study file, or the study that a folder keeps: that of its rows, for which no other file is needed.
    ///
    /// # Errors
    /// [`StudyError::File`] with the line and the key; [`StudyError::Disk`] where it cannot be read.
    pub fn load(file: &Path) -> Result<Self, StudyError> {
        if file.is_dir() {
            return of_folder(file);
        }
        let name = file.display().to_string();
        let text = read_text(file, MOST_BYTES).map_err(|error| match error {
            FileError::System { detail, kind, .. } => {
                StudyError::disk(file, "cannot be read")(std::io::Error::new(kind, detail))
            }
            other => StudyError::File {
                file: name.clone(),
                line: None,
                problem: other.to_string(),
            },
        })?;
        Self::parse(&text, &name, file.parent().unwrap_or(Path::new("")))
    }
}

/// The study that a folder keeps, with all that it names.
fn of_folder(folder: &Path) -> Result<Study, StudyError> {
    of_parts(&folder.join(PARTS), &read_manifest(folder)?)
}

/// The study of a file of parts, which the manifest is of.
pub(crate) fn of_parts(file: &Path, manifest: &Manifest) -> Result<Study, StudyError> {
    let text = fs::read_to_string(file).map_err(StudyError::disk(file, "cannot be read"))?;
    let study = StudyParts::from_json(&text).and_then(Study::from_parts);
    let wrong = |problem: String| StudyError::Kept {
        file: file.to_owned(),
        problem,
    };
    let study = study.map_err(|error| wrong(error.to_string()))?;
    match manifest.difference(&Manifest::of(&study)) {
        None => Ok(study),
        Some((what, stated, found)) => Err(wrong(format!(
            "is not the study that the manifest is of: {what} is {stated} there and {found} here"
        ))),
    }
}
