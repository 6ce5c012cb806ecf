//! A study read from its file, from the folder that keeps its rows, or from data that was sent.

use crate::axis::{Values, canonical};
use crate::error::StudyError;
use crate::folder_reader::{PARTS, read_manifest};
use crate::manifest::Manifest;
use crate::study::{PartsFile, Study, StudyParts};
use crate::study_file::Source;
use base64::prelude::{BASE64_STANDARD, Engine};
use platewash_kinematics::urdf::file::{FileError, read_text};
use platewash_kinematics::urdf::{Files, HeldFiles};
use platewash_scenario::Draft;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// Most combinations of files that rows name.
const MOST_COMBINATIONS: u64 = 1000;
/// Longest study file that is read \[bytes\].
const MOST_BYTES: u64 = 16 << 20;

impl Study {
    /// Reads a study file, or the study that a folder keeps: that of its rows, for which no other file is needed.
    ///
    /// # Errors
    /// [`StudyError::File`] with the line and the key; [`StudyError::Disk`] where it cannot be read.
    pub fn load(file: &Path) -> Result<Self, StudyError> {
        if file.is_dir() {
            return Self::of_folder(file);
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

    /// The study that a folder keeps, with all that it names.
    fn of_folder(folder: &Path) -> Result<Self, StudyError> {
        let manifest = read_manifest(folder)?;
        let file = folder.join(PARTS);
        let text = fs::read_to_string(&file).map_err(StudyError::disk(&file, "cannot be read"))?;
        let study = StudyParts::from_json(&text).and_then(Self::from_parts);
        let study = study.map_err(|error| StudyError::damaged_file(&file, None, error.to_string()))?;
        match manifest.difference(&Manifest::new(&study)) {
            None => Ok(study),
            Some((what, stated, found)) => Err(StudyError::damaged_file(
                &file,
                None,
                format!("is not the study that the manifest is of: {what} is {stated} there and {found} here"),
            )),
        }
    }

    /// A study out of a text; files of scenarios are relative to the folder.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn parse(text: &str, file: &str, folder: &Path) -> Result<Self, StudyError> {
        let from = Source { file, text };
        let stated = from.statement()?;
        let bases = from.bases(&stated.scenario, folder)?;
        let mut study = from.study(stated, bases)?;
        study.files = Arc::new(study.named_files(&from)?);
        Ok(study)
    }

    /// A study from its parts: the one that they were taken of.
    ///
    /// # Errors
    /// As [`Study::load`], for parts of no study.
    pub fn from_parts(parts: StudyParts) -> Result<Self, StudyError> {
        let from = Source {
            file: &parts.file,
            text: &parts.text,
        };
        let mut study = from.study(from.statement()?, parts.bases)?;
        let bytes = |file: PartsFile| Ok((file.path, BASE64_STANDARD.decode(&file.base64)?.into()));
        let files: Result<_, base64::DecodeError> = parts.files.into_iter().map(bytes).collect();
        study.files = Arc::new(files.map_err(|error| StudyError::sent(&error))?);
        Ok(study)
    }

    /// Reads all files that rows name. Each combination of values of keys that are paths is checked once, with the first values
    /// of all others.
    ///
    /// # Errors
    /// The first file that is there and cannot be read, or is named and is not there, and the reason; or too many combinations.
    fn named_files(&self, from: &Source<'_>) -> Result<HeldFiles, StudyError> {
        let mut few = self.clone();
        for axis in few.axes.iter_mut().filter(|axis| !Draft::names_files(&axis.key)) {
            axis.values = Values::Listed(axis.value(0).into_iter().collect());
        }
        let mut seen = BTreeSet::new();
        few.listed.retain(|row| {
            let named = row.iter().filter(|(key, _)| Draft::names_files(key));
            seen.insert(named.map(|(_, value)| canonical(value)).collect::<Vec<_>>())
        });
        few.rows = few.row_count().unwrap_or(u64::MAX);
        if few.rows / few.bases.len() as u64 > MOST_COMBINATIONS {
            let problem =
                format!("rows name more than {MOST_COMBINATIONS} combinations of files, which are read beforehand");
            return Err(from.error_at(None, &problem));
        }
        let files = Files::recording();
        for index in 0..few.rows {
            let row = few.row(index)?;
            // Values that do not go together are an outcome of their rows.
            if let Ok(mut scenario) = few.bases[row.base].scenario(&row.axes) {
                scenario.files = files.clone();
                scenario.read_files();
            }
        }
        files.recorded().map_err(|(path, why)| {
            let problem = format!("{}, which it names, cannot be read: {why}", path.display());
            from.error_at(None, &problem)
        })
    }
}
