//! Statements of a study file, checked; errors name their line and key.

use crate::axis::{Axis, Values, canonical, spaced};
use crate::error::StudyError;
use crate::row::PlanChoice;
use crate::study::{Base, MOST_ROWS, Study};
use platewash_kinematics::words::message_in_words;
use platewash_scenario::keys::KEYS;
use platewash_scenario::{Draft, Program, SHIPPED, ScenarioError, check_seed, source};
use serde::Deserialize;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;
use toml::Spanned;

/// Required value of `format`.
const FORMAT: &str = "platewash-study/1";
/// Most values that an axis lists; seeds are counted, not listed.
const MOST_LISTED: usize = 10_000;

/// A study file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StudyFile {
    pub format: Spanned<String>,
    pub name: Spanned<String>,
    pub scenario: Spanned<OneOrMore>,
    #[serde(default)]
    pub plans: PlanChoice,
    pub axis: Option<Spanned<Vec<Spanned<AxisStatement>>>>,
    pub rows: Option<Spanned<Vec<Spanned<toml::Table>>>>,
}

/// A scenario or several.
#[derive(Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "scenario must be a name, a file or a table { name, text } with a scenario's text, or a list of them"
)]
pub(crate) enum OneOrMore {
    // Lists first: one of two texts would do as a table's name and text.
    More(Vec<ScenarioStatement>),
    One(ScenarioStatement),
}

/// A scenario by its name or file, or by its text.
#[derive(Debug, Deserialize)]
#[serde(untagged)]
pub(crate) enum ScenarioStatement {
    Named(String),
    Text(TextStatement),
}

/// A scenario's text, and its name in the study.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TextStatement {
    pub name: String,
    pub text: String,
}

impl OneOrMore {
    /// All scenarios of it.
    fn all(&self) -> &[ScenarioStatement] {
        match self {
            Self::One(one) => std::slice::from_ref(one),
            Self::More(all) => all,
        }
    }
}

impl ScenarioStatement {
    /// Name of the scenario in the study.
    fn name(&self) -> &str {
        match self {
            Self::Named(name) => name,
            Self::Text(stated) => &stated.name,
        }
    }
}

/// `[[axis]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AxisStatement {
    pub key: Spanned<String>,
    pub values: Option<Spanned<Vec<toml::Value>>>,
    pub range: Option<Spanned<Vec<toml::Value>>>,
    pub seeds: Option<Spanned<String>>,
}

/// A study file's text, and where errors are in it.
pub(crate) struct Source<'a> {
    pub file: &'a str,
    pub text: &'a str,
}

