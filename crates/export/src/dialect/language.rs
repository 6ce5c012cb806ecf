//! A language of robot programs: how it is recognised, written and read.

use crate::program::Program;
use crate::program::ProgramFile;
use crate::reading::Reading;
use crate::refusal::Refusal;
use platewash_kinematics::RobotModel;
pub use platewash_motion_proof::ReadError;
use platewash_workcell::job::JobTerms;
use std::fmt::Debug;

/// A language of robot programs.
pub trait Dialect: Debug + Sync {
    /// Its name on the command line, e.g. `rapid`.
    fn name(&self) -> &'static str;

    /// Checks that a file is a program of this dialect, by its name and text.
    fn is_in(&self, file: &ProgramFile) -> bool;

    /// Choice of the plan's points that it is given.
    fn points(&self) -> Points;

    /// Assumptions about the controller, and points that nobody has tried on one; one sentence per entry.
    /// [`START_WITHIN`](crate::dialect::START_WITHIN) in one stands for the largest distance from the start.
    fn assumptions(&self) -> &'static [&'static str];

    /// Returns true where its programs state joints as the arm's controller counts them ([`Joint3`](crate::Joint3)), not as the description does.
    fn has_maker_joints(&self) -> bool {
        false
    }

    /// Refuses a job that it cannot be handed over for: another make of arm, a tool without a mass.
    ///
    /// # Errors
    /// [`Refusal`].
    fn accepts(&self, _job: &JobTerms, _arm: &RobotModel) -> Result<(), Refusal> {
        Ok(())
    }

    /// The program's text. The same program gives the same bytes.
    fn write(&self, program: &Program<'_>) -> Vec<ProgramFile>;

    /// Interprets a text, including one that platewash did not write.
    ///
    /// # Errors
    /// [`ReadError`], with the line.
    fn read(&self, files: &[ProgramFile], arm: &RobotModel) -> Result<Reading, ReadError>;
}

/// Choice of the plan's points that a program names.
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
