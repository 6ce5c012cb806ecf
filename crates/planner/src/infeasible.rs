//! Report of a job that cannot be done, or that no way was found to do: the reason, and the findings on each plate concerned.

use crate::error::PlanError;
use crate::placed_arm::{Filter, Hindrance};
use crate::redundancy::washability::Cause;
use crate::transit::TransitError;
use crate::unwashable_plate::Conclusion;
use crate::unwashable_plate::PlaceSearch;
use crate::unwashable_plate::UnwashablePlate;
use platewash_workcell::verdict::{Infeasibility, Verdict};
use platewash_workcell::words::quoted;
use serde::Serialize;
use std::fmt;

/// A job of which no plan came. Lengths in metres, angles in radians.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfeasibleReport {
    /// Name of the scenario.
    pub scenario: String,
    /// Seed of the job.
    pub seed: u64,
    /// [`Verdict::Infeasible`] where the job cannot be done, [`Verdict::NotFound`] where no way was found to do it.
    pub verdict: Verdict,
    /// The first line.
    pub headline: String,
    /// Reason in full, in words.
    pub reason: String,
    /// The plates concerned; none where it is no plate that stands in the way.
    pub plates: Vec<InfeasiblePlate>,
}

/// A plate because of which a job cannot be done.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct InfeasiblePlate {
    /// The plate.
    pub plate: usize,
    /// Its centre \[m\], where it cannot be washed whole.
    pub centre_m: Option<[f64; 2]>,
    /// Share of its wash path for which configurations were found.
    pub washable_share: Option<f64>,
    /// Conclusion about the plate; `None` where the plate itself can be washed.
    pub conclusion: Option<Conclusion>,
    /// Lower bound on the share of its face that no wash path reaches; `None` where the plate itself can be washed.
    pub beyond_reach_share: Option<f64>,
    /// Share of its face that the job requires to be swept and pressed; `None` where the plate itself can be washed.
    pub required_share: Option<f64>,
    /// Obstructions on the rest of the wash path, by part.
    pub causes: Vec<InfeasiblePart>,
    /// The nearest centre found at which it can be washed \[m\].
    pub nearest_m: Option<[f64; 2]>,
    /// Extent of the search for another place; `None` where the plate itself can be washed.
    pub place_search: Option<PlaceSearch>,
}

/// A part of a wash path for which no configurations were found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfeasiblePart {
    /// Share of the wash path.
    pub share: f64,
    /// Least and greatest distance of the part from axis 1 \[m\].
    pub from_axis_m: [f64; 2],
    /// Hindrance at most of the tilts.
    #[serde(flatten)]
    pub first: InfeasibleHindrance,
    /// Hindrances at the other tilts.
    pub others: Vec<InfeasibleHindrance>,
    /// The cause in words.
    pub cause: String,
}

/// Hindrance on a part of a wash path, at its worst point.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct InfeasibleHindrance {
    /// The kind of hindrance.
    pub kind: Filter,
    /// Shortfall of the worst point \[m\]; `None` for joints.
    pub shortfall_m: Option<f64>,
    /// Shortfall of the worst joint \[rad\]; `None` for lengths.
    pub shortfall_rad: Option<f64>,
}

impl InfeasibleReport {
    /// Report of a job that ended with `error`, with the name of its scenario and its seed; `None` where the error is one of the
    /// input.
    #[must_use]
    pub fn new(scenario: &str, seed: u64, error: &PlanError) -> Option<Self> {
        let verdict = match error.infeasibility()? {
            Infeasibility::Proved => Verdict::Infeasible,
            Infeasibility::NotFound => Verdict::NotFound,
        };
        let report = Self {
            scenario: scenario.to_owned(),
            seed,
            verdict,
            headline: String::new(),
            reason: String::new(),
            plates: plates(error),
        };
        Some(report.explained(error.to_string()))
    }

