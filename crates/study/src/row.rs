//! A row: what came of one scenario of a study. `docs/studies.md` says what each field means; they change with [`ROW_SCHEMA`] alone.

use crate::outcome::Outcome;
use crate::place::Place;
use platewash_certificate::{Certificate, Requirement};
use platewash_planner::Planned;
use platewash_scenario::Failure;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// The version of rows. Fields are added, taken away or given another meaning only with another number.
pub const ROW_SCHEMA: u32 = 2;

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
            swept: None,
            pressed: None,
            clearance_m: None,
            clearance_pair: None,
            plan: None,
        }
    }

    /// The row as a line of JSON, without its end: the same bytes for the same row.
    #[must_use]
    pub fn line(&self) -> String {
        // Its keys are texts, and its numbers finite or null: there is nothing that JSON cannot say.
        serde_json::to_string(self).unwrap_or_default()
    }

    /// With what came of a plan.
    pub(crate) fn planned(self, planned: &Planned, certificate: &Certificate) -> Self {
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

    /// With why there is no plan.
    pub(crate) fn failed(self, error: &Failure) -> Self {
        Self {
            place: Place::of_failure(error),
            ..self.ended(Outcome::from(error), error.to_string())
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
