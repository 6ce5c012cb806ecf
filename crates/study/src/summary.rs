//! What the rows of a study come to: outcomes by axis, durations, the rows to look at.

use crate::error::StudyError;
use crate::kept::{check_unchanged, read_manifest, rows};
use crate::manifest::Manifest;
use crate::outcome::Outcome;
use crate::row::Row;
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;

/// Values of an axis that are counted one by one; an axis with more, as seeds, is not.
const MOST_VALUES: u64 = 50;
/// Rows of each kind that are shown.
const SHOWN: usize = 5;

/// How many rows ended how, by the code of the outcome.
pub type Counts = BTreeMap<&'static str, u64>;

/// What the rows of a study come to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// The study.
    pub manifest: Manifest,
    /// Rows that are done.
    pub done: u64,
    /// How they ended.
    pub outcomes: Counts,
    /// The same by axis (`scenario` among them) and value, as JSON; axes of more than 50 values are left out.
    pub by_axis: BTreeMap<String, BTreeMap<String, Counts>>,
    /// Least, 5 %, 50 %, 95 % and greatest duration of the motions that are proved \[s\]; `None` without any.
    pub duration_s: Option<[f64; 5]>,
    /// The first rows that are not proved, of each outcome the five of the least index.
    pub not_proved: Vec<Row>,
    /// The five proved rows of the least clearance, the least first.
    pub nearest: Vec<Row>,
}

/// Sums a folder up, row by row.
///
/// # Errors
/// [`StudyError`]: no study, rows that were changed since it was finished, or a file that cannot be read.
pub fn summary(folder: &Path) -> Result<Summary, StudyError> {
    let manifest = read_manifest(folder)?;
    check_unchanged(folder, &manifest)?;
    let few: Vec<_> = manifest.axes.iter().filter(|axis| axis.count <= MOST_VALUES).collect();
    let mut outcomes = Counts::new();
    let mut by_axis: BTreeMap<String, BTreeMap<String, Counts>> = BTreeMap::new();
    let (mut durations, mut done) = (Vec::new(), 0);
    let mut worst: BTreeMap<Outcome, Vec<Row>> = BTreeMap::new();
    rows(folder, &manifest, |row| {
        done += 1;
        let code = row.outcome.code();
        *outcomes.entry(code).or_default() += 1;
        let values = few
            .iter()
            .filter_map(|axis| Some((axis.key.as_str(), row.axes.get(&axis.key)?.to_string())));
        for (key, value) in values.chain([("scenario", row.scenario.clone())]) {
            let of_axis = by_axis.entry(key.to_owned()).or_default();
            *of_axis.entry(value).or_default().entry(code).or_default() += 1;
        }
        if row.outcome == Outcome::Proved {
            durations.extend(row.duration_s);
        }
        let shown = worst.entry(row.outcome).or_default();
        let at = shown.partition_point(|other| before(other, row));
        if at < SHOWN {
            shown.insert(at, row.clone());
            shown.truncate(SHOWN);
        }
    })?;
    durations.sort_unstable_by(f64::total_cmp);
    let quantile = |share: f64| durations[(share * (durations.len() - 1) as f64).round() as usize];
    let nearest = worst.remove(&Outcome::Proved).unwrap_or_default();
    Ok(Summary {
        manifest,
        done,
        outcomes,
        by_axis,
        duration_s: (!durations.is_empty()).then(|| [0.0, 0.05, 0.5, 0.95, 1.0].map(quantile)),
        not_proved: worst.into_values().flatten().collect(),
        nearest,
    })
}

/// Which of two rows of one outcome is told first.
fn before(a: &Row, b: &Row) -> bool {
    let clearance = |row: &Row| match row.outcome {
        Outcome::Proved => row.clearance_m.unwrap_or(f64::INFINITY),
        _ => 0.0,
    };
    clearance(a)
        .total_cmp(&clearance(b))
        .then(a.index.cmp(&b.index))
        .is_lt()
}
