//! A study: scenarios × axes, or rows one by one, checked and counted; which values a row has.

use crate::axis::{Axis, Values, canonical, spaced};
use crate::error::StudyError;
use crate::statement::{AxisStatement, FORMAT, OneOrMore, Source};
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_kinematics::urdf::file::read_text;
use platewash_scenario::{Draft, Program, check_seed, source};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Most rows of a study.
pub const MOST_ROWS: u64 = 10_000_000;
/// Longest study file that is read \[bytes\].
const MOST_BYTES: u64 = 16 << 20;
/// Most values that an axis lists; seeds are counted, not listed.
const MOST_LISTED: usize = 10_000;

/// A scenario that rows begin from.
#[derive(Debug, Clone)]
pub struct Base {
    /// As the study names it: a shipped name, or a file relative to the study's.
    pub name: String,
    /// Its text.
    pub text: String,
    /// The folder to which paths in it are relative.
    pub folder: Option<PathBuf>,
}

/// A study, checked: its keys are those of scenarios, its values within their ranges, one by one.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its name.
    pub name: String,
    /// The file's text.
    pub text: String,
    /// The scenarios, the slowest of all axes.
    pub bases: Vec<Base>,
    /// The axes, the last one the fastest; none where rows are listed.
    pub axes: Vec<Axis>,
    pub(crate) listed: Vec<BTreeMap<String, Value>>,
    rows: u64,
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

impl Study {
    /// Reads a study file.
    ///
    /// # Errors
    /// [`StudyError::File`] with the line and the key.
    pub fn load(file: &Path) -> Result<Self, StudyError> {
        let name = file.display().to_string();
        let text = read_text(file, MOST_BYTES).map_err(|error| StudyError::File {
            file: name.clone(),
            line: None,
            problem: error.to_string(),
        })?;
        Self::parse(&text, &name, file.parent().unwrap_or(Path::new("")))
    }

    /// A study out of a text; files of scenarios are relative to the folder.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn parse(text: &str, file: &str, folder: &Path) -> Result<Self, StudyError> {
        let from = Source { file, text };
        let stated = from.statement()?;
        if stated.format.get_ref() != FORMAT {
            let problem = format!("format must be \"{FORMAT}\"; found {:?}", stated.format.get_ref());
            return Err(from.wrong(Some(stated.format.span()), &problem));
        }
        if stated.name.get_ref().trim().is_empty() {
            return Err(from.wrong(Some(stated.name.span()), "name must not be empty"));
        }
        let bases = bases(&from, stated.scenario.span(), stated.scenario.into_inner(), folder)?;
        if let (Some(row), false) = (stated.rows.first(), stated.axis.is_empty()) {
            let problem = "rows: a study has [[axis]] sections, which multiply, or [[rows]], which do not; found both";
            return Err(from.wrong(Some(row.span()), problem));
        }
        let mut axes: Vec<Axis> = Vec::new();
        for axis in stated.axis {
            let span = axis.get_ref().key.span();
            let axis = read_axis(&from, axis.span(), axis.into_inner())?;
            if axes.iter().any(|other| other.key == axis.key) {
                return Err(from.wrong(Some(span), &format!("key: there is an axis of {} before", axis.key)));
            }
            check_values(&from, span, &bases, &axis)?;
            axes.push(axis);
        }
        let mut listed = Vec::new();
        let mut seen = BTreeSet::new();
        for row in stated.rows {
            let span = row.span();
            let row = flat(&row.into_inner()).map_err(|problem| from.wrong(Some(span.clone()), &problem))?;
            let wrong = |problem: &str| from.wrong(Some(span.clone()), problem);
            let first: &BTreeMap<_, _> = listed.first().unwrap_or(&row);
            if row.is_empty() || !row.keys().eq(first.keys()) {
                return Err(wrong("rows: every row states the same keys, at least one"));
            }
            for (key, value) in &row {
                check_value(&bases, key, value).map_err(|problem| wrong(&problem))?;
            }
            if !seen.insert(row.values().map(canonical).collect::<Vec<_>>()) {
                return Err(wrong("rows: this row is there before"));
            }
            listed.push(row);
        }
        let of_axes = axes.iter().map(Axis::count);
        let counts = [bases.len() as u64, listed.len().max(1) as u64];
        let rows = counts.into_iter().chain(of_axes).try_fold(1_u64, u64::checked_mul);
        let Some(rows) = rows.filter(|rows| *rows <= MOST_ROWS) else {
            return Err(from.wrong(None, &format!("axis: the study has more than {MOST_ROWS} rows")));
        };
        Ok(Self {
            name: stated.name.into_inner(),
            text: text.to_owned(),
            bases,
            axes,
            listed,
            rows,
        })
    }

    /// How many rows there are.
    #[must_use]
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The values of a row.
    ///
    /// # Errors
    /// [`StudyError::NoRow`].
    pub fn row(&self, index: u64) -> Result<RowAddress, StudyError> {
        let none = || StudyError::NoRow { index, rows: self.rows };
        if index >= self.rows {
            return Err(none());
        }
        let (mut rest, mut axes) = (index, BTreeMap::new());
        for axis in self.axes.iter().rev() {
            axes.insert(axis.key.clone(), axis.value(rest % axis.count()).ok_or_else(none)?);
            rest /= axis.count();
        }
        if !self.listed.is_empty() {
            let count = self.listed.len() as u64;
            axes.clone_from(&self.listed[(rest % count) as usize]);
            rest /= count;
        }
        let base = rest as usize;
        let values: Vec<_> = axes.iter().map(|(key, v)| format!("{key}={}", canonical(v))).collect();
        let words = format!("{}\n{}", self.bases[base].name, values.join("\n"));
        let key = sha256_hex(words.as_bytes())[..16].to_owned();
        Ok(RowAddress { base, axes, key })
    }

    /// The text of a row's scenario: that of its base, all but the axes as it stands there.
    ///
    /// # Errors
    /// [`StudyError::NoRow`]; [`StudyError::Row`] where the values do not go together.
    pub fn scenario_text(&self, index: u64) -> Result<String, StudyError> {
        let row = self.row(index)?;
        changed(&self.bases[row.base].text, &row.axes).map_err(|problem| StudyError::Row { index, problem })
    }
}