impl Source<'_> {
    /// Parses the text.
    pub fn statement(&self) -> Result<StudyFile, StudyError> {
        let stated: StudyFile = toml::from_str(self.text).map_err(|error| {
            let key = error.span().and_then(|span| self.key_at(span.start));
            let key = key.filter(|key| !error.message().contains(key)).unwrap_or_default();
            self.error_at(error.span(), &message_in_words(key, error.message()))
        })?;
        let (format, name) = (stated.format.get_ref(), stated.name.get_ref());
        if format != FORMAT {
            let problem = format!("format must be \"{FORMAT}\"; found {format:?}");
            return Err(self.error_at(Some(stated.format.span()), &problem));
        }
        if name.trim().is_empty() || name.chars().any(char::is_control) {
            let problem = format!("name must be a line of text; found {name:?}");
            return Err(self.error_at(Some(stated.name.span()), &problem));
        }
        Ok(stated)
    }

    /// The key whose value begins at a place of the text, where both stand on one line.
    fn key_at(&self, place: usize) -> Option<&str> {
        let line = self.text.get(..place)?.lines().next_back()?;
        line.split_once('=').map(|(key, _)| key.trim())
    }

    /// An error at a stretch of the text; its words become one line.
    pub fn error_at(&self, span: Option<Range<usize>>, problem: &str) -> StudyError {
        let line = span.map(|span| 1 + self.text.bytes().take(span.start).filter(|b| *b == b'\n').count());
        StudyError::File {
            file: self.file.to_owned(),
            line,
            problem: problem.split_whitespace().collect::<Vec<_>>().join(" "),
        }
    }

    /// The scenarios that rows begin from, read; those that are files are relative to the folder.
    pub fn bases(&self, stated: &Spanned<OneOrMore>, folder: &Path) -> Result<Vec<Base>, StudyError> {
        let wrong = |problem: String| self.error_at(Some(stated.span()), &format!("scenario: {problem}"));
        if stated.get_ref().all().is_empty() {
            return Err(wrong("the list is empty".to_owned()));
        }
        let mut bases: Vec<Base> = Vec::new();
        for one in stated.get_ref().all() {
            let name = one.name();
            if name.trim().is_empty() {
                return Err(wrong("a name must not be empty".to_owned()));
            }
            if bases.iter().any(|base| base.name == name) {
                return Err(wrong(format!("{name} is there twice")));
            }
            let (base, program) = base(one, folder).map_err(|error| wrong(error.to_string()))?;
            if program == Program::Paper {
                return Err(wrong(format!(
                    "a study plans certified jobs; {name} has job.program = \"paper\""
                )));
            }
            bases.push(base);
        }
        Ok(bases)
    }

    /// The study of these scenarios, without the files that its rows name.
    pub fn study(&self, stated: StudyFile, bases: Vec<Base>) -> Result<Study, StudyError> {
        if let Some(rows) = &stated.rows {
            let wrong = |problem: &str| Err(self.error_at(Some(rows.span()), &format!("rows: {problem}")));
            if stated.axis.is_some() {
                return wrong("a study has [[axis]] sections, which multiply, or [[rows]], which do not; found both");
            }
            if rows.get_ref().is_empty() {
                return wrong("the list is empty; leave it out for a study of one row a scenario");
            }
        }
        if let Some(axis) = stated.axis.as_ref().filter(|axis| axis.get_ref().is_empty()) {
            let problem = "axis: the list is empty; leave it out for a study of one row a scenario";
            return Err(self.error_at(Some(axis.span()), problem));
        }
        let axes = self.axes(stated.axis.map(Spanned::into_inner).unwrap_or_default(), &bases)?;
        let listed = self.listed_rows(stated.rows.map(Spanned::into_inner).unwrap_or_default(), &bases)?;
        let mut study = Study {
            name: stated.name.into_inner(),
            file: self.file.to_owned(),
            text: self.text.to_owned(),
            plans: stated.plans,
            files: Arc::default(),
            bases,
            axes,
            listed,
            rows: 0,
        };
        let Some(rows) = study.row_count().filter(|rows| *rows <= MOST_ROWS) else {
            let problem = format!("axis: the study has more than {MOST_ROWS} rows, which is the most");
            return Err(self.error_at(None, &problem));
        };
        study.rows = rows;
        Ok(study)
    }

    fn axes(&self, stated: Vec<Spanned<AxisStatement>>, bases: &[Base]) -> Result<Vec<Axis>, StudyError> {
        let mut axes: Vec<Axis> = Vec::new();
        for axis in stated {
            let (whole, span) = (axis.span(), axis.get_ref().key.span());
            let axis = self.axis(whole, axis.into_inner())?;
            let wrong = |problem: &str| self.error_at(Some(span.clone()), problem);
            if axes.iter().any(|other| other.key == axis.key) {
                return Err(wrong(&format!("key: there is an axis of {} before", axis.key)));
            }
            // One seed speaks for all.
            let looked_at = if matches!(axis.values, Values::Seeds { .. }) {
                1
            } else {
                axis.count()
            };
            for (place, value) in (0..looked_at).filter_map(|place| axis.value(place)).enumerate() {
                check_value(bases, &axis.key, &value, place).map_err(|problem| wrong(&problem))?;
            }
            axes.push(axis);
        }
        Ok(axes)
    }

    fn axis(&self, whole: Range<usize>, stated: AxisStatement) -> Result<Axis, StudyError> {
        let key = stated.key.into_inner();
        let (span, listed) = match (stated.values, stated.range, stated.seeds) {
            (Some(values), None, None) => {
                let wrong = |problem: &str| self.error_at(Some(values.span()), &format!("values of {key}: {problem}"));
                if values.get_ref().is_empty() || values.get_ref().len() > MOST_LISTED {
                    return Err(wrong(&format!("must be from 1 to {MOST_LISTED} of them")));
                }
                let listed: Result<Vec<_>, _> = values.get_ref().iter().map(json).collect();
                (values.span(), listed.map_err(|problem| wrong(&problem))?)
            }
            (None, Some(range), None) => {
                let word =
                    |value: &toml::Value| value.as_float().map_or_else(|| value.to_string(), |v| format!("{v:?}"));
                let listed = evenly(range.get_ref()).ok_or_else(|| {
                    let found: Vec<_> = range.get_ref().iter().map(word).collect();
                    let problem = format!(
                        "range of {key}: must be [from, to, count], two finite numbers that differ and from 2 to {MOST_LISTED} values; found [{:.80}]",
                        found.join(", ")
                    );
                    self.error_at(Some(range.span()), &problem)
                })?;
                (range.span(), listed)
            }
            (None, None, Some(seeds)) => {
                let values = seeds_of(seeds.get_ref(), &key);
                let values =
                    values.map_err(|problem| self.error_at(Some(seeds.span()), &format!("seeds: {problem}")))?;
                return Ok(Axis { key, values });
            }
            _ => {
                let problem = format!("axis of {key}: needs one of values, range and seeds");
                return Err(self.error_at(Some(whole), &problem));
            }
        };
        let mut seen = BTreeSet::new();
        if let Some(twice) = listed.iter().find(|value| !seen.insert(canonical(value))) {
            return Err(self.error_at(Some(span), &format!("values of {key}: {twice} is there twice")));
        }
        let values = Values::Listed(listed);
        Ok(Axis { key, values })
    }

    fn listed_rows(
        &self,
        stated: Vec<Spanned<toml::Table>>,
        bases: &[Base],
    ) -> Result<Vec<BTreeMap<String, Value>>, StudyError> {
        let (mut listed, mut seen) = (Vec::new(), BTreeSet::new());
        for row in stated {
            let wrong = |problem: &str| self.error_at(Some(row.span()), problem);
            let row = flat(row.get_ref(), "").map_err(|problem| wrong(&problem))?;
            let first: &BTreeMap<_, _> = listed.first().unwrap_or(&row);
            if row.is_empty() || !row.keys().eq(first.keys()) {
                return Err(wrong("rows: every row states the same keys, at least one"));
            }
            for (key, value) in &row {
                check_value(bases, key, value, listed.len()).map_err(|problem| wrong(&problem))?;
            }
            if !seen.insert(row.values().map(canonical).collect::<Vec<_>>()) {
                return Err(wrong("rows: this row is there before"));
            }
            listed.push(row);
        }
        Ok(listed)
    }
}

