//! Manifest of the study in a folder: enough to tell it from every other.

use crate::axis::AxisKind;
use crate::error::StudyError;
use crate::lines::write_whole;
use crate::row::ROW_SCHEMA;
use crate::study::{Base, Study};
use platewash_kinematics::fingerprint::sha256_hex;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// The manifest's name.
pub(crate) const MANIFEST: &str = "manifest.json";
/// Value of `format`.
pub(crate) const FORMAT: &str = "platewash-study-manifest/1";

/// A study that is kept: `manifest.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// `platewash-study-manifest/1`.
    pub format: String,
    /// The study's name.
    pub name: String,
    /// The version of the program that makes its rows.
    pub version: String,
    /// The version of its rows.
    pub row_schema: u32,
    /// Number of rows when it is finished.
    pub rows: u64,
    /// SHA-256 of the study file.
    pub study_sha256: String,
    /// Its scenarios.
    pub scenarios: Vec<ManifestScenario>,
    /// Its axes.
    pub axes: Vec<ManifestAxis>,
    /// The files that its rows name: descriptions of arms, meshes.
    pub files: Vec<ManifestFile>,
    /// The study file as it was given, for commands that reproduce a row; it does not count when studies are compared.
    pub file: String,
    /// SHA-256 of all rows, as they are exported: there as soon as the study is finished.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rows_sha256: Option<String>,
}

/// A scenario of a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestScenario {
    /// Its name in the study.
    pub name: String,
    /// SHA-256 of its text.
    pub sha256: String,
}

/// A file that rows name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestFile {
    /// Its path, from the study file's folder where it lies below it.
    pub path: String,
    /// SHA-256 of its contents.
    pub sha256: String,
}

/// An axis of a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestAxis {
    /// The scenario's key.
    pub key: String,
    /// Number of values.
    pub count: u64,
    /// Common kind of its values.
    pub kind: AxisKind,
}

impl Manifest {
    /// The manifest of a study without any row.
    #[must_use]
    pub fn new(study: &Study) -> Self {
        let scenario = |base: &Base| ManifestScenario {
            name: base.name.clone(),
            sha256: sha256_hex(base.text.as_bytes()),
        };
        // The same however the study file is called: from another working folder, or by its whole path.
        let folder = Path::new(&study.file).parent().unwrap_or(Path::new(""));
        let file = |(path, bytes): (&PathBuf, &Arc<[u8]>)| ManifestFile {
            path: path.strip_prefix(folder).unwrap_or(path).display().to_string(),
            sha256: sha256_hex(bytes),
        };
        let listed = study.listed.first().into_iter().flat_map(|row| row.keys());
        let listed = listed.map(|key| ManifestAxis {
            key: key.clone(),
            count: study.listed.len() as u64,
            kind: AxisKind::of_all(study.listed.iter().filter_map(|row| row.get(key))),
        });
        let axes = study.axes.iter().map(|axis| ManifestAxis {
            key: axis.key.clone(),
            count: axis.count(),
            kind: axis.kind(),
        });
        Self {
            format: FORMAT.to_owned(),
            name: study.name.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            row_schema: ROW_SCHEMA,
            rows: study.rows(),
            study_sha256: sha256_hex(study.text.as_bytes()),
            scenarios: study.bases.iter().map(scenario).collect(),
            axes: axes.chain(listed).collect(),
            files: study.files.iter().map(file).collect(),
            file: study.file.clone(),
            rows_sha256: None,
        }
    }

    /// Writes it to a folder, whole.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), StudyError> {
        let path = folder.join(MANIFEST);
        let text = serde_json::to_string_pretty(self)
            .map_err(|error| StudyError::damaged_file(&path, None, error.to_string()))?;
        write_whole(&path, format!("{text}\n").as_bytes())
    }

    /// Returns the first fact in which two studies differ, with the value of each: of lists, the entries that the other one
    /// lacks.
    pub(crate) fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let mut pairs = self.facts().into_iter().zip(other.facts());
        let ((what, mine), (_, its)) = pairs.find(|((_, mine), (_, its))| mine != its)?;
        let without = |these: &[String], those: &[String]| {
            let others: Vec<_> = these.iter().filter(|one| !those.contains(one)).cloned().collect();
            if others.is_empty() {
                "none".to_owned()
            } else {
                others.join(", ")
            }
        };
        Some((what, without(&mine, &its), without(&its, &mine)))
    }

    /// All facts in which studies can differ, with their names.
    fn facts(&self) -> [(&'static str, Vec<String>); 7] {
        let axis = |axis: &ManifestAxis| format!("{} ({} values, {:?})", axis.key, axis.count, axis.kind);
        let scenario = |scenario: &ManifestScenario| format!("{} {}", scenario.name, scenario.sha256);
        let file = |file: &ManifestFile| format!("{} {}", file.path, file.sha256);
        [
            ("its version of the program", vec![self.version.clone()]),
            ("its version of rows", vec![self.row_schema.to_string()]),
            ("the study file (by its SHA-256)", vec![self.study_sha256.clone()]),
            (
                "a scenario (by its SHA-256)",
                self.scenarios.iter().map(scenario).collect(),
            ),
            (
                "a file that rows refer to (by its SHA-256)",
                self.files.iter().map(file).collect(),
            ),
            ("the number of rows", vec![self.rows.to_string()]),
            ("an axis", self.axes.iter().map(axis).collect()),
        ]
    }
}
