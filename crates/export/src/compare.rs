//! Comparison of a program with the one that was handed over: the changes, and the judgement of the program as it stands.
//!
//! Also here: two texts, line by line; the share of the plan's speed that follows from a program's times, where it states none;
//! the points of a program, by the lines that name them.
//!
//! The program is exported again from its plan with the settings that it states, and both texts are compared line by line. Spaces
//! and the notation of numbers do not count: editors and controllers change them. For a changed line the differences of a point
//! are listed in numbers.

use crate::controller_settings::changed_settings;
use crate::dialect::{self, DIALECTS, Dialect, Points, ProgramFile, ReadError, start_within_deg};
use crate::export::{self, ExportError};
use crate::judgement::{self, ProgramJudgement};
use crate::reading::{ReadPoint, Reading, number_length};
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use crate::tool_frame;
use platewash_certificate::{Certified, ProveError};
use platewash_kinematics::words::distinct_decimals;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::plan::Plan;
use platewash_workcell::words::{shortened, without_mark};
use serde::Serialize;
use similar::{Algorithm, DiffTag, capture_diff_slices};
use std::collections::{HashMap, HashSet};

/// Greatest number of changes that are listed.
const MOST_CHANGES: usize = 20;

/// Relative excess of a program's largest distance from the start that its digits may give.
const DIGITS: f64 = 1e-3;

/// Result of reading a program back and judging it.
#[derive(Debug, Clone, PartialEq)]
pub struct ProgramComparison {
    /// Dialect of the program.
    pub dialect: &'static str,
    /// Differences from the program that was handed over, in the order of its lines; the first of them.
    pub changes: Vec<Change>,
    /// Number of further differences.
    pub more_changes: usize,
    /// Tolerance of the tip about the plan that the program states, otherwise the default \[m\].
    pub tolerance_m: f64,
    /// Proof of the program as it stands.
    pub judgement: ProgramJudgement,
    /// Refusal where the tool that the program states is not the plan's.
    pub tool: Option<Refusal>,
    /// Settings that change the motion and are not those that were handed over: what the proof of the motion does not see.
    pub settings: Vec<Change>,
    /// True where the program refuses to move if the arm stands farther from the start than it may ([`Reading::start_within_deg`]).
    pub checks_start: bool,
}

/// Reason that a program could not be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// No dialect knows it.
    #[error("{name}: no program of {}", dialect::names())]
    Unknown {
        /// The file's name.
        name: String,
    },
    /// The program is of another plan.
    #[error("{name}: the program is of the plan with SHA-256 {found}; the one given has {expected}")]
    OtherPlan {
        /// The file's name.
        name: String,
        /// The plan that the program states.
        found: String,
        /// The plan given.
        expected: String,
    },
    /// The program cannot be interpreted.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A line that states how the program was made cannot be understood.
    #[error("{name}: a line \"platewash setting: …\" was changed to something that cannot be read")]
    Setting {
        /// The file's name.
        name: String,
    },
    /// A program states a greater share of the speed than the one that it was made for.
    #[error(
        "{name}: it states the speed share {found}, and a line \"platewash setting: speed_share = {made}\" that it was made for that: both must \
         say the same"
    )]
    Share {
        /// The file's name.
        name: String,
        /// Share that the program states.
        found: f64,
        /// Share that it was made for.
        made: f64,
    },
    /// The program that was handed over cannot be made again.
    #[error("the program that was handed over cannot be made again: {0}")]
    Again(ExportError),
    /// The motion of the program cannot be judged.
    #[error(transparent)]
    Prove(#[from] ProveError),
}

/// Reads a program back, compares it with the one that was handed over of a certified plan, and judges it as it stands.
///
/// # Errors
/// [`CompareError`] for a text that cannot be interpreted or judged. A program that does not hold is no error.
pub fn compare(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    files: &[ProgramFile],
    cancel: &CancelToken,
) -> Result<ProgramComparison, CompareError> {
    let of = |dialect: &&&'static dyn Dialect| files.iter().any(|file| dialect.is_in(file));
    let unknown = || CompareError::Unknown { name: name(files) };
    let dialect = *DIALECTS.iter().find(of).ok_or_else(unknown)?;
    compare_in(certified, arm, dialect, files, cancel)
}

