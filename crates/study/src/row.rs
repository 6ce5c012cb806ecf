//! A row: the result of one scenario of a study. `docs/studies.md` describes each field; they change with [`ROW_SCHEMA`] alone.

use platewash_certificate::{Certificate, Requirement, Verdict};
use platewash_kinematics::ik::IkPathError;
use platewash_planner::{InfeasibleReport, PlanError, PlannedJob};
use platewash_scenario::Failure;
use platewash_workcell::verdict::Infeasibility;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// The version of rows. Fields are added, taken away or given another meaning only with another number.
pub const ROW_SCHEMA: u32 = 2;

/// Result of one scenario of a study. It depends on the study and the program's version alone: the time that it took is kept
/// elsewhere.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
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
    /// Outcome of the row.
    pub outcome: Outcome,
    /// Reason that it is not proved; where it is proved except for the requirements that its scenario waives, a note on these.
    pub reason: Option<String>,
    /// Place of the cause.
    pub place: Place,
    /// Duration of the motion \[s\].
    pub duration_s: Option<f64>,
    /// Share swept of the plate that is swept least, guaranteed.
    pub swept: Option<f64>,
    /// Share pressed of the plate where it is least, guaranteed; `None` where the job does not ask for it.
    pub pressed: Option<f64>,
    /// Least clearance of all pairs but the sponge and the plates while it works, guaranteed \[m\].
    pub clearance_m: Option<f64>,
    /// The pair of bodies that has it.
    pub clearance_pair: Option<[String; 2]>,
    /// Hash of the plan.
    pub plan: Option<String>,
}

impl Row {
    /// A row without a result yet.
    pub(crate) fn new(index: u64, key: String, scenario: String, axes: BTreeMap<String, Value>) -> Self {
        Self {
            schema: ROW_SCHEMA,
            index,
            key,
            scenario,
            axes,
            ..Self::default()
        }
    }

    /// The row as a line of JSON, without its end: the same bytes for the same row.
    #[must_use]
    pub fn line(&self) -> String {
        // Its keys are texts, and its numbers finite or null: there is nothing that JSON cannot say.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// The row with the results of a plan.
    pub(crate) fn planned(self, planned: &PlannedJob, certificate: &Certificate) -> Self {
        let clearance = certificate.check(Requirement::Clearance);
        Self {
            outcome: Outcome::judged(certificate.verdict),
            reason: certificate.reason(),
            place: Place::of_certificate(certificate),
            duration_s: Some(planned.plan.duration_s()),
            swept: certificate.bound(Requirement::Swept),
            pressed: certificate.bound(Requirement::Pressed),
            clearance_m: certificate.bound(Requirement::Clearance),
            clearance_pair: clearance.and_then(|check| check.worst.pair.clone()),
            plan: planned.plan.hash.clone(),
            ..self
        }
    }

    /// The row with the reason that there is no plan.
    pub(crate) fn failed(self, error: &Failure) -> Self {
        let report = error.report("", 0);
        let place = Place::of_failure(error, report.as_ref());
        let reason = report.map_or_else(|| error.to_string(), |report| report.reason);
        Self {
            place,
            ..self.ended(Outcome::from(error), reason)
        }
    }

    /// The row with an outcome and its reason.
    pub(crate) fn ended(self, outcome: Outcome, reason: String) -> Self {
        Self {
            outcome,
            reason: Some(reason),
            ..self
        }
    }
}

/// Outcome of a row. The words are those of `sweep`, and one more.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, PartialOrd, Ord, Hash, Serialize, Deserialize)]
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
    #[default]
    Error,
    /// The program failed on this row, which is a fault of the program.
    Crashed,
}

impl Outcome {
    /// All outcomes.
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

    /// Outcome of a layout that was planned and judged.
    #[must_use]
    pub fn judged(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Pass => Self::Proved,
            Verdict::Fail => Self::NotProved,
        }
    }
}

