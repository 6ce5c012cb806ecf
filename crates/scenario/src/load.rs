//! From a file or a shipped name to a checked [`Scenario`].

use crate::error::{Problem, ScenarioError};
use crate::job::Program;
use crate::keys::{Domain, KEYS, Key};
use crate::scenario::Scenario;
use crate::seed::check_seed;
use crate::shipped::SHIPPED;
use platewash_kinematics::urdf::file::{self, FileError};
use platewash_kinematics::words::rounded;
use platewash_workcell::job::OrderRule;
use platewash_workcell::words::printable;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Significant digits of a length that is suggested.
const METRE_DIGITS: usize = 6;

/// Longest file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 20;

impl Scenario {
    /// Reads a scenario: a shipped name (`paper-appendix`), or a file. Paths in a file are taken
    /// relative to its folder.
    ///
    /// # Errors
    /// [`ScenarioError`] with the file, line, key, what was expected and what was found.
    pub fn load(name_or_file: &str) -> Result<Self, ScenarioError> {
        if let Some(shipped) = SHIPPED.iter().find(|s| s.name == name_or_file) {
            return Self::parse(shipped.text, shipped.name);
        }
        let fail = |problem| ScenarioError::new(name_or_file, None, problem);
        let path = Path::new(name_or_file);
        if !path.exists() {
            let shipped: Vec<_> = SHIPPED.iter().map(|s| s.name).collect();
            let shipped = shipped.join(", ");
            return Err(fail(Problem::NotFound { shipped }));
        }
        let text = file::read_text(path, MAX_BYTES).map_err(|e| fail(unread(e)))?;
        let mut scenario = Self::parse(&text, name_or_file)?;
        scenario.resolve_paths(path.parent().unwrap_or(Path::new("")));
        Ok(scenario)
    }

    /// Reads a scenario from TOML text; `source_name` appears in errors.
    ///
    /// # Errors
    /// As [`Scenario::load`].
    pub fn parse(text: &str, source_name: &str) -> Result<Self, ScenarioError> {
        let syntax = |e: toml::de::Error| {
            let line = e.span().map(|span| line_at(text, span.start));
            let detail = e.message().to_owned();
            ScenarioError::new(source_name, line, Problem::Syntax { detail })
        };
        let table = DeTable::parse(text).map_err(syntax)?;
        check_table(table.get_ref(), "").map_err(|(at, problem)| {
            let line = Some(line_at(text, at));
            ScenarioError::new(source_name, line, problem)
        })?;
        let scenario: Self = toml::from_str(text).map_err(syntax)?;
        scenario
            .check_conflicts()
            .map_err(|problem| ScenarioError::new(source_name, None, problem))?;
        Ok(scenario)
    }

    /// Checks a scenario that was built in code: every range, and keys that contradict each other.
    ///
    /// # Errors
    /// As [`Scenario::load`], without a line.
    pub fn validate(&self) -> Result<(), ScenarioError> {
        let syntax = |detail: String| ScenarioError::new(&self.name, None, Problem::Syntax { detail });
        // TOML does not know the upper half of this type.
        check_seed("seed", self.seed).map_err(|problem| ScenarioError::new(&self.name, None, problem))?;
        let text = toml::to_string(self).map_err(|e| syntax(e.to_string()))?;
        Self::parse(&text, &self.name)
            .map(|_| ())
            .map_err(|e| ScenarioError { line: None, ..e })
    }

    fn resolve_paths(&mut self, folder: &Path) {
        let files = [&mut self.robot.urdf, &mut self.robot.srdf].into_iter().flatten();
        for path in files.chain(&mut self.robot.package_path) {
            *path = folder.join(&*path);
        }
    }

    fn check_conflicts(&self) -> Result<(), Problem> {
        let conflict = |keys: &str, detail: String| {
            let keys = keys.to_owned();
            Err(Problem::Conflict { keys, detail })
        };
        let (layout, tool) = (&self.layout, &self.tool);
        let ranges = [layout.x_m, layout.y_m, layout.rho_m, layout.azimuth_deg];
        if layout.region.is_some() && ranges.iter().any(Option::is_some) {
            return conflict(
                "layout.region",
                "give either a named region or ranges (x_m, y_m, rho_m, azimuth_deg)".into(),
            );
        }
        if layout.azimuth_deg.is_some_and(|[from, to]| to - from > 360.0) {
            return conflict("layout.azimuth_deg", "the range is more than a turn wide".into());
        }
        let bounded =
            layout.region.is_some() || layout.rho_m.is_some() || (layout.x_m.is_some() && layout.y_m.is_some());
        if layout.positions_m.is_none() && !bounded {
            return conflict(
                "layout",
                "no region to sample from: give region, or x_m and y_m, or rho_m, or positions_m".into(),
            );
        }
        if tool.length_m > 0.0 && tool.sponge_height_m >= tool.length_m {
            let (sponge, length) = (tool.sponge_height_m, tool.length_m);
            return conflict(
                "tool.sponge_height_m",
                format!("must be below tool.length_m = {length}; found {sponge}"),
            );
        }
        if self.robot.urdf.is_none() && (self.robot.srdf.is_some() || !self.robot.package_path.is_empty()) {
            return conflict(
                "robot.urdf",
                "robot.srdf and robot.package_path need a robot.urdf".into(),
            );
        }
        if self.job.program == Program::Paper && self.job.order == OrderRule::Fastest {
            return conflict(
                "job.order",
                "\"fastest\" is for job.program = \"certified\"; the paper's program knows \"nearest\" and \"given\""
                    .into(),
            );
        }
        self.check_control()?;
        self.check_certified()?;
        self.check_waypoints()
    }
}

