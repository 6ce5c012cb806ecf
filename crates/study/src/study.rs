//! A study: scenarios × axes, or rows one by one; which values a row has, and which files its rows name. It is read from its file, from
//! the folder that keeps its rows, or from the data that was sent.

use crate::axis::{Axis, Values, canonical};
use crate::error::StudyError;
use crate::folder_reader::{PARTS, read_manifest};
use crate::manifest::Manifest;
use crate::row::{Outcome, PlanChoice, Row};
use crate::statement::Source;
use base64::prelude::{BASE64_STANDARD, Engine};
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_kinematics::urdf::file::{FileError, read_text};
use platewash_kinematics::urdf::{Files, HeldFiles};
use platewash_scenario::{Draft, Scenario};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Most rows of a study.
pub const MOST_ROWS: u64 = 10_000_000;
/// Most combinations of files that rows name.
const MOST_COMBINATIONS: u64 = 1000;
/// Longest study file that is read \[bytes\].
const MOST_BYTES: u64 = 16 << 20;

/// A study, checked: its keys are those of scenarios, its values within their ranges, one by one.
#[derive(Debug, Clone)]
pub struct Study {
    /// Name of the study.
    pub name: String,
    /// The file, as it was given.
    pub file: String,
    /// The file's text.
    pub text: String,
    /// Whose plans are kept.
    pub plans: PlanChoice,
    /// The scenarios, the slowest of all axes.
    pub bases: Vec<Base>,
    /// The axes, the last one the fastest; none where rows are listed.
    pub axes: Vec<Axis>,
    /// All files that its rows name, as they were when it was read.
    pub files: Arc<HeldFiles>,
    pub(crate) listed: Vec<BTreeMap<String, Value>>,
    pub(crate) rows: u64,
}

/// A scenario that rows begin from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Base {
    /// Its name in the study: a shipped name, a file relative to the study's, or the name beside a text.
    pub name: String,
    /// Its text.
    pub text: String,
    /// The folder to which paths in it are relative.
    pub folder: Option<PathBuf>,
}

/// A row before anything is done about it.
#[derive(Debug, Clone, PartialEq)]
pub struct RowAddress {
    /// Place of its scenario among those of the study.
    pub base: usize,
    /// The values of the axes.
    pub axes: BTreeMap<String, Value>,
    /// Its key, as in [`Row`](crate::Row).
    pub key: String,
}

impl RowAddress {
    /// Address of the row with these values; `name` is that of its scenario.
    pub(crate) fn new(base: usize, name: &str, axes: BTreeMap<String, Value>) -> Self {
        let values: Vec<_> = axes.iter().map(|(key, v)| format!("{key}={}", canonical(v))).collect();
        let words = format!("{name}\n{}", values.join("\n"));
        let key = sha256_hex(words.as_bytes())[..16].to_owned();
        Self { base, axes, key }
    }
}

/// A study as data, for a reader without its files.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyParts {
    /// The file, as it was given.
    pub file: String,
    /// Its text.
    pub text: String,
    /// The scenarios.
    pub bases: Vec<Base>,
    /// The files that they name.
    pub files: Vec<PartsFile>,
}

/// A file of a study, as data.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PartsFile {
    /// Name under which it was read.
    pub path: PathBuf,
    /// Contents of the file.
    pub base64: String,
}

impl Base {
    /// Its text with other values.
    pub(crate) fn changed<'a>(
        &self,
        values: impl IntoIterator<Item = (&'a String, &'a Value)>,
    ) -> Result<String, String> {
        let mut draft = Draft::new(&self.text).map_err(|error| error.to_string())?;
        for (key, value) in values {
            draft.set(key, Some(value)).map_err(|error| error.to_string())?;
        }
        Ok(draft.text().to_owned())
    }

    /// Its scenario with other values. Files that it names are not read.
    pub(crate) fn scenario(&self, values: &BTreeMap<String, Value>) -> Result<Scenario, String> {
        let draft = Draft::new(&self.changed(values)?);
        let scenario = draft.and_then(|draft| draft.scenario(&self.name, self.folder.as_deref()));
        scenario.map_err(|error| error.to_string())
    }
}

impl StudyParts {
    /// As JSON.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Texts alone: there is nothing that JSON cannot say.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// Out of JSON.
    ///
    /// # Errors
    /// [`StudyError::Sent`].
    pub fn from_json(text: &str) -> Result<Self, StudyError> {
        serde_json::from_str(text).map_err(|error| StudyError::sent(&error))
    }
}

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
        match manifest.difference(&Manifest::of(&study)) {
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

    /// All of it, for a reader without its files.
    #[must_use]
    pub fn parts(&self) -> StudyParts {
        let file = |(path, bytes): (&PathBuf, &Arc<[u8]>)| PartsFile {
            path: path.clone(),
            base64: BASE64_STANDARD.encode(bytes),
        };
        StudyParts {
            file: self.file.clone(),
            text: self.text.clone(),
            bases: self.bases.clone(),
            files: self.files.iter().map(file).collect(),
        }
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

    /// Number of rows that its scenarios, axes and listed rows make; `None` where it overflows.
    pub(crate) fn row_count(&self) -> Option<u64> {
        let counts = [self.bases.len() as u64, self.listed.len().max(1) as u64];
        let counts = counts.into_iter().chain(self.axes.iter().map(Axis::count));
        counts.into_iter().try_fold(1, u64::checked_mul)
    }

    /// Number of rows.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The values of a row.
    ///
    /// # Errors
    /// [`StudyError::NoRow`].
    pub fn row(&self, index: u64) -> Result<RowAddress, StudyError> {
        if index >= self.rows {
            return Err(StudyError::NoRow { index, rows: self.rows });
        }
        let (mut rest, mut axes) = (index, BTreeMap::new());
        for axis in self.axes.iter().rev() {
            axes.extend(axis.value(rest % axis.count()).map(|value| (axis.key.clone(), value)));
            rest /= axis.count();
        }
        if !self.listed.is_empty() {
            let count = self.listed.len() as u64;
            axes.clone_from(&self.listed[(rest % count) as usize]);
            rest /= count;
        }
        let base = rest as usize;
        Ok(RowAddress::new(base, &self.bases[base].name, axes))
    }

    /// A row that is not worked on, with why.
    ///
    /// # Errors
    /// [`StudyError::NoRow`].
    pub fn ended(&self, index: u64, outcome: Outcome, reason: &str) -> Result<Row, StudyError> {
        let address = self.row(index)?;
        let name = self.bases[address.base].name.clone();
        Ok(Row::new(index, address.key, name, address.axes).ended(outcome, reason.to_owned()))
    }

    /// A row that another process made, by its [line](Row::line).
    ///
    /// # Errors
    /// [`StudyError::Sent`]: it is no row of this study.
    pub fn parse_row(&self, line: &[u8]) -> Result<Row, StudyError> {
        let row: Row = serde_json::from_slice(line).map_err(|error| StudyError::sent(&error))?;
        if !self.row(row.index).is_ok_and(|address| address.key == row.key) {
            let problem = format!("row {} with key {} is none of this study", row.index, row.key);
            return Err(StudyError::sent(&problem));
        }
        Ok(row)
    }

    /// The text of a row's scenario: that of its base, all but the axes as it stands there.
    ///
    /// # Errors
    /// [`StudyError::NoRow`]; [`StudyError::Row`] where the values do not go together.
    pub fn scenario_text(&self, index: u64) -> Result<String, StudyError> {
        let row = self.row(index)?;
        let text = self.bases[row.base].changed(&row.axes);
        text.map_err(|problem| StudyError::Row { index, problem })
    }
}
