//! A row: what came of one scenario of a study. `docs/studies.md` says what each field means; they change with [`ROW_SCHEMA`] alone.

use platewash_certificate::{self as certificate, Certificate, Requirement};
use platewash_planner::{InfeasibleReport, PlanError, Planned};
use platewash_scenario::Failure;
use platewash_workcell::verdict::Infeasibility;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// The version of rows. Fields are added, taken away or given another meaning only with another number.
pub const ROW_SCHEMA: u32 = 1;

/// How a row ended. The words are those of `sweep`, and one more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Planned, and every requirement proved.
    Proved,
    /// Planned, but a requirement is violated or not proved.
    NotProved,
    /// The job cannot be done.
    Infeasible,
    /// No way to do it was found; there may be one.
    NotFound,
    /// The values of this row state no job.
    Error,
    /// The program failed on this row, which is a fault of the program.
    Crashed,
}

impl Outcome {
    /// All of them.
    pub const ALL: [Self; 6] = [
        Self::Proved,
        Self::NotProved,
        Self::Infeasible,
        Self::NotFound,
        Self::Error,
        Self::Crashed,
    ];

    /// Its code, as in rows.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::Proved => "proved",
            Self::NotProved => "not_proved",
            Self::Infeasible => "infeasible",
            Self::NotFound => "not_found",
            Self::Error => "error",
            Self::Crashed => "crashed",
        }
    }
}

/// The place of a reason; what does not apply is `None`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The requirement that is not kept, as in a certificate.
    pub requirement: Option<Requirement>,
    /// Index of the plate.
    pub plate: Option<usize>,
    /// Index of the plan's segment.
    pub segment: Option<usize>,
    /// Time in the plan \[s\].
    pub time_s: Option<f64>,
    /// The place, world frame \[m\]: of a plan, where it is worst; of a plate that cannot be washed, the first point of its wash path
    /// for which no configuration was found.
    pub point_m: Option<[f64; 3]>,
}

/// What came of one scenario of a study. It depends on the study and the program's version alone: how long it took is kept elsewhere.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// [`ROW_SCHEMA`].
    pub schema: u32,
    /// Index of the row, from 0.
    pub index: u64,
    /// Its key: the first 16 digits of the SHA-256 of its scenario's name and its axes.
    pub key: String,
    /// The scenario, as the study names it.
    pub scenario: String,
    /// The values of the axes.
    pub axes: BTreeMap<String, Value>,
    /// How it ended.
    pub outcome: Outcome,
    /// Why it is not proved; where it is proved but for what its scenario waives, that.
    pub reason: Option<String>,
    /// Where that is.
    pub place: Place,
    /// Duration of the motion \[s\].
    pub duration_s: Option<f64>,
    /// Share swept of the plate that is swept least, guaranteed.
    pub coverage: Option<f64>,
    /// Share in contact of the plate where it is least, guaranteed; `None` where the job does not ask for it.
    pub contact: Option<f64>,
    /// Least clearance of all pairs but the sponge and the plates while it works, guaranteed \[m\].
    pub clearance_m: Option<f64>,
    /// The pair of bodies that has it.
    pub clearance_pair: Option<[String; 2]>,
    /// Hash of the plan.
    pub plan: Option<String>,
}

impl Row {
    /// A row of which nothing is known yet.
    pub(crate) fn new(index: u64, key: String, scenario: String, axes: BTreeMap<String, Value>) -> Self {
        Self {
            schema: ROW_SCHEMA,
            index,
            key,
            scenario,
            axes,
            outcome: Outcome::Error,
            reason: None,
            place: Place::default(),
            duration_s: None,
            coverage: None,
            contact: None,
            clearance_m: None,
            clearance_pair: None,
            plan: None,
        }
    }

    /// With what came of a plan.
    pub(crate) fn planned(self, planned: &Planned, certificate: &Certificate) -> Self {
        let bound = |name| certificate.check(name)?.measure?.bound.filter(|v| v.is_finite());
        let waived = certificate.but_for();
        let waived = Some(waived.trim()).filter(|waived| !waived.is_empty());
        let place = certificate.broken().next().map(|check| Place {
            requirement: Some(check.requirement),
            plate: check.worst.plate,
            segment: check.worst.segment.map(|(index, _)| index),
            time_s: check.worst.time_s,
            point_m: check.worst.place_m,
        });
        let clearance = certificate.check(Requirement::Clearance);
        Self {
            outcome: match certificate.verdict {
                certificate::Verdict::Pass => Outcome::Proved,
                certificate::Verdict::Fail => Outcome::NotProved,
            },
            reason: certificate.not_kept().or(waived.map(str::to_owned)),
            place: place.unwrap_or_default(),
            duration_s: Some(planned.plan.duration_s()),
            coverage: bound(Requirement::Coverage),
            contact: bound(Requirement::Contact),
            clearance_m: bound(Requirement::Clearance),
            clearance_pair: clearance.and_then(|check| check.worst.pair.clone()),
            plan: planned.plan.hash.clone(),
            ..self
        }
    }

    /// With why there is no plan.
    pub(crate) fn failed(self, error: &Failure) -> Self {
        let outcome = match error.infeasibility() {
            Some(Infeasibility::Proved) => Outcome::Infeasible,
            Some(Infeasibility::NotFound) => Outcome::NotFound,
            None => Outcome::Error,
        };
        let mut place = Place::default();
        if let Failure::Plan(error) = error {
            let report = InfeasibleReport::new("", 0, error);
            place.plate = report.and_then(|report| Some(report.plates.first()?.plate));
            if let PlanError::Unwashable(plate) = error {
                place.point_m = plate.dead_m.first().copied();
            }
        }
        Self {
            place,
            ..self.ended(outcome, error.to_string())
        }
    }

    /// With an outcome and its reason.
    pub(crate) fn ended(self, outcome: Outcome, reason: String) -> Self {
        Self {
            outcome,
            reason: Some(reason),
            ..self
        }
    }
}