impl Scenario {
    /// Gains come in pairs, and the paper's program needs a law without a plant.
    fn check_control(&self) -> Result<(), Problem> {
        let control = &self.control;
        let conflict = |keys: &str, detail: String| {
            let keys = keys.to_owned();
            Err(Problem::Conflict { keys, detail })
        };
        if control.joint_kp.is_some() != control.joint_kd.is_some() {
            return conflict("control.joint_kp", "give both joint_kp and joint_kd, or neither".into());
        }
        if self.job.program == Program::Paper && !self.law().is_kinematic() {
            let detail = format!(
                "\"{}\" drives the torques of a plant; following waypoints, as the paper's program does, needs \"paper\" or \"exact\"",
                self.law().name()
            );
            return conflict("control.law", detail);
        }
        Ok(())
    }
}

fn unread(error: FileError) -> Problem {
    match error {
        FileError::TooLong { limit } => Problem::TooLarge { limit },
        other => Problem::Unreadable {
            detail: other.to_string(),
        },
    }
}

type Misfit = (usize, Problem);

fn check_table(table: &DeTable<'_>, prefix: &str) -> Result<(), Misfit> {
    for (name, value) in table {
        let path = format!("{prefix}{}", name.get_ref());
        let inside = format!("{path}.");
        let is_section = KEYS.iter().any(|k| k.path.starts_with(&inside));
        match (KEYS.iter().find(|k| k.path == path), value.get_ref()) {
            (Some(key), _) => check_value(key, value)?,
            (None, DeValue::Table(section)) if is_section => check_table(section, &inside)?,
            (None, found) if is_section => {
                let found = describe(found);
                let expected = format!("a section: write [{path}]");
                return Err((
                    value.span().start,
                    Problem::Value {
                        key: path,
                        expected,
                        found,
                    },
                ));
            }
            _ => return Err((name.span().start, unknown(path))),
        }
    }
    Ok(())
}

fn unknown(key: String) -> Problem {
    let ranked = KEYS
        .iter()
        .map(|k| (strsim::normalized_damerau_levenshtein(k.path, &key), k.path));
    let nearest = ranked
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .filter(|(likeness, _)| *likeness > 0.6);
    Problem::UnknownKey {
        key: printable(&key),
        nearest: nearest.map(|(_, path)| path.to_owned()),
    }
}

fn check_value(key: &Key, value: &Spanned<DeValue<'_>>) -> Result<(), Misfit> {
    if fits(key.domain, value.get_ref()) {
        return Ok(());
    }
    let problem = Problem::Value {
        key: key.path.to_owned(),
        expected: key.domain.describe(),
        found: describe(value.get_ref()) + &in_millimetres(key, value.get_ref()),
    };
    Err((value.span().start, problem))
}

/// Whether a value lies in the domain; NaN and infinity never do.
fn fits(domain: Domain, value: &DeValue<'_>) -> bool {
    let text = value.as_str().is_some_and(|s| !s.trim().is_empty());
    match domain {
        Domain::Text => text && !value.as_str().is_some_and(|s| s.contains(char::is_control)),
        Domain::Path => text,
        Domain::Paths => elements(value).is_some_and(|all| all.iter().all(|v| v.as_str().is_some())),
        Domain::Word(words) => value.as_str().is_some_and(|s| words.contains(&s)),
        Domain::Bool => matches!(value, DeValue::Boolean(_)),
        Domain::Integer(least, most) => integer(value).is_some_and(|v| (least..=most).contains(&v)),
        Domain::Number(least, most) => number(value).is_some_and(|v| (least..=most).contains(&v)),
        Domain::NumberAbove(above, most) => number(value).is_some_and(|v| v > above && v <= most),
        Domain::Range(least, most) => {
            numbers(value).is_some_and(|v| matches!(v[..], [a, b] if least <= a && a < b && b <= most))
        }
        Domain::Joints(least, most) => six(value, |v| (least..=most).contains(&v)),
        Domain::JointsAbove(above, most) => six(value, |v| v > above && v <= most),
        Domain::Points(least, most) => elements(value).is_some_and(|points| {
            let fine = |p: &&DeValue<'_>| {
                numbers(p).is_some_and(|v| v.len() == 2 && v.iter().all(|c| (least..=most).contains(c)))
            };
            (1..=1000).contains(&points.len()) && points.iter().all(fine)
        }),
    }
}

