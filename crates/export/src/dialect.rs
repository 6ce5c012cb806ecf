//! A dialect, a language of robot programs, and all of them. Another one is one file, one fixture and one line here.

use crate::csv::Csv;
use crate::program::Program;
use crate::program::ProgramFile;
use crate::rapid::Rapid;
use crate::reading::Reading;
use crate::refusal::Refusal;
use crate::ros2::Ros2;
use crate::urscript::UrScript;
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

    /// Assumptions about the controller, and points that nobody has tried on one; one sentence per entry. [`START_WITHIN`] in one
    /// stands for the largest distance from the start.
    fn assumptions(&self) -> &'static [&'static str];

    /// Returns true where its programs state joints as the arm's controller counts them ([`Joint3`](crate::maker_joints::Joint3)), not as the description does.
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

/// All dialects.
pub static DIALECTS: [&dyn Dialect; 4] = [&Rapid, &Ros2, &UrScript, &Csv];

/// The dialect of that name.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static dyn Dialect> {
    DIALECTS.into_iter().find(|dialect| dialect.name() == name)
}

/// The names of all dialects, with commas between.
#[must_use]
pub fn names() -> String {
    DIALECTS.map(Dialect::name).join(", ")
}

/// Place in an assumption for the largest distance of the arm from the start \[°\].
pub const START_WITHIN: &str = "{start_within_deg}";

/// Largest distances of the arm from the start of a plan, joint by joint \[°\]: at home, and after a stop, where the sponge may be at a plate.
/// Programs check it where they can. The way from there to the start is not proved.
pub const START_WITHIN_DEG: [f64; 2] = [0.5, 0.1];

/// Largest distance of the arm from the start of a job's plan, joint by joint \[°\].
#[must_use]
pub fn start_within_deg(job: &JobTerms) -> f64 {
    let [at_home, after_stop] = START_WITHIN_DEG;
    if job.is_motion_home() { after_stop } else { at_home }
}
