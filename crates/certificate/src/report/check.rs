//! What is checked, and what came of it.

use crate::report::requirement::Requirement;
use platewash_workcell::coverage::reaches;
use platewash_workcell::trajectory::SegmentKind;
use serde::{Deserialize, Serialize};

/// What came of a requirement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It holds, at every moment.
    Proved,
    /// It is broken: `worst` says where.
    Violated,
    /// Neither could be shown.
    NotProved,
    /// It does not hold, and the job does not ask for it: it is reported.
    Waived,
}

impl Status {
    /// Whether nothing stands against the plan.
    #[must_use]
    pub fn is_kept(self) -> bool {
        matches!(self, Self::Proved | Self::Waived)
    }
}

/// Unit of a measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Unit {
    /// rad
    #[serde(rename = "rad")]
    Radian,
    /// rad/s
    #[serde(rename = "rad/s")]
    RadianPerSecond,
    /// rad/s²
    #[serde(rename = "rad/s^2")]
    RadianPerSecondSquared,
    /// m
    #[serde(rename = "m")]
    Metre,
    /// m/s
    #[serde(rename = "m/s")]
    MetrePerSecond,
    /// m/s²
    #[serde(rename = "m/s^2")]
    MetrePerSecondSquared,
    /// N
    #[serde(rename = "N")]
    Newton,
    /// A share of one.
    #[serde(rename = "1")]
    Share,
}

/// On which side of its limit a measure must stay.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sense {
    /// Not above it.
    AtMost,
    /// Not below it.
    AtLeast,
    /// Above it.
    Above,
}

/// A number that is bounded for the whole motion. The true extreme lies between `seen` and `bound`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Measure {
    /// What is proved: never beyond this. `None` where nothing finite is.
    pub bound: Option<f64>,
    /// The worst value found at a single moment, at `worst`.
    pub seen: Option<f64>,
    /// What is required.
    pub limit: f64,
    /// On which side of the limit it must be.
    pub sense: Sense,
    /// Unit of the three numbers.
    pub unit: Unit,
}

/// Where something is worst. What does not apply is left out.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Worst {
    /// \[s\]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Place, world frame \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub place_m: Option<[f64; 3]>,
    /// Joint index, 0 for joint 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joint: Option<usize>,
    /// Plate index.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate: Option<usize>,
    /// Index and kind of the segment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub segment: Option<(usize, SegmentKind)>,
    /// Names of two bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pair: Option<[String; 2]>,
}

/// Something that a plan states and that is not as it must be for its job and the arm.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[error("{what}: {stated}; expected {expected}")]
pub struct Discrepancy {
    /// The field, as in the file.
    pub what: String,
    /// What it says.
    pub stated: String,
    /// What it should say.
    pub expected: String,
}

/// A requirement and what came of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// What is required.
    pub requirement: Requirement,
    /// What came of it.
    pub status: Status,
    /// The number behind it, for requirements about a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measure: Option<Measure>,
    /// Where the number is worst.
    pub worst: Worst,
    /// What does not agree, for requirements about statements.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub discrepancies: Vec<Discrepancy>,
    /// How many more there are, beyond those listed.
    #[serde(default, skip_serializing_if = "is_none")]
    pub more_discrepancies: usize,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde asks for it
fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Discrepancies that one check lists; more would help nobody.
const MOST_DISCREPANCIES: usize = 20;

/// By how much of it a limit may be exceeded: the rounding of everything that leads to a bound.
pub(crate) const ROUNDING: f64 = 1e-9;

impl Measure {
    /// Whether a value is on the right side of the limit. NaN never is.
    pub(crate) fn keeps(&self, value: f64) -> bool {
        let slack = ROUNDING * self.limit.abs().max(1e-3);
        match self.sense {
            Sense::AtMost => value <= self.limit + slack,
            Sense::AtLeast => reaches(value, self.limit),
            Sense::Above => value > self.limit,
        }
    }
}

impl Check {
    /// A requirement about statements: it holds where nothing disagrees.
    pub(crate) fn stated(requirement: Requirement, mut discrepancies: Vec<Discrepancy>) -> Self {
        let status = if discrepancies.is_empty() {
            Status::Proved
        } else {
            Status::Violated
        };
        let more_discrepancies = discrepancies.len().saturating_sub(MOST_DISCREPANCIES);
        discrepancies.truncate(MOST_DISCREPANCIES);
        Self {
            requirement,
            status,
            measure: None,
            worst: Worst::default(),
            discrepancies,
            more_discrepancies,
        }
    }

    /// A requirement about a number. It is proved when the bound keeps the limit, violated when a value seen breaks it. A number
    /// that does not occur (no bound, nothing seen) breaks nothing.
    pub(crate) fn measured(requirement: Requirement, measure: Measure, worst: Worst) -> Self {
        let keeps = |value: f64| measure.keeps(value);
        let status = match (measure.bound, measure.seen) {
            (Some(bound), _) if keeps(bound) => Status::Proved,
            (_, Some(seen)) if !keeps(seen) => Status::Violated,
            _ => Status::NotProved,
        };
        Self {
            requirement,
            status,
            measure: Some(measure),
            worst,
            discrepancies: Vec::new(),
            more_discrepancies: 0,
        }
    }

    /// The same where the job does not ask for it: what is broken is waived.
    pub(crate) fn waived_if(mut self, waives: bool) -> Self {
        if waives && self.status == Status::Violated {
            self.status = Status::Waived;
        }
        self
    }

    /// A requirement that cannot be judged, because another one that it rests on is broken.
    pub(crate) fn not_judged(requirement: Requirement) -> Self {
        Self {
            requirement,
            status: Status::NotProved,
            measure: None,
            worst: Worst::default(),
            discrepancies: Vec::new(),
            more_discrepancies: 0,
        }
    }
}

impl Discrepancy {
    pub(crate) fn new(
        what: impl Into<String>,
        stated: impl std::fmt::Display,
        expected: impl std::fmt::Display,
    ) -> Self {
        Self {
            what: what.into(),
            stated: stated.to_string(),
            expected: expected.to_string(),
        }
    }
}