/// Compares as [`compare`], for a known dialect.
pub(crate) fn compare_in(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    dialect: &dyn Dialect,
    files: &[ProgramFile],
    cancel: &CancelToken,
) -> Result<ProgramComparison, CompareError> {
    refuse_other_plan(certified.plan(), files)?;
    let found = dialect.read(files, arm)?;
    let most_deg = start_within_deg(&certified.plan().job);
    // For a program that states no settings, the share of the speed is the one that it states elsewhere, or follows from its
    // times.
    let told = || speed_share(certified.plan(), &found, dialect.points());
    let otherwise = ExportSettings {
        speed_share: found.speed_share.unwrap_or_else(told),
        ..ExportSettings::default()
    };
    let settings =
        ExportSettings::stated(files, otherwise).ok_or_else(|| CompareError::Setting { name: name(files) })?;
    // A program whose greatest share stands in it is compared by that.
    if let (Some(share), None) = (found.speed_share, found.most_share)
        && share > settings.speed_share * (1.0 + DIGITS)
    {
        return Err(CompareError::Share {
            name: name(files),
            found: share,
            made: settings.speed_share,
        });
    }
    // A text that states no share of the speed runs at the one that it was made with.
    let at_share = |reading: Reading| Reading {
        speed_share: reading.speed_share.or(Some(settings.speed_share)),
        ..reading
    };
    let found = at_share(found);
    let expected = match export::again(certified, arm, dialect, &settings, cancel) {
        Err(ExportError::Prove(error)) => return Err(error.into()),
        other => other.map_err(CompareError::Again)?,
    };
    // Of a program in several files that say the same, the ones that are given.
    let given = |file: &&ProgramFile| {
        files
            .iter()
            .any(|other| same_file(other, &expected.files) == Some(*file))
    };
    let given: Vec<_> = expected.files.iter().filter(given).cloned().collect();
    let said = dialect.read(&given, arm);
    let said = said.map_or_else(|_| expected.reading.clone(), at_share);
    let settings_changed = changed_settings(&found, &said);
    let mut changes = changes((files, &found), (&expected.files, &said));
    let more_changes = changes.len().saturating_sub(MOST_CHANGES);
    changes.truncate(MOST_CHANGES);
    Ok(ProgramComparison {
        dialect: dialect.name(),
        changes,
        more_changes,
        tolerance_m: settings.tolerance_m,
        // One that says nothing else was judged just now, when it was made again.
        judgement: match found == expected.reading {
            true => expected.judgement,
            false => judgement::judge(certified, &found, arm, settings.tolerance_m, cancel)?,
        },
        checks_start: found
            .start_within_deg
            .is_some_and(|within_deg| within_deg <= most_deg * (1.0 + DIGITS)),
        settings: settings_changed,
        tool: tool_frame::refusal(
            found.tool.as_ref(),
            said.tool.as_ref(),
            &certified.plan().job.workcell.tool,
        ),
    })
}

fn name(files: &[ProgramFile]) -> String {
    files
        .first()
        .map_or_else(|| "program".to_owned(), |file| file.name.clone())
}

/// Refuses a program that states the hash of another plan.
fn refuse_other_plan(plan: &Plan, files: &[ProgramFile]) -> Result<(), CompareError> {
    let Some(expected) = &plan.hash else { return Ok(()) };
    for file in files {
        // The hash may stand on a line of its own, behind the sign of a comment.
        let mut words = file.text.split_whitespace().skip_while(|word| *word != "plan").skip(1);
        let stated = words.next() == Some("sha256:");
        let is_hash = |word: &&str| word.len() == expected.len() && word.bytes().all(|c| c.is_ascii_hexdigit());
        let found = words.take(2).find(is_hash).filter(|found| stated && found != expected);
        if let Some(found) = found {
            return Err(CompareError::OtherPlan {
                name: file.name.clone(),
                found: found.to_owned(),
                expected: expected.clone(),
            });
        }
    }
    Ok(())
}

impl ProgramComparison {
    /// Returns true where nothing was changed but spaces and the notation of numbers.
    #[must_use]
    pub fn is_unchanged(&self) -> bool {
        self.changes.is_empty()
    }

    /// Returns true where the motion of the program holds under every assumption, with the tool of the plan and the settings that were
    /// handed over.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.tool.is_none() && self.settings.is_empty() && self.judgement.holds()
    }
}

/// Greatest number of characters of a line that are shown.
const TOLD: usize = 80;

/// Something that a program says otherwise than the one that was handed over.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Change {
    /// File and line, as `FILE:LINE`; of a line that is missing the one before it.
    pub place: String,
    /// Subject of the change, e.g. `joint 3`.
    pub what: String,
    /// Value in the line.
    pub found: String,
    /// Value that was handed over.
    pub expected: String,
}

