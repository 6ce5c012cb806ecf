//! Checks of requirements, with their results.

use crate::report::requirement::Requirement;
use crate::report::unit::Unit;
use platewash_bodies::coverage::reaches;
use platewash_motion::trajectory::SegmentKind;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Result of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// The requirement holds at every moment.
    Proved,
    /// The requirement is broken, at `worst`.
    Violated,
    /// Neither the requirement nor a violation was shown.
    NotProved,
    /// The requirement does not hold, and the job waives it; it is reported.
    Waived,
}

impl Status {
    /// True if the result does not count against the plan: proved or waived.
    #[must_use]
    pub fn is_kept(self) -> bool {
        matches!(self, Self::Proved | Self::Waived)
    }
}

/// Side of its limit on which a measure must stay.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Sense {
    /// Not above the limit.
    AtMost,
    /// Not below the limit.
    AtLeast,
    /// Above the limit.
    Above,
}

/// A quantity bounded over the whole motion. The true extreme lies between `seen` and `bound`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
pub struct Measure {
    /// Proved bound; `None` where nothing finite is proved.
    pub bound: Option<f64>,
    /// Worst value found at a single moment, at `worst`.
    pub seen: Option<f64>,
    /// Required limit.
    pub limit: f64,
    /// Side of the limit on which the quantity must stay.
    pub sense: Sense,
    /// Unit of bound, value and limit.
    pub unit: Unit,
}

/// Position and time of the worst case. Fields that do not apply are `None`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, TS)]
#[serde(default)]
#[ts(optional_fields)]
pub struct WorstCase {
    /// Time \[s\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Position, world frame \[m\].
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
    /// Names of the two bodies.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pair: Option<[String; 2]>,
}

/// Statement of a plan that is not as it must be for its job and the arm.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, thiserror::Error, TS)]
#[error("{what}: {stated}; expected {expected}")]
pub struct Discrepancy {
    /// Name of the field, as in the file.
    pub what: String,
    /// Stated value.
    pub stated: String,
    /// Expected value.
    pub expected: String,
}

/// A requirement with the result of its check.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, TS)]
#[ts(optional_fields)]
pub struct Check {
    /// The requirement.
    #[ts(as = "String")]
    pub requirement: Requirement,
    /// Result of the check.
    pub status: Status,
    /// Measure, for requirements about a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measure: Option<Measure>,
    /// Position and time at which the number is worst.
    pub worst: WorstCase,
    /// Discrepancies, for requirements about statements.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[ts(as = "Option<Vec<Discrepancy>>")]
    pub discrepancies: Vec<Discrepancy>,
    /// Number of further discrepancies beyond those listed.
    #[serde(default, skip_serializing_if = "is_none")]
    #[ts(as = "Option<usize>")]
    pub more_discrepancies: usize,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde asks for it
fn is_none(count: &usize) -> bool {
    *count == 0
}

/// Number of discrepancies listed by one check.
const MOST_DISCREPANCIES: usize = 20;

/// Relative amount by which a value may exceed a limit, for the rounding of everything that leads to a bound.
pub(crate) const ROUNDING: f64 = 1e-9;

/// Returns a number, where it is finite.
pub(crate) fn finite(number: f64) -> Option<f64> {
    Some(number).filter(|number| number.is_finite())
}

impl Measure {
    /// Returns a measure of its bound and the worst value seen.
    pub(crate) fn new(sense: Sense, limit: f64, unit: Unit, [bound, seen]: [Option<f64>; 2]) -> Self {
        Self {
            bound,
            seen,
            limit,
            sense,
            unit,
        }
    }

    /// Checks that a value is on the right side of the limit. False for NaN.
    pub(crate) fn is_within_limit(&self, value: f64) -> bool {
        let slack = ROUNDING * self.limit.abs().max(1e-3);
        match self.sense {
            Sense::AtMost => value <= self.limit + slack,
            Sense::AtLeast => reaches(value, self.limit),
            Sense::Above => value > self.limit,
        }
    }
}

impl WorstCase {
    /// Returns the worst case that is known by its plate alone.
    pub(crate) fn on_plate(plate: usize) -> Self {
        Self {
            plate: Some(plate),
            ..Self::default()
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
            status,
            discrepancies,
            more_discrepancies,
            ..Self::not_judged(requirement)
        }
    }

    /// A requirement about a number. It is proved when the bound keeps the limit, violated when a value seen breaks it. A number
    /// that does not occur (no bound, nothing seen) breaks nothing.
    pub(crate) fn measured(requirement: Requirement, measure: Measure, worst: WorstCase) -> Self {
        let keeps = |value: f64| measure.is_within_limit(value);
        let status = match (measure.bound, measure.seen) {
            (Some(bound), _) if keeps(bound) => Status::Proved,
            (_, Some(seen)) if !keeps(seen) => Status::Violated,
            _ => Status::NotProved,
        };
        Self {
            status,
            measure: Some(measure),
            worst,
            ..Self::not_judged(requirement)
        }
    }

    /// Returns the check with a violation waived, if the job does not require it.
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
            worst: WorstCase::default(),
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

/// Returns the worse of two sides of a requirement: the one that is not kept, or the one with the smaller relative margin to its limit.
pub(crate) fn tighter(a: Check, b: Check) -> Check {
    let spare = |check: &Check| {
        let Some(Measure {
            bound: Some(bound),
            limit,
            ..
        }) = check.measure
        else {
            return f64::NEG_INFINITY;
        };
        // A limit of 0 is kept with everything to spare.
        (bound - limit).abs() / limit.abs().max(f64::MIN_POSITIVE)
    };
    match (a.status.is_kept(), b.status.is_kept()) {
        (false, true) => a,
        (true, false) => b,
        _ if spare(&a) <= spare(&b) => a,
        _ => b,
    }
}
