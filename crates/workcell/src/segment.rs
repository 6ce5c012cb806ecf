//! The stretches of a motion, by what they are for.

use serde::{Deserialize, Serialize};

/// What a segment is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SegmentKind {
    /// From the start to the first approach, or to the first waypoint.
    Depart,
    /// Down to a plate along its normal.
    Approach,
    /// Washing a plate.
    Wash,
    /// Up from a plate along its normal.
    Retreat,
    /// From one plate to the next.
    Transit,
    /// From the last plate home.
    Return,
}

impl SegmentKind {
    /// The word used in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Depart => "depart",
            Self::Approach => "approach",
            Self::Wash => "wash",
            Self::Retreat => "retreat",
            Self::Transit => "transit",
            Self::Return => "return",
        }
    }
}

/// A segment in time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlanSegment {
    /// What it is for.
    pub kind: SegmentKind,
    /// The plate washed, or the plate it leads to.
    pub plate: usize,
    /// Start \[s\].
    pub t_start_s: f64,
    /// End \[s\].
    pub t_end_s: f64,
}
