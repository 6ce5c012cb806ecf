//! Comparison of a program with the one that was handed over: the changes, and the judgement of the program as it stands.
//!
//! The program is exported again from its plan with the settings that it states, and both texts are compared line by line. Spaces
//! and the notation of numbers do not count: editors and controllers change them. For a changed line the differences of a point
//! are listed in numbers.

use crate::changes::Change;
use crate::changes::changes;
use crate::changes::same_file;
use crate::controller_settings::changed_settings;
use crate::dialect::{self, DIALECTS, Dialect, ReadError, start_within_deg};
use crate::export::{self, ExportError};
use crate::judgement::{self, ProgramJudgement};
use crate::program::ProgramFile;
use crate::reading::{ReadPoint, Reading};
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use crate::speed_share::speed_share;
use crate::tool_frame;
use platewash_certificate::{Certified, ProveError};
use platewash_kinematics::words::distinct_decimals;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_workcell::cancel::CancelToken;
use std::collections::HashMap;

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