/// A program: its files and its reading.
type ParsedProgram<'a> = (&'a [ProgramFile], &'a Reading);

/// Lists the differences between the lines of two programs.
pub(crate) fn changes(found: ParsedProgram<'_>, expected: ParsedProgram<'_>) -> Vec<Change> {
    let steps = [found, expected].map(|(_, reading)| by_line(reading));
    let rounding_s = rounding_s(found.1, expected.1);
    let mut all = Vec::new();
    for file in found.0 {
        let expected = same_file(file, expected.0);
        let in_order = expected.and_then(|expected| in_columns_of(&file.text, &expected.text));
        let in_order = in_order.map(|text| ProgramFile {
            name: file.name.clone(),
            text,
        });
        let texts = Texts {
            found: in_order.as_ref().unwrap_or(file),
            expected,
            steps: &steps,
            rounding_s,
        };
        texts.changes(&mut all);
    }
    all
}

/// The file of a program that another file is: of those of its kind, or else of all, the one with the most equal lines, and of several the one of
/// its name. A new name is no change.
fn same_file<'a>(file: &ProgramFile, expected: &'a [ProgramFile]) -> Option<&'a ProgramFile> {
    let kind = |name: &str| match name.rsplit_once('.').map(|(_, kind)| kind.to_ascii_lowercase()) {
        Some(kind) if kind == "yml" => Some("yaml".to_owned()),
        kind => kind,
    };
    let lines: HashSet<&str> = file.text.lines().map(str::trim_end).collect();
    let alike = |other: &&ProgramFile| {
        let count = other.text.lines().filter(|line| lines.contains(line)).count();
        (count, other.name == file.name)
    };
    let of_kind = expected.iter().filter(|other| kind(&other.name) == kind(&file.name));
    of_kind.max_by_key(alike).or_else(|| expected.iter().max_by_key(alike))
}

/// The text of a table with its columns in the order of another one; `None` where it is no table of the same columns, or has them so.
fn in_columns_of(found: &str, expected: &str) -> Option<String> {
    let cells = |line: &str| {
        line.trim_end()
            .split(',')
            .map(|cell| cell.trim().to_owned())
            .collect::<Vec<_>>()
    };
    let [found_names, names] = [found, expected].map(|text| without_mark(text).lines().next().map(cells));
    let (found_names, names) = (found_names?, names?);
    let places: Option<Vec<usize>> = names
        .iter()
        .map(|name| found_names.iter().position(|other| other == name))
        .collect();
    let places = places.filter(|_| found_names.len() == names.len() && found_names != names)?;
    let row = |line: &str| {
        let cells = cells(line);
        let moved: Option<Vec<&str>> = places
            .iter()
            .map(|place| cells.get(*place).map(String::as_str))
            .collect();
        moved.map_or_else(|| line.to_owned(), |moved| moved.join(","))
    };
    Some(found.lines().map(row).collect::<Vec<_>>().join("\n"))
}

/// One file beside the one that was handed over.
struct Texts<'a> {
    found: &'a ProgramFile,
    expected: Option<&'a ProgramFile>,
    steps: &'a [HashMap<(&'a str, usize), Vec<Step<'a>>>; 2],
    rounding_s: f64,
}

/// A line with contents: its number, from 1, its text as it stands, and its text without the parts that do not count.
struct Line<'a> {
    number: usize,
    text: &'a str,
    plain: String,
}

impl Texts<'_> {
    fn changes(&self, all: &mut Vec<Change>) {
        let found = lines(&self.found.text);
        let expected = self.expected.map_or_else(Vec::new, |file| lines(&file.text));
        let [old, new] = [&expected, &found].map(|lines| lines.iter().map(|line| &line.plain).collect::<Vec<_>>());
        for difference in capture_diff_slices(Algorithm::Myers, &old, &new) {
            let (tag, old, new) = difference.as_tag_tuple();
            if tag == DiffTag::Equal {
                continue;
            }
            let last = found[..new.end].last().map_or(1, |line| line.number);
            let (old, new) = (&expected[old], &found[new]);
            let both = old.len().min(new.len());
            old.iter().zip(new).for_each(|(old, new)| self.changed(new, old, all));
            all.extend(new[both..].iter().map(|line| {
                let nothing = "no such line".to_owned();
                self.change(line.number, "line", shown_line(line.text), nothing)
            }));
            all.extend(old[both..].iter().map(|line| {
                let missing = shown_line(line.text);
                self.change(last, "line that is missing behind it", String::new(), missing)
            }));
        }
    }

    /// Lists the changes of a line that replaces another one: the differences of its points, or the other line.
    fn changed(&self, new: &Line<'_>, old: &Line<'_>, all: &mut Vec<Change>) {
        let [found, expected] = self.steps;
        let found = found.get(&(self.found.name.as_str(), new.number));
        let expected = self
            .expected
            .and_then(|file| expected.get(&(file.name.as_str(), old.number)));
        let points = found
            .zip(expected)
            .into_iter()
            .flat_map(|(found, expected)| found.iter().zip(expected));
        let told_before = all.len();
        for (what, found, expected) in points.flat_map(|(a, b)| a.differences(b, self.rounding_s)) {
            all.push(self.change(new.number, &what, found, expected));
        }
        if all.len() == told_before {
            all.push(self.change(new.number, "line", shown_line(new.text), shown_line(old.text)));
        }
    }

    fn change(&self, line: usize, what: &str, found: String, expected: String) -> Change {
        Change {
            place: format!("{}:{line}", self.found.name),
            what: what.to_owned(),
            found,
            expected,
        }
    }
}

