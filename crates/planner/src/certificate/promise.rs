//! What is promised, and what came of it.

use crate::tool_path::SegmentKind;
use serde::{Deserialize, Serialize};

/// What came of a promise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// It holds, at every moment.
    Pass,
    /// It is broken: `worst` says where.
    Fail,
    /// Neither could be shown.
    NotProved,
    /// It does not hold, and the scenario does not ask for it: it is reported.
    Exempt,
}

impl Status {
    /// Whether nothing stands against the plan.
    #[must_use]
    pub fn is_kept(self) -> bool {
        matches!(self, Self::Pass | Self::Exempt)
    }
}

/// The promises of a certified job, in the order of the certificate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum PromiseName {
    /// The plan is for this arm: its name and the hash of its description.
    Arm,
    /// The tool and its tip are the scenario's.
    Tool,
    /// The plates have the scenario's shape, and its positions where it gives them.
    Plates,
    /// The limits stated are those of the scenario and the arm.
    Limits,
    /// The tolerances stated are those that every certified job has.
    Tolerances,
    /// The pairs stated are all that must keep clear.
    ClearancePairs,
    /// The segments follow one another from home to home, and the tool path with them.
    Segments,
    /// The tool path is the one that the scenario asks for on these plates.
    ToolPath,
    /// Every plate is washed once and the order says so; while another one is washed no more than its rim is swept.
    EveryPlateOnce,
    /// The motion starts and ends at rest in the scenario's home positions.
    HomeToHome,
    /// The arm rests where a wash begins and where it ends. A tilted sponge touches before and after: see
    /// [`PromiseName::ContactSpeed`].
    RestAtWashEnds,
    /// No plate overlaps another or the base.
    PlatesApart,
    /// Joint positions, as the margin to the nearest limit.
    JointPosition,
    /// Joint speeds.
    JointSpeed,
    /// Joint accelerations.
    JointAcceleration,
    /// Speed of the tip, wherever it does not wash.
    TipSpeed,
    /// Acceleration of the tip, wherever it does not wash.
    TipAcceleration,
    /// Speed of the tip while it washes.
    WashSpeed,
    /// Acceleration of the tip while it washes.
    WashAcceleration,
    /// Angle of the tool from the plate's normal while it approaches, washes and retreats.
    Tilt,
    /// Height of the tip over or under the plate while it washes.
    ContactHeight,
    /// Speed of the sponge's rim, at every point at or below the plate's face, while it comes down and while it leaves.
    ContactSpeed,
    /// Distance of the tip from the stroke while it washes, the whole of it in order.
    StrokeDeviation,
    /// Distance of the tip from the plate's normal while it approaches and retreats.
    LineDeviation,
    /// Clearance of every pair.
    Clearance,
    /// How far the sponge reaches beyond the rim of the plate that it washes.
    Reach,
    /// Share of each plate that the sponge sweeps.
    Coverage,
    /// The plan's summary says what follows from the plan, and counts no plate as washed that is not proved to be.
    Summary,
}

impl PromiseName {
    /// The words used in tables.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Arm => "arm",
            Self::Tool => "tool",
            Self::Plates => "plates",
            Self::Limits => "limits",
            Self::Tolerances => "tolerances",
            Self::ClearancePairs => "clearance pairs",
            Self::Segments => "segments",
            Self::ToolPath => "tool path",
            Self::EveryPlateOnce => "every plate once",
            Self::HomeToHome => "home to home",
            Self::RestAtWashEnds => "rest at wash ends",
            Self::PlatesApart => "plates apart",
            Self::JointPosition => "joint position",
            Self::JointSpeed => "joint speed",
            Self::JointAcceleration => "joint acceleration",
            Self::TipSpeed => "tip speed",
            Self::TipAcceleration => "tip acceleration",
            Self::WashSpeed => "wash speed",
            Self::WashAcceleration => "wash acceleration",
            Self::Tilt => "tilt",
            Self::ContactHeight => "contact height",
            Self::ContactSpeed => "contact speed",
            Self::StrokeDeviation => "stroke deviation",
            Self::LineDeviation => "line deviation",
            Self::Clearance => "clearance",
            Self::Reach => "reach beyond rim",
            Self::Coverage => "coverage",
            Self::Summary => "summary",
        }
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
    /// What is promised.
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
    /// Place, base frame \[m\].
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

/// Something that a plan states and that does not follow from its scenario and the arm.
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

/// A promise and what came of it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Promise {
    /// Which.
    pub name: PromiseName,
    /// What came of it.
    pub status: Status,
    /// The number behind it, for promises about a number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measure: Option<Measure>,
    /// Where the number is worst.
    pub worst: Worst,
    /// What does not agree, for promises about statements.
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

/// Discrepancies that one promise lists; more would help nobody.
const MOST_DISCREPANCIES: usize = 20;

/// By how much of it a limit may be exceeded: the rounding of everything that leads to a bound.
pub(super) const ROUNDING: f64 = 1e-9;

/// Whether a value is at least a limit, but for the rounding of what leads to it: as promises are judged, so that a simulation
/// asks for no more than a certificate does. NaN is not.
#[must_use]
pub fn reaches(value: f64, limit: f64) -> bool {
    value >= limit - ROUNDING * limit.abs().max(1e-3)
}

impl Measure {
    /// Whether a value is on the right side of the limit. NaN never is.
    pub(super) fn keeps(&self, value: f64) -> bool {
        let slack = ROUNDING * self.limit.abs().max(1e-3);
        match self.sense {
            Sense::AtMost => value <= self.limit + slack,
            Sense::AtLeast => reaches(value, self.limit),
            Sense::Above => value > self.limit,
        }
    }
}

impl Promise {
    /// A promise about statements: it holds where nothing disagrees.
    pub(super) fn stated(name: PromiseName, mut discrepancies: Vec<Discrepancy>) -> Self {
        let status = if discrepancies.is_empty() {
            Status::Pass
        } else {
            Status::Fail
        };
        let more_discrepancies = discrepancies.len().saturating_sub(MOST_DISCREPANCIES);
        discrepancies.truncate(MOST_DISCREPANCIES);
        Self {
            name,
            status,
            measure: None,
            worst: Worst::default(),
            discrepancies,
            more_discrepancies,
        }
    }

    /// A promise about a number. It passes when the bound keeps the limit, fails when a value seen breaks it. A number
    /// that does not occur (no bound, nothing seen) breaks nothing.
    pub(super) fn measured(name: PromiseName, measure: Measure, worst: Worst) -> Self {
        let keeps = |value: f64| measure.keeps(value);
        let status = match (measure.bound, measure.seen) {
            (Some(bound), _) if keeps(bound) => Status::Pass,
            (_, Some(seen)) if !keeps(seen) => Status::Fail,
            _ => Status::NotProved,
        };
        Self {
            name,
            status,
            measure: Some(measure),
            worst,
            discrepancies: Vec::new(),
            more_discrepancies: 0,
        }
    }

    /// A promise that cannot be judged, because another one that it rests on is broken.
    pub(super) fn not_judged(name: PromiseName) -> Self {
        Self {
            name,
            status: Status::NotProved,
            measure: None,
            worst: Worst::default(),
            discrepancies: Vec::new(),
            more_discrepancies: 0,
        }
    }
}

impl Discrepancy {
    pub(super) fn new(
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
