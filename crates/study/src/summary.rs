//! Summary of the rows of a study: outcomes by axis, durations, the rows to look at.

use crate::error::StudyError;
use crate::folder_reader::{check_unchanged, read_manifest, rows};
use crate::manifest::Manifest;
use crate::row::{Outcome, Row};
use serde::Serialize;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::path::Path;

/// Values of an axis that are counted one by one; an axis with more, as seeds, is not.
const MOST_VALUES: u64 = 50;
/// Rows of each kind that are shown.
const SHOWN: usize = 5;

/// Number of rows by outcome, keyed by the code of the outcome.
pub type Counts = BTreeMap<&'static str, u64>;

/// A value of an axis, as JSON. Numbers are in order of size, before everything else.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct AxisValue(pub String);

impl Ord for AxisValue {
    fn cmp(&self, other: &Self) -> Ordering {
        let order = |value: &Self| value.0.parse().unwrap_or(f64::INFINITY);
        order(self).total_cmp(&order(other)).then_with(|| self.0.cmp(&other.0))
    }
}

impl PartialOrd for AxisValue {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Summary of the rows of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// The study.
    pub manifest: Manifest,
    /// Rows that are done.
    pub done: u64,
    /// Counts by outcome.
    pub outcomes: Counts,
    /// The same by axis (`scenario` among them) and value, as JSON; axes of more than 50 values are left out.
    pub by_axis: BTreeMap<String, BTreeMap<AxisValue, Counts>>,
    /// Least, 5 %, 50 %, 95 % and greatest duration of the motions that are proved \[s\]; `None` without any.
    pub duration_s: Option<[f64; 5]>,
    /// The first rows that are not proved, of each outcome the five of the least index.
    pub not_proved: Vec<Row>,
    /// The five proved rows of the least clearance, the least first.
    pub nearest: Vec<Row>,
    /// The five proved rows of the longest motions, the longest first.
    pub slowest: Vec<Row>,
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
    let mut by_axis: BTreeMap<String, BTreeMap<AxisValue, Counts>> = BTreeMap::new();
    let (mut durations, mut done) = (Vec::new(), 0);
    let mut not_proved: BTreeMap<Outcome, Vec<Row>> = BTreeMap::new();
    let (mut nearest, mut slowest) = (Vec::new(), Vec::new());
    rows(folder, &manifest, |_, row| {
        let row = &row;
        done += 1;
        let code = row.outcome.code();
        *outcomes.entry(code).or_default() += 1;
        let values = few
            .iter()
            .filter_map(|axis| Some((axis.key.as_str(), row.axes.get(&axis.key)?.to_string())));
        for (key, value) in values.chain([("scenario", row.scenario.clone())]) {
            let of_axis = by_axis.entry(key.to_owned()).or_default();
            *of_axis.entry(AxisValue(value)).or_default().entry(code).or_default() += 1;
        }
        if row.outcome == Outcome::Proved {
            durations.extend(row.duration_s);
            keep(&mut nearest, row, |row| row.clearance_m.unwrap_or(f64::INFINITY));
            keep(&mut slowest, row, |row| -row.duration_s.unwrap_or(0.0));
        } else {
            keep(not_proved.entry(row.outcome).or_default(), row, |_| 0.0);
        }
    })?;
    durations.sort_unstable_by(f64::total_cmp);
    let quantile = |share: f64| durations[(share * (durations.len() - 1) as f64).round() as usize];
    Ok(Summary {
        manifest,
        done,
        outcomes,
        by_axis,
        duration_s: (!durations.is_empty()).then(|| [0.0, 0.05, 0.5, 0.95, 1.0].map(quantile)),
        not_proved: not_proved.into_values().flatten().collect(),
        nearest,
        slowest,
    })
}

/// Keeps a row where it is one of the five of the least rank, or of the least index among equals.
fn keep(shown: &mut Vec<Row>, row: &Row, rank: impl Fn(&Row) -> f64) {
    let before = |other: &Row| {
        rank(other)
            .total_cmp(&rank(row))
            .then(other.index.cmp(&row.index))
            .is_lt()
    };
    let at = shown.partition_point(before);
    if at < SHOWN {
        shown.insert(at, row.clone());
        shown.truncate(SHOWN);
    }
}
