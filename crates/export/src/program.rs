//! What is handed over, in no dialect.

use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::plan::Plan;
use platewash_workcell::tool::Tool;

/// How far the arm may stand from the start of the plan, joint by joint \[°\]: programs check it where they can.
pub const START_WITHIN_DEG: f64 = 0.5;

/// A program to be written: points in time, and what must be said with them.
#[derive(Debug, Clone)]
pub struct Program<'a> {
    /// A name that every dialect takes: a letter, then letters, digits and `_`, 20 at most.
    pub name: String,
    /// The plan, which is certified.
    pub plan: &'a Plan,
    /// Its arm.
    pub arm: &'a RobotModel,
    /// Points in the order of time; the first is where the arm must stand, at 0 s.
    pub points: Vec<Point>,
    /// Share of the plan's speed at which the program runs, above 0 and at most 1: every time is divided by it.
    pub speed_share: f64,
    /// Radius of corners between points that are not stops \[m\].
    pub corner_m: f64,
    /// What stands at the head of the text, a sentence or statement an entry, without line ends: verdict, hashes, assumptions.
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
    /// Whether the plan rests here.
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
