//! A language of robot programs. Another one is one file, one fixture and one line in `dialects.rs`.

use crate::file::{Place, ProgramFile};
use crate::program::Program;
use crate::reading::Reading;
use crate::refusal::Refusal;
use platewash_kinematics::RobotModel;
use platewash_workcell::job::JobTerms;
use std::fmt::Debug;

/// A language of robot programs.
pub trait Dialect: Debug + Sync {
    /// Its name on the command line, e.g. `rapid`.
    fn name(&self) -> &'static str;

    /// Whether a file is a program of this dialect, by its name and text.
    fn is_in(&self, file: &ProgramFile) -> bool;

    /// Which points of a plan it is given.
    fn points(&self) -> Points;

    /// What it assumes of the controller, and what nobody has tried on one; a sentence an entry.
    fn assumptions(&self) -> &'static [&'static str];

    /// Refuses a job that it cannot be handed over for: another make of arm, a tool without a mass.
    ///
    /// # Errors
    /// [`Refusal`].
    fn accepts(&self, job: &JobTerms, arm: &RobotModel) -> Result<(), Refusal>;

    /// The program's text. The same program gives the same bytes.
    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile>;

    /// What a text does, interpreted; a text that this program did not write, too.
    ///
    /// # Errors
    /// [`ReadError`], with the line.
    fn read(&self, files: &[ProgramFile], arm: &RobotModel) -> Result<Reading, ReadError>;
}

/// Which points of a plan a program names.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Points {
    /// So many that even motion between them keeps to a tolerance, no closer than `least_s` \[s\] at the full speed.
    Chords {
        /// Shortest time between two points \[s\].
        least_s: f64,
    },
    /// Every `step_s` \[s\] of the program's own time, up to the first that is not before the end.
    Steps {
        /// \[s\]
        step_s: f64,
    },
    /// All knots of the plan.
    Knots,
}

/// Why a text could not be interpreted.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{place}: {reason}")]
pub struct ReadError {
    /// The line.
    pub place: Place,
    /// What is wrong with it, and what was expected.
    pub reason: String,
}

impl ReadError {
    /// A reason at a line of a file, from 1.
    pub(crate) fn at(file: &str, line: usize, reason: impl Into<String>) -> Self {
        let (file, reason) = (file.to_owned(), reason.into());
        Self {
            place: Place { file, line },
            reason,
        }
    }
}