/// A scenario's text with other values.
pub(crate) fn changed<'a>(
    text: &str,
    values: impl IntoIterator<Item = (&'a String, &'a Value)>,
) -> Result<String, String> {
    let mut draft = Draft::new(text).map_err(|error| error.to_string())?;
    for (key, value) in values {
        draft.set(key, Some(value)).map_err(|error| error.to_string())?;
    }
    Ok(draft.text().to_owned())
}

fn bases(from: &Source<'_>, span: Range<usize>, stated: OneOrMore, folder: &Path) -> Result<Vec<Base>, StudyError> {
    let names = match stated {
        OneOrMore::One(name) => vec![name],
        OneOrMore::More(names) => names,
    };
    let wrong = |problem: String| from.wrong(Some(span.clone()), &format!("scenario: {problem}"));
    if names.is_empty() {
        return Err(wrong("the list is empty".to_owned()));
    }
    let mut bases: Vec<Base> = Vec::new();
    for name in names {
        if bases.iter().any(|base| base.name == name) {
            return Err(wrong(format!("{name} is there twice")));
        }
        // A file beside the study goes before a shipped name only where it is one: shipped names are no paths.
        let shipped = platewash_scenario::SHIPPED.iter().any(|shipped| shipped.name == name);
        let place = if shipped {
            name.clone()
        } else {
            folder.join(&name).display().to_string()
        };
        let read = source(&place).map_err(|error| wrong(error.to_string()))?;
        let draft = Draft::new(&read.text).and_then(|draft| draft.scenario(&place, read.folder.as_deref()));
        let scenario = draft.map_err(|error| wrong(error.to_string()))?;
        if scenario.job.program == Program::Paper {
            return Err(wrong(format!(
                "a study plans certified jobs; {name} has job.program = \"paper\""
            )));
        }
        bases.push(Base {
            name,
            text: read.text,
            folder: read.folder,
        });
    }
    Ok(bases)
}

