//! A program that was handed over and may have been changed since: what changed, and whether it still holds.
//!
//! The program is made again of its plan with the settings that it states, and both texts are compared line by line. Spaces, and how a
//! number is written, do not count: editors and controllers change them. What a changed line says otherwise of a point is told in numbers.

mod lines;
mod share;
mod steps;

pub use lines::Change;

use crate::dialect::{Dialect, ReadError};
use crate::dialects::{self, DIALECTS};
use crate::export::{self, ExportError};
use crate::file::ProgramFile;
use crate::judged::{self, Judged};
use crate::reading::Reading;
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use platewash_certificate::{Certified, ProveError};
use platewash_kinematics::RobotModel;
use platewash_workcell::cancel::CancelToken;
use platewash_workcell::plan::Plan;

/// Changes that are listed; more would help nobody.
const MOST_CHANGES: usize = 20;

/// What came of a program that was read back.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// Its dialect.
    pub dialect: &'static str,
    /// What it says otherwise than the program that was handed over, in the order of its lines; the first of them.
    pub changes: Vec<Change>,
    /// How many more there are.
    pub more_changes: usize,
    /// How far its tip may be from the plan, as the program states it; otherwise what is usual \[m\].
    pub tolerance_m: f64,
    /// What is proved of it as it stands.
    pub judged: Judged,
    /// That the tool that it states is not the plan's.
    pub tool: Option<Refusal>,
    /// Whether the program refuses to move where the arm does not stand at the start ([`Reading::checks_start`]).
    pub checks_start: bool,
}

/// Why a program could not be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// No dialect knows it.
    #[error("{name}: no program of {}", dialects::names())]
    Unknown {
        /// The file's name.
        name: String,
    },
    /// It is of another plan.
    #[error("{name}: the program is of the plan with SHA-256 {found}; the one given has {expected}")]
    OtherPlan {
        /// The file's name.
        name: String,
        /// The plan that the program states.
        found: String,
        /// The plan given.
        expected: String,
    },
    /// It cannot be interpreted.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A line that states how the program was made cannot be understood.
    #[error("{name}: a line \"platewash setting: …\" was changed to something that cannot be read")]
    Setting {
        /// The file's name.
        name: String,
    },
    /// The program that was handed over cannot be made again.
    #[error("the program that was handed over cannot be made again: {0}")]
    Again(ExportError),
    /// Its motion cannot be judged.
    #[error(transparent)]
    Prove(#[from] ProveError),
}

/// Reads a program back, compares it with the one that was handed over of a certified plan, and judges it as it stands.
///
/// # Errors
/// [`CompareError`] for a text that cannot be interpreted or judged. One that does not hold is no error.
pub fn compare(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    files: &[ProgramFile],
    cancel: &CancelToken,
) -> Result<Compared, CompareError> {
    let of = |dialect: &&&'static dyn Dialect| files.iter().any(|file| dialect.is_in(file));
    let unknown = || CompareError::Unknown { name: name(files) };
    let dialect = *DIALECTS.iter().find(of).ok_or_else(unknown)?;
    compare_in(certified, arm, (dialect, files), cancel)
}

/// [`compare`] for a dialect that is known.
pub(crate) fn compare_in(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    (dialect, files): (&dyn Dialect, &[ProgramFile]),
    cancel: &CancelToken,
) -> Result<Compared, CompareError> {
    refuse_other_plan(certified.plan(), files)?;
    let found = dialect.read(files, arm)?;
    // Of a program that states no settings the share of the speed is the one that it says otherwise, or that its times tell.
    let told = || share::told(certified.plan(), &found, dialect.points());
    let otherwise = ExportSettings {
        speed_share: found.speed_share.unwrap_or_else(told),
        ..ExportSettings::default()
    };
    let mut texts = files.iter().map(|file| &file.text);
    let settings = texts.try_fold(otherwise, |settings, text| ExportSettings::stated(text, settings));
    let settings = settings.ok_or_else(|| CompareError::Setting { name: name(files) })?;
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
    let given = |file: &&ProgramFile| files.iter().any(|other| other.name == file.name);
    let given: Vec<_> = expected.files.iter().filter(given).cloned().collect();
    let said = dialect.read(&given, arm);
    let said = said.map_or_else(|_| expected.reading.clone(), at_share);
    let mut changes = lines::changes((files, &found), (&expected.files, &said));
    let more_changes = changes.len().saturating_sub(MOST_CHANGES);
    changes.truncate(MOST_CHANGES);
    Ok(Compared {
        dialect: dialect.name(),
        changes,
        more_changes,
        tolerance_m: settings.tolerance_m,
        // One that says nothing else was judged just now, when it was made again.
        judged: match found == expected.reading {
            true => expected.judged,
            false => judged::judge(certified, &found, arm, settings.tolerance_m, cancel)?,
        },
        checks_start: found.checks_start,
        tool: found
            .tool
            .and_then(|tool| tool.refusal(&certified.plan().job.workcell.tool)),
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

impl Compared {
    /// Whether nothing was changed but spaces and how numbers are written.
    #[must_use]
    pub fn is_unchanged(&self) -> bool {
        self.changes.is_empty()
    }

    /// Whether what the program does holds, under every assumption, with the tool of the plan.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.tool.is_none() && self.judged.holds()
    }
}