impl From<&Failure> for Outcome {
    /// Outcome of a layout without a plan, or with a plan that could not be judged.
    fn from(error: &Failure) -> Self {
        match error.infeasibility() {
            Some(Infeasibility::Proved) => Self::Infeasible,
            Some(Infeasibility::NotFound) => Self::NotFound,
            None => Self::Error,
        }
    }
}

/// The place of a reason; fields that do not apply are `None`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The requirement that is not kept, as in a certificate.
    pub requirement: Option<Requirement>,
    /// Index of the plate.
    pub plate: Option<usize>,
    /// Index of the plan's segment.
    pub segment: Option<usize>,
    /// Index of the waypoint, from 0, on the line over the plate that the arm does not follow.
    pub waypoint: Option<usize>,
    /// Time in the plan \[s\].
    pub time_s: Option<f64>,
    /// The place, world frame \[m\]: of a plan, where it is worst; of a plate that cannot be washed, the first point of its wash path
    /// for which no configuration was found.
    pub point_m: Option<[f64; 3]>,
}

impl Place {
    /// Place of the first requirement that is not kept.
    pub(crate) fn of_certificate(certificate: &Certificate) -> Self {
        let place = certificate.broken().next().map(|check| Self {
            requirement: Some(check.requirement),
            plate: check.worst.plate,
            segment: check.worst.segment.map(|(index, _)| index),
            waypoint: None,
            time_s: check.worst.time_s,
            point_m: check.worst.place_m,
        });
        place.unwrap_or_default()
    }

    /// Place of the obstruction of a plan.
    fn of_failure(failure: &Failure, report: Option<&InfeasibleReport>) -> Self {
        let Failure::Plan(error) = failure else {
            return Self::default();
        };
        let point_m = match error {
            PlanError::Unwashable(plate) => plate.dead_m.first().copied(),
            _ => None,
        };
        let waypoint = match error {
            PlanError::Line { error, .. } => waypoint(error),
            _ => None,
        };
        Self {
            plate: report.and_then(|report| Some(report.plates.first()?.plate)),
            waypoint,
            point_m,
            ..Self::default()
        }
    }
}

fn waypoint(error: &IkPathError) -> Option<usize> {
    match error {
        IkPathError::Waypoint { waypoint, .. } | IkPathError::Broken { waypoint, .. } => Some(*waypoint),
        _ => None,
    }
}

/// Choice of the plans that a study keeps beside its rows: the key `plans` of a study file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlanChoice {
    /// No plan: a row has its hash, and `study scenario` makes it again.
    #[default]
    None,
    /// The plans that are not proved.
    Failed,
    /// Every plan.
    All,
}

impl PlanChoice {
    /// Checks that the plan of a row is kept; a row without a plan has none to keep.
    #[must_use]
    pub fn keeps_plan_of(self, row: &Row) -> bool {
        row.plan.is_some()
            && match self {
                Self::None => false,
                Self::Failed => row.outcome == Outcome::NotProved,
                Self::All => true,
            }
    }
}

/// A row, and the plan where the study keeps it.
#[derive(Debug, Clone, PartialEq)]
pub struct RowWithPlan {
    /// Result of the scenario.
    pub row: Row,
    /// The plan's file, as `run` writes `plan.json`; there exactly where [`PlanChoice::keeps_plan_of`](crate::PlanChoice::keeps_plan_of) it.
    pub plan: Option<Vec<u8>>,
}

impl From<Row> for RowWithPlan {
    /// A row whose plan is not kept.
    fn from(row: Row) -> Self {
        Self { row, plan: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platewash_kinematics::ik::PathBreak;

    #[test]
    fn reports_plate_and_waypoint_where_a_line_breaks_off() {
        let error = IkPathError::Broken {
            waypoint: 7,
            reason: PathBreak::Limit { joint: 4 },
            solved: Vec::new(),
        };
        let error = Box::new(error);
        let line = PlanError::Line {
            plate: 2,
            lift_m: 0.05,
            error,
        };
        let failure = Failure::Plan(line);
        let place = Place::of_failure(&failure, failure.report("", 0).as_ref());
        assert_eq!((place.plate, place.waypoint), (Some(2), Some(7)));
    }
}