/// What is said of a length that fits where it was meant in millimetres.
fn in_millimetres(key: &Key, value: &DeValue<'_>) -> String {
    let meant = number(value).map(|v| rounded(1e-3 * v, METRE_DIGITS));
    let fits = |metres: f64| match key.domain {
        Domain::Number(least, most) => (least..=most).contains(&metres),
        Domain::NumberAbove(above, most) => metres > above && metres <= most,
        _ => false,
    };
    match meant {
        Some(metres) if key.unit == "m" && fits(metres) => {
            format!(" (metres are expected; {metres} if millimetres were meant)")
        }
        _ => String::new(),
    }
}

fn six(value: &DeValue<'_>, fine: impl Fn(f64) -> bool) -> bool {
    numbers(value).is_some_and(|v| v.len() == 6 && v.into_iter().all(fine))
}

fn elements<'a, 'i>(value: &'a DeValue<'i>) -> Option<Vec<&'a DeValue<'i>>> {
    value
        .as_array()
        .map(|array| array.iter().map(Spanned::get_ref).collect())
}

fn numbers(value: &DeValue<'_>) -> Option<Vec<f64>> {
    elements(value)?.into_iter().map(number).collect()
}

fn number(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(_) => integer(value).map(|v| v as f64),
        _ => None,
    }
}

fn integer(value: &DeValue<'_>) -> Option<i64> {
    value
        .as_integer()
        .and_then(|i| i64::from_str_radix(i.as_str(), i.radix()).ok())
}

fn describe(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("\"{}\"", printable(text)),
        DeValue::Integer(integer) => integer.to_string(),
        DeValue::Float(float) => float.to_string(),
        DeValue::Boolean(boolean) => boolean.to_string(),
        DeValue::Datetime(datetime) => datetime.to_string(),
        DeValue::Array(array) => {
            let few: Vec<_> = array.iter().take(8).map(|v| describe(v.get_ref())).collect();
            let more = if array.len() > 8 { ", …" } else { "" };
            format!("[{}{more}]", few.join(", "))
        }
        DeValue::Table(_) => "a section".to_owned(),
    }
}

fn line_at(text: &str, byte: usize) -> usize {
    1 + text.as_bytes()[..byte.min(text.len())]
        .iter()
        .filter(|b| **b == b'\n')
        .count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn control_characters_reach_no_terminal() {
        for text in [
            "name = \"a\\u001b[31m\"\n",
            "\"k\\u001b[2J\" = 1\n",
            "seed = \"\\u0007\"\n",
        ] {
            let message = Scenario::parse(text, "case").unwrap_err().to_string();
            assert!(!message.contains(char::is_control), "{message:?}");
            assert!(message.contains("\\u{"), "{message:?}");
        }
    }

    #[test]
    fn lengths_in_millimetres_are_refused_with_their_metres() {
        let refused = |line: &str| Scenario::parse(line, "case").unwrap_err().to_string();
        for (line, metres) in [
            (
                "layout.plate_radius_m = 145",
                "; found 145 (metres are expected; 0.145 if",
            ),
            ("tool.length_m = 150.5", "; found 150.5 (metres are expected; 0.1505 if"),
        ] {
            let message = refused(line);
            assert!(message.contains(metres), "{message}");
        }
        for line in [
            "layout.plate_radius_m = -0.145",
            "layout.plate_radius_m = 1e300",
            "wash.turns = -1",
        ] {
            let message = refused(line);
            assert!(!message.contains("millimetres"), "{message}");
        }
    }

    #[test]
    fn only_regular_files_of_sensible_length_are_read() {
        let folder = std::env::temp_dir().join(format!("platewash-load-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let path = folder.join("long.toml");
        std::fs::write(&path, " ".repeat(MAX_BYTES as usize + 1)).unwrap();
        let problem = |path: &Path| Scenario::load(&path.to_string_lossy()).unwrap_err().problem;
        assert_eq!(problem(&path), Problem::TooLarge { limit: MAX_BYTES });
        assert!(problem(&folder).to_string().contains("not a regular file"));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