    /// The same report with further plates that stand in the way.
    #[must_use]
    pub fn with_plates(mut self, others: &[UnwashablePlate]) -> Self {
        for other in others {
            if other.is_proved() {
                self.verdict = Verdict::Infeasible;
            }
            self.plates.push(other.into());
            self.reason = format!("{}; besides, {other}", self.reason);
        }
        let reason = std::mem::take(&mut self.reason);
        self.explained(reason)
    }

    /// The same report with the reason in other words.
    #[must_use]
    pub fn explained(self, reason: String) -> Self {
        let word = match self.verdict {
            Verdict::Infeasible => "INFEASIBLE",
            _ => "NOT FOUND",
        };
        let headline = format!("{word}: {reason}");
        Self {
            headline,
            reason,
            ..self
        }
    }
}

impl fmt::Display for InfeasibleReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        writeln!(
            f,
            "scenario {}, seed {}: nothing was planned",
            quoted(&self.scenario),
            self.seed
        )
    }
}

fn plates(error: &PlanError) -> Vec<InfeasiblePlate> {
    match error {
        PlanError::Unwashable(plate) => vec![InfeasiblePlate::from(&**plate)],
        PlanError::Overlap(overlaps) => {
            let mut plates: Vec<usize> = overlaps
                .iter()
                .flat_map(|o| [Some(o.plate), o.other])
                .flatten()
                .collect();
            plates.sort_unstable();
            plates.dedup();
            plates
                .into_iter()
                .map(InfeasiblePlate::unreachable_by_transit)
                .collect()
        }
        PlanError::Line { plate, .. }
        | PlanError::Promise { plate, .. }
        | PlanError::Tilt { plate, .. }
        | PlanError::Transit(TransitError::Line { plate, .. }) => {
            vec![InfeasiblePlate::unreachable_by_transit(*plate)]
        }
        PlanError::Transit(TransitError::NotFound { from, to, .. }) => {
            let ends = from.iter().chain(to);
            ends.map(|plate| InfeasiblePlate::unreachable_by_transit(*plate))
                .collect()
        }
        _ => Vec::new(),
    }
}

impl InfeasiblePlate {
    /// A plate that could be washed if the arm got there and away, or if nothing else lay there.
    fn unreachable_by_transit(plate: usize) -> Self {
        Self {
            plate,
            ..Self::default()
        }
    }
}

impl From<&UnwashablePlate> for InfeasiblePlate {
    fn from(plate: &UnwashablePlate) -> Self {
        Self {
            plate: plate.plate,
            centre_m: Some(plate.centre_m),
            washable_share: plate.share,
            conclusion: Some(plate.conclusion()),
            beyond_reach_share: Some(plate.beyond_reach_share),
            required_share: Some(plate.required_share),
            causes: plate.causes.iter().filter_map(InfeasiblePart::new).collect(),
            nearest_m: plate.nearest_m,
            place_search: Some(plate.place_search),
        }
    }
}

impl InfeasiblePart {
    fn new(cause: &Cause) -> Option<Self> {
        let (first, others) = cause.worst.split_first()?;
        Some(Self {
            share: cause.share,
            from_axis_m: cause.from_axis_m,
            first: first.into(),
            others: others.iter().map(InfeasibleHindrance::from).collect(),
            cause: cause.to_string(),
        })
    }
}

impl From<&Hindrance> for InfeasibleHindrance {
    fn from(worst: &Hindrance) -> Self {
        let shortfall = worst.shortfall();
        let (shortfall_m, shortfall_rad) = match worst {
            Hindrance::Limit(_) | Hindrance::Jump { .. } | Hindrance::Wrist { .. } | Hindrance::Cone { .. } => {
                (None, Some(shortfall))
            }
            Hindrance::NotFinite => (None, None),
            Hindrance::Reach(_) | Hindrance::Unsolved { .. } | Hindrance::Clearance { .. } => (Some(shortfall), None),
        };
        Self {
            kind: worst.filter(),
            shortfall_m,
            shortfall_rad,
        }
    }
}
