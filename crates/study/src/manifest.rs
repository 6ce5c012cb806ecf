//! What a folder keeps a study of: enough to tell it from every other.

use crate::row::ROW_SCHEMA;
use crate::study::Study;
use platewash_kinematics::fingerprint::sha256_hex;
use serde::{Deserialize, Serialize};

/// What `format` says.
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
    /// How many rows it has when it is finished.
    pub rows: u64,
    /// SHA-256 of the study file.
    pub study_sha256: String,
    /// Its scenarios.
    pub scenarios: Vec<ManifestScenario>,
    /// Its axes.
    pub axes: Vec<ManifestAxis>,
    /// The study file as it was given, for commands that reproduce a row; it is no part of what tells studies apart.
    pub file: String,
}

/// A scenario of a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestScenario {
    /// As the study names it.
    pub name: String,
    /// SHA-256 of its text.
    pub sha256: String,
}

/// An axis of a study.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ManifestAxis {
    /// The scenario's key.
    pub key: String,
    /// How many values it takes.
    pub count: u64,
}

impl Manifest {
    /// The manifest of a study that is read from `file`.
    #[must_use]
    pub fn of(study: &Study, file: &str) -> Self {
        let scenario = |base: &crate::study::Base| ManifestScenario {
            name: base.name.clone(),
            sha256: sha256_hex(base.text.as_bytes()),
        };
        let listed = study.listed.first().into_iter().flat_map(|row| row.keys());
        let listed = listed.map(|key| ManifestAxis {
            key: key.clone(),
            count: study.listed.len() as u64,
        });
        let axes = study.axes.iter().map(|axis| ManifestAxis {
            key: axis.key.clone(),
            count: axis.count(),
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
            file: file.to_owned(),
        }
    }

    /// What tells this study from another one, with what each of them has.
    pub(crate) fn difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let texts = |of: &Self| {
            let text = |scenario: &ManifestScenario| format!("{} {}", scenario.name, &scenario.sha256);
            of.scenarios.iter().map(text).collect::<Vec<_>>().join(", ")
        };
        let facts = |of: &Self| {
            [
                ("its version of the program", of.version.clone()),
                ("its version of rows", of.row_schema.to_string()),
                ("the study file (by its SHA-256)", of.study_sha256.clone()),
                ("a scenario (by its SHA-256)", texts(of)),
                ("the number of rows", of.rows.to_string()),
            ]
        };
        let mut pairs = facts(self).into_iter().zip(facts(other));
        pairs.find_map(|((what, mine), (_, its))| (mine != its).then_some((what, mine, its)))
    }
}
