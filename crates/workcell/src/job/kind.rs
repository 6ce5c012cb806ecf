//! Kinds of plans, and the statements that each may make.
//!
//! A statement that a kind of plan has no use for is refused: whatever rests on it would rest on nothing.

use crate::dry_run::DryRun;
use crate::job::recovery::Recovery;
use std::fmt;

/// Kind of a plan, by what its job states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanKind {
    /// Washing of all plates.
    Wash,
    /// Motion of another plan in the air.
    DryRun,
    /// Motion from a stop home. It washes nothing.
    MotionHome,
    /// Washing of the plates that are left after a stop.
    Rest,
}

/// Statement of a plan that not every kind may make.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statement {
    /// Plates in the order of washing (`order`).
    Order,
    /// Wash paths (`wash_paths`).
    WashPaths,
    /// Plan that is tried out in the air (`job.dry_run`).
    DryRun,
    /// Pairs that are near at the stop (`at_stop` of `job.workcell.reduced_clearances`).
    NearAtStop,
    /// Requirements of the contact (`job.requirements.contact`).
    Contact,
    /// Holder of the plates (`job.requirements.holder`).
    Holder,
    /// Contact speed in landing (`job.requirements.landing_m_s`).
    LandingSpeed,
    /// Contact speed in lifting (`job.requirements.lifting_m_s`).
    LiftingSpeed,
    /// Wrist: angle of joint 5 from 0 (`job.requirements.wrist_rad`).
    Wrist,
}

/// Rule of a kind of plan for a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatementRule {
    /// The statement must be there.
    Needed,
    /// The statement may be there, and is judged.
    Judged,
    /// The statement may be there, and is not judged: the planner alone follows it.
    Planned,
    /// The statement must not be there.
    Refused,
}

impl PlanKind {
    /// All kinds.
    pub const ALL: [Self; 4] = [Self::Wash, Self::DryRun, Self::MotionHome, Self::Rest];

    /// Returns the kind of a plan that states this dry run and this recovery.
    #[must_use]
    pub fn stated(dry_run: Option<&DryRun>, recovery: Option<&Recovery>) -> Self {
        match (recovery, dry_run) {
            (Some(recovery), _) if recovery.is_motion_home() => Self::MotionHome,
            (_, Some(_)) => Self::DryRun,
            (Some(_), None) => Self::Rest,
            (None, None) => Self::Wash,
        }
    }

    /// Returns what the kind does with a statement.
    #[must_use]
    pub fn rule(self, statement: Statement) -> StatementRule {
        statement.stated().1[self as usize]
    }
}

impl fmt::Display for PlanKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Wash => "a washing",
            Self::DryRun => "a dry run",
            Self::MotionHome => "a motion home after a stop",
            Self::Rest => "the rest after a stop",
        })
    }
}

impl Statement {
    /// All statements.
    pub const ALL: [Self; 9] = [
        Self::Order,
        Self::WashPaths,
        Self::DryRun,
        Self::NearAtStop,
        Self::Contact,
        Self::Holder,
        Self::LandingSpeed,
        Self::LiftingSpeed,
        Self::Wrist,
    ];

    /// Path of the statement in a plan file.
    #[must_use]
    pub fn path(self) -> &'static str {
        self.stated().0
    }

    /// Returns the path of the statement in a plan file, and the rules of the kinds for it, in the order of [`PlanKind::ALL`].
    fn stated(self) -> (&'static str, [StatementRule; 4]) {
        use StatementRule::{Judged, Needed, Planned, Refused};
        // Nothing is pressed in the air. At a stop the sponge may be at a plate, and leaves it.
        match self {
            Self::Order => ("order", [Needed, Needed, Refused, Needed]),
            Self::WashPaths => ("wash_paths", [Needed, Needed, Refused, Needed]),
            Self::DryRun => ("job.dry_run", [Refused, Needed, Refused, Refused]),
            Self::NearAtStop => (
                "job.workcell.reduced_clearances.at_stop",
                [Refused, Refused, Judged, Refused],
            ),
            Self::Contact => ("job.requirements.contact", [Judged, Planned, Refused, Judged]),
            Self::Holder => ("job.requirements.holder", [Judged, Planned, Refused, Judged]),
            Self::LandingSpeed => ("job.requirements.landing_m_s", [Judged, Judged, Refused, Judged]),
            Self::LiftingSpeed => ("job.requirements.lifting_m_s", [Judged, Judged, Needed, Judged]),
            Self::Wrist => ("job.requirements.wrist_rad", [Judged, Judged, Refused, Judged]),
        }
    }
}
