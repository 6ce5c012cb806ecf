//! A program in no dialect, as it is handed over; text files of a program, and places in them.

use crate::joint_3::Joint3;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_motion::plan::Plan;
pub use platewash_motion_proof::Place;
use platewash_motion_proof::ReadError;
use platewash_workcell::tool::Tool;
use std::fmt::Debug;

/// A program to be written: points in time, and the notes that must accompany them.
#[derive(Debug, Clone)]
pub struct Program<'a> {
    /// A name that every dialect takes: a letter, then letters, digits and `_`, 20 at most.
    pub name: String,
    /// The plan, which is certified.
    pub plan: &'a Plan,
    /// Arm of the plan.
    pub arm: &'a RobotModel,
    /// Points in the order of time; the first is where the arm must stand, at 0 s.
    pub points: Vec<Point>,
    /// Share of the plan's speed at which the program runs, above 0 and at most 1: every time is divided by it.
    pub speed_share: f64,
    /// Count of axis 3 by the controller, for a dialect that has the maker's joints. The points are in the description's.
    pub joint_3: Joint3,
    /// Radius of corners between points that are not stops \[m\].
    pub corner_m: f64,
    /// Entries at the head of the text, one sentence or statement each, without line ends: verdict, hashes, assumptions.
    pub header: Vec<String>,
}

/// A point that the arm passes or stops at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// When, in the plan's time \[s\].
    pub t_s: f64,
    /// Joint positions \[rad\].
    pub q_rad: JointVector,
    /// Joint speeds in the plan's time \[rad/s\].
    pub qd_rad_s: JointVector,
    /// True where the plan rests here.
    pub rests: bool,
    /// Index of the plan's segment that ends here or holds the point; 0 for the first one.
    pub segment: usize,
}

impl Program<'_> {
    /// The tool that the arm holds.
    #[must_use]
    pub fn tool(&self) -> &Tool {
        &self.plan.job.workcell.tool
    }

    /// Duration of the program at its share of the speed \[s\].
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.t_s) / self.speed_share
    }
}

/// A text file of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ProgramFile {
    /// File name, without a folder.
    pub name: String,
    /// Text of the file; lines end with a line feed.
    pub text: String,
}

impl ProgramFile {
    /// Checks how its name ends, the case of letters aside.
    pub(crate) fn ends_in(&self, ending: &str) -> bool {
        self.name.to_ascii_lowercase().ends_with(ending)
    }

    /// The only file whose name ends so.
    ///
    /// # Errors
    /// [`ReadError`] where there is none, or a second one.
    pub(crate) fn only<'a>(files: &'a [Self], kind: &str, ending: &str) -> Result<&'a Self, ReadError> {
        let mut all = files.iter().filter(|file| file.ends_in(ending));
        match (all.next(), all.next()) {
            (Some(file), None) => Ok(file),
            (Some(_), Some(second)) => {
                let reason = format!("a second {kind}; expected one {ending} file");
                Err(ReadError::at(&second.name, 1, reason))
            }
            (None, _) => {
                let name = files.first().map_or("", |file| &file.name);
                Err(ReadError::at(
                    name,
                    1,
                    format!("expected a file whose name ends in {ending}"),
                ))
            }
        }
    }
}