/// The lines of a text that say something.
fn lines(text: &str) -> Vec<Line<'_>> {
    let line = |(i, text)| Line {
        number: i + 1,
        text,
        plain: plain(text),
    };
    let all = text.trim_start_matches('\u{feff}').lines().enumerate().map(line);
    all.filter(|line| !line.plain.is_empty()).collect()
}

/// A line without spaces that say nothing, its numbers in one spelling: 9E9 is 9E+09, and 0.5000 is 0.5.
fn plain(text: &str) -> String {
    let is_word = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.trim();
    while let Some(c) = rest.chars().next() {
        if c.is_whitespace() {
            rest = rest.trim_start();
            // Two words, or two numbers, are not one.
            if plain.ends_with(is_word) && rest.starts_with(is_word) {
                plain.push(' ');
            }
            continue;
        }
        let length = if plain.ends_with(is_word) {
            0
        } else {
            number_length(rest)
        };
        let taken = length.max(c.len_utf8());
        match rest[..length].parse::<f64>() {
            Ok(number) => plain.push_str(&number.to_string()),
            Err(_) => plain.push_str(&rest[..taken]),
        }
        rest = &rest[taken..];
    }
    plain
}

/// A line for display: without spaces around it, and not too long.
fn shown_line(text: &str) -> String {
    shortened(text.trim(), TOLD)
}

/// Shares are rounded to steps of one over this number.
const STEPS: f64 = 1e6;

/// Least share that is accepted.
const LEAST: f64 = 1e-3;

/// Steps of the search, each of which squares the error.
const ROUNDS: usize = 8;

/// The share of the plan's speed at which a program runs, by its times.
pub(crate) fn speed_share(plan: &Plan, found: &Reading, points: Points) -> f64 {
    let share = match points {
        Points::Knots if found.points.len() == plan.knots.t_s.len() => of_knots(plan, found),
        Points::Steps { .. } => of_rows(plan, found),
        _ => of_duration(plan, found),
    };
    let share = (share * STEPS).round() / STEPS;
    if (LEAST..=1.0).contains(&share) { share } else { 1.0 }
}

/// Share of a program with all the plan's knots: the median over the knots, so that a time that was changed does not count.
fn of_knots(plan: &Plan, found: &Reading) -> f64 {
    let both = plan.knots.t_s.iter().zip(&found.points).skip(1);
    let mut shares: Vec<_> = both.map(|(plan_s, point)| plan_s / point.t_s).collect();
    shares.sort_unstable_by(f64::total_cmp);
    shares.get(shares.len() / 2).copied().unwrap_or(1.0)
}

fn of_duration(plan: &Plan, found: &Reading) -> f64 {
    plan.duration_s() / found.points.last().map_or(0.0, |point| point.t_s)
}

/// Share of a program of rows at even steps, the last of which is up to a step after the plan's end: the share at which the rows
/// are nearest to the plan, in the sense of least squares.
fn of_rows(plan: &Plan, found: &Reading) -> f64 {
    let least = of_duration(plan, found);
    let ([.., before, _], Ok(motion)) = (found.points.as_slice(), plan.knots.motion()) else {
        return least;
    };
    let most = (plan.duration_s() / before.t_s).min(1.0).max(least);
    (0..ROUNDS).fold(least, |share, _| {
        let (mut off, mut slope) = (0.0, 0.0);
        for row in &found.points {
            if let Some(state) = motion.at(share * row.t_s) {
                let moves = state.qd * row.t_s;
                off += (row.q_rad - state.q).dot(&moves);
                slope += moves.norm_squared();
            }
        }
        match slope > 0.0 {
            true => (share + off / slope).clamp(least, most),
            // An arm that does not move gives no information.
            false => share,
        }
    })
}

