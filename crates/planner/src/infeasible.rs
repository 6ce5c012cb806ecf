//! Report of a job that cannot be done, or that no way was found to do: the reason, and the findings on each plate concerned.
//!
//! Findings on a plate for which no way was found to wash it whole: the part at fault, the cause, the firmness of the conclusion,
//! and another place at which it could be washed.

use crate::error::PlanError;
use crate::redundancy::RedundancyError;
use crate::redundancy::washability::Cause;
use crate::scene::{Filter, Hindrance};
use crate::transit::TransitError;
use platewash_kinematics::words::{decimals_down, decimals_up};
use platewash_workcell::verdict::{Infeasibility, Verdict};
use platewash_workcell::words::{plate_name, quoted};
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

/// Conclusion about a plate for which no way to wash it was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Conclusion {
    /// It cannot be washed: more of its face than may be left is beyond the arm on every wash path.
    BeyondReach,
    /// Nothing was found, and nothing is proved. Other paths and other configurations may do.
    NotFound,
}

/// Findings on a plate that cannot be washed, or for which no way to wash it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct UnwashablePlate {
    /// The plate.
    pub plate: usize,
    /// Its centre \[m\].
    pub centre_m: [f64; 2],
    /// Error with which the search for its configurations ended.
    pub error: RedundancyError,
    /// Lower bound on the share of its face that no wash path reaches: see
    /// [`share_beyond_reach`](crate::redundancy::beyond_reach::share_beyond_reach).
    pub beyond_reach_share: f64,
    /// Share of its face that the job requires to be swept and pressed.
    pub required_share: f64,
    /// Greatest tilt of the tool that the bound rests on \[rad\].
    pub tilt_max_rad: f64,
    /// Share of the wash path that was tried for which configurations were found, point by point.
    pub share: Option<f64>,
    /// Obstructions on the rest of that path, the most frequent first.
    pub causes: Vec<Cause>,
    /// Contact points with a configuration on the best branch of the arm, checked one by one, world frame \[m\]. Without a
    /// `share` none were checked, here and in `dead_m`.
    pub free_m: Vec<[f64; 3]>,
    /// Contact points without a configuration \[m\].
    pub dead_m: Vec<[f64; 3]>,
    /// Nearest centre found at which it can be washed whole, and which the arm reaches and leaves \[m\]. It is on a grid of a
    /// millimetre, so that the printed place is the place that was tried.
    pub nearest_m: Option<[f64; 2]>,
    /// Extent of the search for another place.
    pub place_search: PlaceSearch,
}

/// Extent of the search for another place of a plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PlaceSearch {
    /// Search on rings up to this distance from its own place \[m\].
    Within(f64),
    /// No search: the job does not ask for it.
    Off,
    /// No search yet: the job asks for it, but the caller did not wait for it.
    Later,
}

/// Excess of the share beyond the arm over the share that may be left, which rounding may give.
const ROUNDING: f64 = 1e-9;

/// A share that is at least `beyond` and one that is at most `left`, below it, in percent: with as many decimals as tell them apart.
fn shares_in_percent(beyond: f64, left: f64) -> [String; 2] {
    const MOST_DECIMALS: usize = 9;
    let told = |decimals| {
        [
            decimals_down(100.0 * beyond, decimals),
            decimals_up(100.0 * left, decimals),
        ]
    };
    let differ = |[beyond, left]: &[String; 2]| beyond != left;
    let enough = (1..MOST_DECIMALS).map(told).find(differ);
    enough.unwrap_or_else(|| told(MOST_DECIMALS))
}

impl UnwashablePlate {
    /// Returns true where it is proved that no plan of the job washes the plate.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        self.beyond_reach_share > 1.0 - self.required_share + ROUNDING
    }

    /// Returns the conclusion.
    #[must_use]
    pub fn conclusion(&self) -> Conclusion {
        match self.is_proved() {
            true => Conclusion::BeyondReach,
            false => Conclusion::NotFound,
        }
    }

    /// Returns the reason in words that it cannot be washed, or that no way was found; without another place for it.
    #[must_use]
    pub fn reason_text(&self) -> String {
        let ([x, y], plate, is_proved) = (self.centre_m, plate_name(self.plate), self.is_proved());
        let [beyond, left] = shares_in_percent(self.beyond_reach_share, 1.0 - self.required_share);
        let tilt_deg = self.tilt_max_rad.to_degrees();
        let verdict = match is_proved {
            true => format!(
                "{plate} at ({x:.3}, {y:.3}) m cannot be washed: at least {beyond} % of its face is beyond the arm's links with \
                 every wash path and tilts up to {tilt_deg:.1}°, and {left} % may be left"
            ),
            false => format!(
                "no way to wash {plate} at ({x:.3}, {y:.3}) m whole was found, which does not prove that there is none"
            ),
        };
        let sign = if is_proved { ";" } else { ":" };
        let found = match self.share.map(|share| 100.0 * share) {
            Some(percent) => {
                format!("{sign} configurations were found for {percent:.1} % of the wash path that was tried")
            }
            None => format!(": {}", self.error),
        };
        let causes: String = self.causes.iter().map(|cause| format!("; {cause}")).collect();
        verdict + &found + &causes
    }
}

impl fmt::Display for UnwashablePlate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason_text())?;
        match (self.nearest_m, self.place_search) {
            (Some([x, y]), _) => write!(
                f,
                "; the nearest position found where the arm can follow its wash path is ({x:.3}, {y:.3}) m"
            ),
            (None, PlaceSearch::Within(most_m)) => {
                write!(
                    f,
                    "; no position where the arm can follow its wash path was found within {most_m} m of it"
                )
            }
            (None, PlaceSearch::Off) => f.write_str("; no other position was looked for"),
            (None, PlaceSearch::Later) => f.write_str("; another position was not looked for here"),
        }
    }
}
