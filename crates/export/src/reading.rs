//! What a program says, read back out of its text.

use crate::file::Place;
use nalgebra::UnitQuaternion;
use platewash_kinematics::{JointVector, Pose};

/// What a program does, as its text says.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// Share of the plan's speed that the program itself states; `None` where it states none.
    pub speed_share: Option<f64>,
    /// Points in the order in which they are reached; the first is where the arm must stand.
    pub points: Vec<ReadPoint>,
    /// How the arm is assumed to move from one point to the next.
    pub between: Between,
    /// The tool, where the program states one.
    pub tool: Option<ReadTool>,
    /// Whether the program checks, as it was exported, that the arm stands at the start before it moves.
    pub checks_start: bool,
}

impl Reading {
    /// Share of the plan's speed at which the program runs: all of it where none is stated.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.speed_share.unwrap_or(1.0)
    }
}

/// A point that a program names.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadPoint {
    /// The line that names it.
    pub place: Place,
    /// When it is reached, in the program's time, as the sum of what the lines say \[s\].
    pub t_s: f64,
    /// Joint positions \[rad\].
    pub q_rad: JointVector,
    /// Joint speeds, where the program states them \[rad/s\].
    pub qd_rad_s: Option<JointVector>,
    /// Radius of the corner at it \[m\]; `None` where the arm stops.
    pub corner_m: Option<f64>,
}

/// How an arm moves between points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Between {
    /// Evenly and straight in the joints, rounded at the points by parabolas whose size is only assumed.
    RoundedLines,
    /// Evenly and straight in the joints, through every point.
    Lines,
    /// On the cubic that has the stated positions and speeds at both ends.
    Cubics,
}

/// A tool as a program states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadTool {
    /// `T_flange_tip`, where it is stated.
    pub tip: Option<Pose>,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Centre of mass, mounting frame \[m\].
    pub com_m: [f64; 3],
    /// Moments of inertia about the principal axes \[kg·m²\] and those axes in the mounting frame, where they are stated.
    pub inertia: Option<([f64; 3], UnitQuaternion<f64>)>,
}
