//! A study: scenarios × axes, or rows one by one, checked and counted; which values a row has.

use crate::axis::{Axis, Values, canonical, spaced};
use crate::base::{Base, changed};
use crate::error::StudyError;
use crate::keep::Keep;
use crate::named_files;
use crate::outcome::Outcome;
use crate::parts::{PartsFile, StudyParts};
use crate::row::Row;
use crate::statement::{AxisStatement, FORMAT, OneOrMore, ScenarioStatement, Source, Statement};
use base64::prelude::{BASE64_STANDARD, Engine};
use platewash_kinematics::fingerprint::sha256_hex;
use platewash_kinematics::urdf::HeldFiles;
use platewash_scenario::{Draft, Program, ScenarioError, check_seed, source};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// Most rows of a study.
pub const MOST_ROWS: u64 = 10_000_000;
/// Most values that an axis lists; seeds are counted, not listed.
const MOST_LISTED: usize = 10_000;

/// A study, checked: its keys are those of scenarios, its values within their ranges, one by one.
#[derive(Debug, Clone)]
pub struct Study {
    /// Its name.
    pub name: String,
    /// The file, as it was given.
    pub file: String,
    /// The file's text.
    pub text: String,
    /// Whose plans are kept.
    pub plans: Keep,
    /// The scenarios, the slowest of all axes.
    pub bases: Vec<Base>,
    /// The axes, the last one the fastest; none where rows are listed.
    pub axes: Vec<Axis>,
    /// All files that its rows name, as they were when it was read.
    pub files: Arc<HeldFiles>,
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
    /// A study out of a text; files of scenarios are relative to the folder.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn parse(text: &str, file: &str, folder: &Path) -> Result<Self, StudyError> {
        let from = Source { file, text };
        let stated = statement(&from)?;
        let bases = bases(&from, stated.scenario.span(), stated.scenario.get_ref(), folder)?;
        let study = Self::of(&from, stated, bases)?;
        let files = named_files::read(&study.bases, &study.axes, &study.listed);
        let files = files.map_err(|problem| from.wrong(None, &problem))?;
        Ok(Self {
            files: Arc::new(files),
            ..study
        })
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
        let stated = statement(&from)?;
        let named = stated.scenario.get_ref().all().iter().map(ScenarioStatement::name);
        if !named.eq(parts.bases.iter().map(|base| base.name.as_str())) {
            return Err(from.wrong(Some(stated.scenario.span()), "scenario: the parts hold others"));
        }
        let study = Self::of(&from, stated, parts.bases)?;
        let bytes = |file: PartsFile| {
            let bytes = BASE64_STANDARD.decode(&file.base64);
            bytes.map(|bytes| (file.path, bytes.into())).map_err(|error| {
                let problem = format!("a part of it is no file: {error}");
                from.wrong(None, &problem)
            })
        };
        let files = parts.files.into_iter().map(bytes).collect::<Result<_, _>>()?;
        Ok(Self {
            files: Arc::new(files),
            ..study
        })
    }

    /// All of it, for whoever has no files.
    #[must_use]
    pub fn parts(&self) -> StudyParts {
        StudyParts {
            file: self.file.clone(),
            text: self.text.clone(),
            bases: self.bases.clone(),
            files: self
                .files
                .iter()
                .map(|(path, bytes)| PartsFile {
                    path: path.clone(),
                    base64: BASE64_STANDARD.encode(bytes),
                })
                .collect(),
        }
    }

    fn of(from: &Source<'_>, stated: Statement, bases: Vec<Base>) -> Result<Self, StudyError> {
        if let (Some(rows), Some(_)) = (&stated.rows, &stated.axis) {
            let problem = "rows: a study has [[axis]] sections, which multiply, or [[rows]], which do not; found both";
            return Err(from.wrong(Some(rows.span()), problem));
        }
        let empty = |name: &str| format!("{name}: the list is empty; leave it out for a study of one row a scenario");
        if let Some(span) = stated.axis.as_ref().filter(|axis| axis.get_ref().is_empty()) {
            return Err(from.wrong(Some(span.span()), &empty("axis")));
        }
        if let Some(span) = stated.rows.as_ref().filter(|rows| rows.get_ref().is_empty()) {
            return Err(from.wrong(Some(span.span()), &empty("rows")));
        }
        let mut axes: Vec<Axis> = Vec::new();
        for axis in stated.axis.map(Spanned::into_inner).unwrap_or_default() {
            let span = axis.get_ref().key.span();
            let axis = read_axis(from, axis.span(), axis.into_inner())?;
            if axes.iter().any(|other| other.key == axis.key) {
                return Err(from.wrong(Some(span), &format!("key: there is an axis of {} before", axis.key)));
            }
            check_values(from, span, &bases, &axis)?;
            axes.push(axis);
        }
        let mut listed = Vec::new();
        let mut seen = BTreeSet::new();
        for row in stated.rows.map(Spanned::into_inner).unwrap_or_default() {
            let span = row.span();
            let row = flat(&row.into_inner()).map_err(|problem| from.wrong(Some(span.clone()), &problem))?;
            let wrong = |problem: &str| from.wrong(Some(span.clone()), problem);
            let first: &BTreeMap<_, _> = listed.first().unwrap_or(&row);
            if row.is_empty() || !row.keys().eq(first.keys()) {
                return Err(wrong("rows: every row states the same keys, at least one"));
            }
            for (key, value) in &row {
                check_value(&bases, key, value, listed.len()).map_err(|problem| wrong(&problem))?;
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
            return Err(from.wrong(
                None,
                &format!("axis: the study has more than {MOST_ROWS} rows, which is the most"),
            ));
        };
        Ok(Self {
            name: stated.name.into_inner(),
            file: from.file.to_owned(),
            text: from.text.to_owned(),
            plans: stated.plans,
            files: Arc::default(),
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

    /// A row that is not worked on, with why.
    ///
    /// # Errors
    /// [`StudyError::NoRow`].
    pub fn ended(&self, index: u64, outcome: Outcome, reason: &str) -> Result<Row, StudyError> {
        let address = self.row(index)?;
        let name = self.bases[address.base].name.clone();
        Ok(Row::new(index, address.key, name, address.axes).ended(outcome, reason.to_owned()))
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

fn statement(from: &Source<'_>) -> Result<Statement, StudyError> {
    let stated = from.statement()?;
    if stated.format.get_ref() != FORMAT {
        let problem = format!("format must be \"{FORMAT}\"; found {:?}", stated.format.get_ref());
        return Err(from.wrong(Some(stated.format.span()), &problem));
    }
    let name = stated.name.get_ref();
    if name.trim().is_empty() || name.chars().any(char::is_control) {
        let problem = format!("name must be a line of text; found {name:?}");
        return Err(from.wrong(Some(stated.name.span()), &problem));
    }
    Ok(stated)
}

fn bases(from: &Source<'_>, span: Range<usize>, stated: &OneOrMore, folder: &Path) -> Result<Vec<Base>, StudyError> {
    let wrong = |problem: String| from.wrong(Some(span.clone()), &format!("scenario: {problem}"));
    if stated.all().is_empty() {
        return Err(wrong("the list is empty".to_owned()));
    }
    let mut bases: Vec<Base> = Vec::new();
    for one in stated.all() {
        let name = one.name();
        if name.trim().is_empty() || bases.iter().any(|base| base.name == name) {
            return Err(wrong(match name.trim() {
                "" => "a name must not be empty".to_owned(),
                _ => format!("{name} is there twice"),
            }));
        }
        let (base, place) = match one {
            ScenarioStatement::Named(name) => named(name, folder).map_err(|error| wrong(error.to_string()))?,
            ScenarioStatement::Text(stated) => {
                let base = Base {
                    name: name.to_owned(),
                    text: stated.text.clone(),
                    folder: Some(folder.to_owned()),
                };
                (base, name.to_owned())
            }
        };
        let draft = Draft::new(&base.text).and_then(|draft| draft.scenario(&place, base.folder.as_deref()));
        let scenario = draft.map_err(|error| wrong(error.to_string()))?;
        if scenario.job.program == Program::Paper {
            return Err(wrong(format!(
                "a study plans certified jobs; {name} has job.program = \"paper\""
            )));
        }
        bases.push(base);
    }
    Ok(bases)
}

/// A scenario by its name or file, with what errors call it.
fn named(name: &str, folder: &Path) -> Result<(Base, String), ScenarioError> {
    // A file beside the study goes before a shipped name only where it is one: shipped names are no paths.
    let shipped = platewash_scenario::SHIPPED.iter().any(|shipped| shipped.name == name);
    let place = match shipped {
        true => name.to_owned(),
        false => folder.join(name).display().to_string(),
    };
    let read = source(&place)?;
    let base = Base {
        name: name.to_owned(),
        text: read.text,
        folder: read.folder,
    };
    Ok((base, place))
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
            let listed = evenly(range.get_ref());
            let distinct: BTreeSet<_> = listed.iter().map(canonical).collect();
            if listed.is_empty() || distinct.len() != listed.len() {
                let word =
                    |value: &toml::Value| value.as_float().map_or_else(|| value.to_string(), |v| format!("{v:?}"));
                let found: Vec<_> = range.get_ref().iter().map(word).collect();
                let problem = format!(
                    "range of {key}: must be [from, to, count], two finite numbers that differ and from 2 to {MOST_LISTED} values; found [{:.80}]",
                    found.join(", ")
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

/// The values of a range; none where it is no range.
fn evenly(stated: &[toml::Value]) -> Vec<Value> {
    let number = |value: &toml::Value| value.as_float().or_else(|| value.as_integer().map(|v| v as f64));
    let [from, to, count] = stated else {
        return Vec::new();
    };
    let count = count.as_integer().and_then(|count| usize::try_from(count).ok());
    match (number(from), number(to), count) {
        (Some(from), Some(to), Some(count))
            if from != to && (to - from).is_finite() && (2..=MOST_LISTED).contains(&count) =>
        {
            spaced(from, to, count)
        }
        _ => Vec::new(),
    }
}

fn check_values(from: &Source<'_>, span: Range<usize>, bases: &[Base], axis: &Axis) -> Result<(), StudyError> {
    let first = axis.value(0).into_iter().collect();
    let values = match &axis.values {
        Values::Listed(values) => values,
        // All of them are seeds.
        Values::Seeds { .. } => &first,
    };
    for (place, value) in values.iter().enumerate() {
        check_value(bases, &axis.key, value, place).map_err(|problem| from.wrong(Some(span.clone()), &problem))?;
    }
    Ok(())
}

/// Whether every base has the key, and the key takes the value. That the texts have a place for the key is tried out with its first two values,
/// of which one may be there already; the others are looked at by themselves, as a text is read again with every change.
fn check_value(bases: &[Base], key: &str, value: &Value, place: usize) -> Result<(), String> {
    if key == "job.program" && value != "certified" {
        return Err(format!("{key}: a study plans certified jobs; found {value}"));
    }
    let tried_out = if place < 2 { bases.len() } else { 0 };
    if let Some(base) = bases.get(tried_out) {
        Draft::check(key, value).map_err(|problem| format!("{}: {problem}", base.name))?;
    }
    for base in &bases[..tried_out] {
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