/// A scenario that rows begin from, and its program.
fn base(stated: &ScenarioStatement, folder: &Path) -> Result<(Base, Program), ScenarioError> {
    let (text, folder, place) = match stated {
        ScenarioStatement::Text(stated) => (stated.text.clone(), Some(folder.to_owned()), stated.name.clone()),
        ScenarioStatement::Named(name) => {
            // A file beside the study goes before a shipped name only where it is one: shipped names are no paths.
            let is_shipped = SHIPPED.iter().any(|shipped| shipped.name == name);
            let place = if is_shipped {
                name.clone()
            } else {
                folder.join(name).display().to_string()
            };
            let read = source(&place)?;
            (read.text, read.folder, place)
        }
    };
    let scenario = Draft::new(&text)?.scenario(&place, folder.as_deref())?;
    let name = stated.name().to_owned();
    Ok((Base { name, text, folder }, scenario.job.program))
}

/// Seeds in a row, `FIRST..LAST`.
fn seeds_of(stated: &str, key: &str) -> Result<Values, String> {
    let number = |text: &str| text.trim().parse::<u64>().ok();
    let ends = stated
        .split_once("..")
        .and_then(|(a, b)| Some((number(a)?, number(b)?)));
    let Some((first, last)) = ends.filter(|(first, last)| first <= last && key == "seed") else {
        return Err(format!(
            "must be \"FIRST..LAST\", whole numbers, the first at most the last, with key = \"seed\"; found {stated:?} with {key:?}"
        ));
    };
    check_seed("the last of them", last).map_err(|error| error.to_string())?;
    let count = last - first + 1;
    Ok(Values::Seeds { first, count })
}

