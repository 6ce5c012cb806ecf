//! What is reported of a job that cannot be done, or that no way was found to do: why, and what of each plate concerned.

use super::{CycleError, Elsewhere, UnwashablePlate};
use crate::crossing::CrossingError;
use crate::error::{Infeasibility, PlanError};
use crate::posture::washable::Cause;
use crate::posture::{Conclusion, Filter, Obstacle};
use crate::report::Verdict;
use crate::scenario::Scenario;
use serde::Serialize;
use std::fmt;

/// A certified job of which no plan came. Lengths in metres, angles in radians.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfeasibleReport {
    /// Name of the scenario.
    pub scenario: String,
    /// Its seed.
    pub seed: u64,
    /// [`Verdict::Infeasible`] where the job cannot be done, [`Verdict::NotFound`] where no way was found to do it.
    pub verdict: Verdict,
    /// The first line.
    pub headline: String,
    /// Why, in full.
    pub reason: String,
    /// The plates concerned; none where it is no plate that stands in the way.
    pub plates: Vec<InfeasiblePlate>,
}

/// A plate because of which a job cannot be done.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfeasiblePlate {
    /// The plate.
    pub plate: usize,
    /// Its centre \[m\], where it cannot be washed whole.
    pub centre_m: Option<[f64; 2]>,
    /// Share of its stroke for which a posture was found.
    pub washable_share: Option<f64>,
    /// Whether the rest is known to be beyond the arm, and by what; `None` where the plate itself can be washed.
    pub conclusion: Option<Conclusion>,
    /// What keeps the rest from being washed.
    pub causes: Vec<InfeasiblePart>,
    /// The nearest centre found at which it can be washed \[m\].
    pub nearest_m: Option<[f64; 2]>,
    /// How that was looked for; `None` where the plate itself can be washed.
    pub elsewhere: Option<Elsewhere>,
}

/// A part of a stroke for which no posture was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfeasiblePart {
    /// Share of the stroke.
    pub share: f64,
    /// Least and greatest distance of the part from axis 1 \[m\].
    pub from_axis_m: [f64; 2],
    /// The kind of obstacle.
    pub kind: Filter,
    /// By how much the worst point is missed \[m\]; `None` for joints.
    pub shortfall_m: Option<f64>,
    /// By how much the worst joint is off \[rad\]; `None` for lengths.
    pub shortfall_rad: Option<f64>,
    /// The same in words.
    pub cause: String,
}

impl InfeasibleReport {
    /// What is to be said of a job that ended with `error`; `None` where the error is one of the input.
    #[must_use]
    pub fn new(scenario: &Scenario, error: &PlanError) -> Option<Self> {
        let reason = error.to_string();
        let (verdict, word) = match error.infeasibility()? {
            Infeasibility::Proved => (Verdict::Infeasible, "INFEASIBLE"),
            Infeasibility::NotFound => (Verdict::NotFound, "NOT FOUND"),
        };
        Some(Self {
            scenario: scenario.name.clone(),
            seed: scenario.seed,
            verdict,
            headline: format!("{word}: {reason}"),
            reason,
            plates: plates(error),
        })
    }
}

impl fmt::Display for InfeasibleReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        writeln!(f, "scenario {}, seed {}: nothing was planned", self.scenario, self.seed)
    }
}

fn plates(error: &PlanError) -> Vec<InfeasiblePlate> {
    let PlanError::Cycle(error) = error else {
        return Vec::new();
    };
    match error {
        CycleError::Unwashable(plate) => vec![InfeasiblePlate::from(&**plate)],
        CycleError::Line { plate, .. }
        | CycleError::Tilt { plate, .. }
        | CycleError::Crossing(CrossingError::Line { plate, .. }) => {
            vec![InfeasiblePlate::reached_in_vain(*plate)]
        }
        CycleError::Crossing(CrossingError::NoWay { from, to, .. }) => {
            let ends = from.iter().chain(to);
            ends.map(|plate| InfeasiblePlate::reached_in_vain(*plate)).collect()
        }
        _ => Vec::new(),
    }
}

impl InfeasiblePlate {
    /// A plate that could be washed if the arm got there and away.
    fn reached_in_vain(plate: usize) -> Self {
        Self {
            plate,
            centre_m: None,
            washable_share: None,
            conclusion: None,
            causes: Vec::new(),
            nearest_m: None,
            elsewhere: None,
        }
    }
}

impl From<&UnwashablePlate> for InfeasiblePlate {
    fn from(plate: &UnwashablePlate) -> Self {
        Self {
            plate: plate.plate,
            centre_m: Some(plate.centre_m),
            washable_share: plate.share,
            conclusion: Some(plate.conclusion),
            causes: plate
                .causes
                .iter()
                .map(|cause| InfeasiblePart::new(cause, plate.conclusion))
                .collect(),
            nearest_m: plate.nearest_m,
            elsewhere: Some(plate.elsewhere),
        }
    }
}

impl InfeasiblePart {
    fn new(cause: &Cause, conclusion: Conclusion) -> Self {
        let shortfall = cause.worst.shortfall();
        let (shortfall_m, shortfall_rad) = match cause.worst {
            Obstacle::Limit(_) | Obstacle::Jump { .. } => (None, Some(shortfall)),
            Obstacle::NotFinite => (None, None),
            _ => (Some(shortfall), None),
        };
        Self {
            share: cause.share,
            from_axis_m: cause.from_axis_m,
            kind: cause.worst.filter(),
            shortfall_m,
            shortfall_rad,
            cause: cause.words(conclusion),
        }
    }
}