fn read_axis(from: &Source<'_>, whole: Range<usize>, stated: AxisStatement) -> Result<Axis, StudyError> {
    let key = stated.key.get_ref().clone();
    let values = match (stated.values, stated.range, stated.seeds) {
        (Some(values), None, None) => {
            let wrong = |problem: &str| from.wrong(Some(values.span()), &format!("values of {key}: {problem}"));
            if values.get_ref().is_empty() || values.get_ref().len() > MOST_LISTED {
                return Err(wrong(&format!("must be from 1 to {MOST_LISTED} of them")));
            }
            let listed: Result<Vec<_>, _> = values.get_ref().iter().map(json).collect();
            let listed = listed.map_err(|problem| wrong(&problem))?;
            let mut seen = BTreeSet::new();
            if let Some(twice) = listed.iter().find(|value| !seen.insert(canonical(value))) {
                return Err(wrong(&format!("{twice} is there twice")));
            }
            Values::Listed(listed)
        }
        (None, Some(range), None) => {
            let (from_value, to, count) = *range.get_ref();
            let good = from_value.is_finite() && to.is_finite() && (to - from_value).is_finite();
            let steps = (2..=MOST_LISTED).contains(&(count as usize)) && from_value != to;
            let listed = spaced(from_value, to, if good && steps { count as usize } else { 0 });
            let distinct: BTreeSet<_> = listed.iter().map(canonical).collect();
            if listed.is_empty() || distinct.len() != listed.len() {
                let problem = format!(
                    "range of {key}: must be [from, to, count], two finite numbers that differ and from 2 to {MOST_LISTED} values; found \
                     [{from_value}, {to}, {count}]"
                );
                return Err(from.wrong(Some(range.span()), &problem));
            }
            Values::Listed(listed)
        }
        (None, None, Some(seeds)) => {
            let wrong = |problem: &str| from.wrong(Some(seeds.span()), &format!("seeds: {problem}"));
            let ends = seeds.get_ref().split_once("..");
            let ends = ends.and_then(|(a, b)| Some((a.trim().parse::<u64>().ok()?, b.trim().parse::<u64>().ok()?)));
            let Some((first, last)) = ends.filter(|(first, last)| first <= last && key == "seed") else {
                return Err(wrong(&format!(
                    "must be \"FIRST..LAST\", whole numbers, the first at most the last, with key = \"seed\"; found {:?} with {key:?}",
                    seeds.get_ref()
                )));
            };
            check_seed("the last of them", last).map_err(|error| wrong(&error.to_string()))?;
            Values::Seeds {
                first,
                count: last - first + 1,
            }
        }
        _ => {
            let problem = format!("axis of {key}: needs one of values, range and seeds");
            return Err(from.wrong(Some(whole), &problem));
        }
    };
    Ok(Axis { key, values })
}

fn check_values(from: &Source<'_>, span: Range<usize>, bases: &[Base], axis: &Axis) -> Result<(), StudyError> {
    let first = axis.value(0).into_iter().collect();
    let values = match &axis.values {
        Values::Listed(values) => values,
        // All of them are seeds.
        Values::Seeds { .. } => &first,
    };
    for value in values {
        check_value(bases, &axis.key, value).map_err(|problem| from.wrong(Some(span.clone()), &problem))?;
    }
    Ok(())
}

/// Whether every base has the key, and the key takes the value.
fn check_value(bases: &[Base], key: &str, value: &Value) -> Result<(), String> {
    for base in bases {
        changed(&base.text, [(&key.to_owned(), value)]).map_err(|problem| format!("{}: {problem}", base.name))?;
    }
    Ok(())
}

/// A row's keys with their sections before them.
fn flat(row: &toml::Table) -> Result<BTreeMap<String, Value>, String> {
    let mut all = BTreeMap::new();
    for (name, value) in row {
        match value {
            toml::Value::Table(section) => {
                let section = flat(section)?;
                all.extend(section.into_iter().map(|(key, value)| (format!("{name}.{key}"), value)));
            }
            value => {
                all.insert(
                    name.clone(),
                    json(value).map_err(|problem| format!("{name}: {problem}"))?,
                );
            }
        }
    }
    Ok(all)
}

fn json(value: &toml::Value) -> Result<Value, String> {
    Ok(match value {
        toml::Value::String(text) => Value::from(text.as_str()),
        toml::Value::Integer(v) => Value::from(*v),
        toml::Value::Float(v) if v.is_finite() => Value::from(*v),
        toml::Value::Boolean(v) => Value::from(*v),
        toml::Value::Array(values) => values.iter().map(json).collect::<Result<_, _>>()?,
        other => {
            return Err(format!(
                "must be finite numbers, texts, true, false or lists of them; found {other}"
            ));
        }
    })
}