/// The values of a range; `None` where it is no range.
fn evenly(stated: &[toml::Value]) -> Option<Vec<Value>> {
    let number = |value: &toml::Value| value.as_float().or_else(|| value.as_integer().map(|v| v as f64));
    let [from, to, count] = stated else {
        return None;
    };
    let (from, to) = (number(from)?, number(to)?);
    let count = usize::try_from(count.as_integer()?).ok()?;
    let is_range = from != to && (to - from).is_finite() && (2..=MOST_LISTED).contains(&count);
    is_range.then(|| spaced(from, to, count))
}

/// Checks that every base has the key, and that the key takes the value. The first two values are tried in the texts, to see that
/// these have a place for the key: one of the two may be there already. The others are checked by themselves, as every change
/// makes the text be read again.
fn check_value(bases: &[Base], key: &str, value: &Value, place: usize) -> Result<(), String> {
    if key == "job.program" && value != "certified" {
        return Err(format!("{key}: a study plans certified jobs; found {value}"));
    }
    if let (Some(base), 2..) = (bases.first(), place) {
        return Draft::check(key, value).map_err(|problem| format!("{}: {problem}", base.name));
    }
    for base in bases {
        let changed = base.changed([(&key.to_owned(), value)]);
        changed.map_err(|problem| format!("{}: {problem}", base.name))?;
    }
    Ok(())
}

/// A row's keys with their sections before them.
fn flat(row: &toml::Table, prefix: &str) -> Result<BTreeMap<String, Value>, String> {
    let mut all = BTreeMap::new();
    for (name, value) in row {
        let path = format!("{prefix}{name}");
        let is_key = KEYS.iter().any(|key| key.path == path);
        match value {
            toml::Value::Table(section) if !is_key => all.extend(flat(section, &format!("{path}."))?),
            value => {
                let value = json(value).map_err(|problem| format!("{name}: {problem}"))?;
                all.insert(path, value);
            }
        }
    }
    Ok(all)
}

fn json(value: &toml::Value) -> Result<Value, String> {
    let is_number = |value: &toml::Value| value.is_integer() || value.is_float();
    Ok(match value {
        toml::Value::String(text) => Value::from(text.as_str()),
        toml::Value::Integer(v) => Value::from(*v),
        toml::Value::Float(v) if v.is_finite() => Value::from(*v),
        toml::Value::Boolean(v) => Value::from(*v),
        toml::Value::Array(values) => values.iter().map(json).collect::<Result<_, _>>()?,
        toml::Value::Table(table) if table.values().all(is_number) => {
            let pairs = table.iter().map(|(name, value)| Ok((name.clone(), json(value)?)));
            Value::Object(pairs.collect::<Result<_, String>>()?)
        }
        other => {
            return Err(format!(
                "must be finite numbers, texts, true, false, lists of them or tables of numbers; found {other}"
            ));
        }
    })
}
