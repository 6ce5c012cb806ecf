//! A plate for which no way was found to wash it whole: the part at fault, the cause, the firmness of the conclusion, and another
//! place at which it could be washed.

use crate::redundancy::RedundancyError;
use crate::redundancy::washability::Cause;
use platewash_kinematics::words::{decimals_down, decimals_up};
use platewash_workcell::words::plate_name;
use serde::Serialize;
use std::fmt;

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
