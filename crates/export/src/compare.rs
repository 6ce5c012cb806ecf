//! Comparison of a program with the one that was handed over: the changes, and the judgement of the program as it stands.
//!
//! The program is exported again from its plan with the settings that it states, and both texts are compared line by line. Spaces
//! and the notation of numbers do not count: editors and controllers change them. For a changed line the differences of a point
//! are listed in numbers.

use crate::changed_settings::changed_settings;
use crate::changes::{Change, changes, same_file};
use crate::dialect::language::Dialect;
use crate::dialect::start_within::start_within_deg;
use crate::dialects::{self, DIALECTS};
use crate::export::{self, ExportError};
use crate::judgement::{self, ProgramJudgement};
use crate::program::ProgramFile;
use crate::reading::Reading;
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use crate::speed_share::speed_share;
use crate::tool_frame;
use platewash_certificate::{Certified, ProveError};
use platewash_kinematics::RobotModel;
use platewash_motion::plan::Plan;
use platewash_motion_proof::ReadError;
use platewash_workcell::cancel::CancelToken;

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
    #[error("{name}: no program of {}", dialects::names())]
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
