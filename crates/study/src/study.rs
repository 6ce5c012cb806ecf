//! A study: scenarios × axes, or rows one by one; which values a row has, and which files its rows name.

use crate::axis::{Axis, canonical};
use crate::error::StudyError;
use crate::row::{Outcome, PlanChoice, Row};
use base64::prelude::{BASE64_STANDARD, Engine};
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_kinematics::urdf::HeldFiles;
use platewash_scenario::{Draft, Scenario};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

/// Most rows of a study.
pub const MOST_ROWS: u64 = 10_000_000;

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