/// Differences that count as rounding: of angles and their speeds \[rad, rad/s\], and of lengths \[m\].
const ROUNDING: (f64, f64) = (1e-12, 1e-9);

/// Differences that count as rounding of a step computed from sums of times \[s\]: between programs that run at the same share of
/// the speed, and at different ones.
const ROUNDING_S: [f64; 2] = [1e-10, 2e-7];

/// A point, with speeds and the time since the point before in the plan's time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step<'a> {
    point: &'a ReadPoint,
    /// \[s\]
    lasts_s: f64,
    /// \[rad/s\]
    qd_rad_s: Option<JointVector>,
}

/// Difference that counts as rounding between the steps of two programs \[s\].
pub(crate) fn rounding_s(a: &Reading, b: &Reading) -> f64 {
    ROUNDING_S[usize::from(a.share() != b.share())]
}

/// The points that each line names, in order; lines by file and number.
pub(crate) fn by_line(reading: &Reading) -> HashMap<(&str, usize), Vec<Step<'_>>> {
    let share = reading.share();
    let mut before_s = 0.0;
    let mut all: HashMap<_, Vec<_>> = HashMap::new();
    for point in &reading.points {
        let step = Step {
            point,
            lasts_s: (point.t_s - before_s) * share,
            qd_rad_s: point.qd_rad_s.map(|qd| qd / share),
        };
        before_s = point.t_s;
        let place = &point.place;
        all.entry((place.file.as_str(), place.line)).or_default().push(step);
    }
    all
}

impl Step<'_> {
    /// Returns the differences, as name, found and expected.
    pub fn differences(&self, other: &Self, most_s: f64) -> Vec<(String, String, String)> {
        let (most_rad, most_m) = ROUNDING;
        let mut all = Vec::new();
        let mut tell = |what: String, [a, b]: [f64; 2], most: f64, (decimals, unit): (usize, &str)| {
            if a.is_nan() || (a - b).abs() > most {
                let [a, b] = distinct_decimals(a, b, decimals);
                all.push((what, format!("{a} {unit}"), format!("{b} {unit}")));
            }
        };
        for j in 0..AXES {
            let most_deg = most_rad.to_degrees();
            let joint = format!("joint {}", j + 1);
            let speeds = self.qd_rad_s.zip(other.qd_rad_s);
            let speeds = speeds.map(|(a, b)| [a[j], b[j]].map(f64::to_degrees));
            let positions = [self, other].map(|step| step.point.q_rad[j].to_degrees());
            tell(joint.clone(), positions, most_deg, (4, "deg"));
            if let Some(speeds) = speeds {
                tell(format!("speed of {joint}"), speeds, most_deg, (4, "deg/s"));
            }
        }
        tell("time".to_owned(), [self.lasts_s, other.lasts_s], most_s, (6, "s"));
        let corners = [self, other].map(|step| step.point.corner_m);
        let is_same = match corners {
            [Some(a), Some(b)] => (a - b).abs() <= most_m,
            [a, b] => a.is_none() == b.is_none(),
        };
        if !is_same {
            let told = |corner: Option<f64>| corner.map_or_else(|| "stop".to_owned(), |m| format!("{} mm", 1e3 * m));
            let [a, b] = corners.map(told);
            all.push(("corner".to_owned(), a, b));
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::plain;

    #[test]
    fn comparison_ignores_spaces_and_spellings_of_numbers() {
        for (a, b) in [
            ("MoveAbsJ [[1.0000,-0.50],[9E9]]", "  MoveAbsJ [ [1,-0.5],[9E+09] ]\t"),
            ("\\T:=0.030898/pwShare", "\\T:=3.0898e-2 / pwShare"),
            ("joint_1: 1.0", "joint_1: 1"),
            ("1.0\t5.0E-03", "1 0.005"),
            (".5,e5", "0.5 , e5"),
        ] {
            assert_eq!(plain(a), plain(b));
        }
        for (a, b) in [
            ("joint_1", "joint_01"),
            ("v100", "v0100"),
            ("1.5", "15"),
            ("z5", "z50"),
            ("1e", "1"),
            ("a1.0", "a1"),
            ("0.1 2", "0.12"),
            ("RETURN x", "RETURNx"),
            ("e5", "e05"),
        ] {
            assert_ne!(plain(a), plain(b));
        }
    }
}
