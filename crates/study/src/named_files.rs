//! The files that the scenarios of a study name: read once, when the study is.

use crate::axis::{Axis, canonical};
use crate::base::{Base, changed};
use platewash_kinematics::urdf::{Files, HeldFiles};
use platewash_scenario::Draft;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};

/// Most combinations of files that rows name.
const MOST_COMBINATIONS: usize = 1000;

/// Values of keys.
type Row = BTreeMap<String, Value>;

/// Reads all files that rows name: each combination of values of keys that are paths is looked at once, with the first values of all others.
///
/// # Errors
/// In words: the first file that is there and cannot be read, or is named and is not there, and why; more combinations than anybody means.
pub(crate) fn read(bases: &[Base], axes: &[Axis], listed: &[Row]) -> Result<HeldFiles, String> {
    let files = Files::recording();
    for base in bases {
        for values in combinations(axes, listed)? {
            // Values that do not go together are an outcome of their rows.
            let Ok(text) = changed(&base.text, &values) else {
                continue;
            };
            let draft = Draft::new(&text).and_then(|draft| draft.scenario(&base.name, base.folder.as_deref()));
            if let Ok(mut scenario) = draft {
                scenario.files = files.clone();
                scenario.read_files();
            }
        }
    }
    let unread =
        |(path, why): (std::path::PathBuf, _)| format!("{}, which it names, cannot be read: {why}", path.display());
    files.recorded().map_err(unread)
}

/// The rows that may name different files.
fn combinations(axes: &[Axis], listed: &[Row]) -> Result<Vec<Row>, String> {
    let mut seen = BTreeSet::new();
    let named = |row: &Row| -> Vec<String> {
        let paths = row.iter().filter(|(key, _)| Draft::names_files(key));
        paths.map(|(_, value)| canonical(value)).collect()
    };
    let mut rows: Vec<Row> = match listed {
        [] => vec![Row::new()],
        listed => listed.iter().filter(|row| seen.insert(named(row))).cloned().collect(),
    };
    let bounded = |count: usize| match count {
        0..=MOST_COMBINATIONS => Ok(()),
        _ => Err(format!(
            "rows name more than {MOST_COMBINATIONS} combinations of files, which are read beforehand"
        )),
    };
    bounded(rows.len())?;
    for axis in axes {
        let count = if Draft::names_files(&axis.key) { axis.count() } else { 1 };
        let values: Vec<_> = (0..count).filter_map(|place| axis.value(place)).collect();
        bounded(rows.len().saturating_mul(values.len()))?;
        let with = |row: &Row| {
            let one = |value: &Value| {
                let mut row = row.clone();
                row.insert(axis.key.clone(), value.clone());
                row
            };
            values.iter().map(one).collect::<Vec<Row>>()
        };
        rows = rows.iter().flat_map(with).collect();
    }
    Ok(rows)
}
