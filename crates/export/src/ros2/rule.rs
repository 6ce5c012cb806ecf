//! The rules for messages, by name: who asks for each, and what a breach of one is told as.

/// A rule. [`Rule::code`] is stable.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Rule {
    /// As many names as the arm has joints.
    JointCount,
    /// Each name is one of the arm's joints.
    JointName,
    /// No name stands twice.
    JointTwice,
    /// There is a point.
    Points,
    /// A message begins at once, not at a time of the clock.
    Stamp,
    /// Times are in the range of `builtin_interfaces/Duration`.
    Duration,
    /// Times increase strictly.
    TimeOrder,
    /// The first point is after the lead-in, or it is a step.
    LeadIn,
    /// A position a joint.
    Positions,
    /// A speed a joint: without speeds the controller draws lines.
    Velocities,
    /// No accelerations: with them the controller draws other curves.
    Accelerations,
    /// No effort.
    Effort,
    /// The arm rests at the first point.
    StartSpeed,
    /// The arm rests at the last point.
    EndSpeed,
    /// Tolerances name each joint once and no other, and are positive, 0 or −1.
    Tolerance,
}

/// Who asks for a rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AskedBy {
    /// The controller, which refuses the message or, for tolerances, falls back to its own without saying so to the sender.
    Controller,
    /// The message's type.
    Type,
    /// This program: the controller takes the message, and moves otherwise than was proved.
    Proof,
}

/// A rule that a message breaks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Breach {
    /// The rule.
    pub rule: Rule,
    /// The line, from 1; 0 for a message that was not read.
    pub line: usize,
    /// What was expected and found.
    pub found: String,
}

impl Rule {
    /// All of them, in the order in which they are checked.
    pub const ALL: [Self; 15] = [
        Self::JointTwice,
        Self::JointName,
        Self::JointCount,
        Self::Stamp,
        Self::Points,
        Self::Duration,
        Self::LeadIn,
        Self::TimeOrder,
        Self::Positions,
        Self::Velocities,
        Self::Accelerations,
        Self::Effort,
        Self::StartSpeed,
        Self::EndSpeed,
        Self::Tolerance,
    ];

    /// A stable word for it.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::JointCount => "joint-count",
            Self::JointName => "joint-name",
            Self::JointTwice => "joint-twice",
            Self::Points => "points",
            Self::Stamp => "stamp",
            Self::Duration => "duration",
            Self::TimeOrder => "time-order",
            Self::LeadIn => "lead-in",
            Self::Positions => "positions",
            Self::Velocities => "velocities",
            Self::Accelerations => "accelerations",
            Self::Effort => "effort",
            Self::StartSpeed => "start-speed",
            Self::EndSpeed => "end-speed",
            Self::Tolerance => "tolerance",
        }
    }

    /// Who asks for it.
    #[must_use]
    pub fn asked_by(self) -> AskedBy {
        match self {
            Self::JointCount
            | Self::JointName
            | Self::Points
            | Self::TimeOrder
            | Self::Positions
            | Self::Effort
            | Self::EndSpeed
            | Self::Tolerance => AskedBy::Controller,
            Self::Duration => AskedBy::Type,
            Self::JointTwice
            | Self::Stamp
            | Self::LeadIn
            | Self::Velocities
            | Self::Accelerations
            | Self::StartSpeed => AskedBy::Proof,
        }
    }

    /// A breach of it.
    pub(super) fn broken(self, line: usize, found: String) -> Breach {
        Breach {
            rule: self,
            line,
            found,
        }
    }
}

impl Breach {
    /// The rule, who asks for it and what was found, as a sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        let by = match self.rule.asked_by() {
            AskedBy::Controller => "joint_trajectory_controller",
            AskedBy::Type => "the message's type",
            AskedBy::Proof => "the proof",
        };
        format!("{} (rule {} of {by})", self.found, self.rule.code())
    }
}
