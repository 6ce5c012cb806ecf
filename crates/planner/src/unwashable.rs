//! A plate for which no way was found to wash it whole: which part of it, why, whether that is known, and where it could be washed.

use crate::redundancy::washable::Cause;
use crate::redundancy::{Conclusion, RedundancyError};
use serde::Serialize;
use std::fmt;

/// What is known of a plate that cannot be washed whole, or for which no way to was found.
#[derive(Debug, Clone, PartialEq)]
pub struct UnwashablePlate {
    /// The plate.
    pub plate: usize,
    /// Its centre \[m\].
    pub centre_m: [f64; 2],
    /// Where the search for its configurations ended.
    pub error: RedundancyError,
    /// Whether it is known that it cannot be.
    pub conclusion: Conclusion,
    /// Share of the wash path for which configurations were found, point by point.
    pub share: Option<f64>,
    /// What keeps the rest from being washed, the most frequent first.
    pub causes: Vec<Cause>,
    /// Contact points, world frame \[m\], looked at one by one: those for which configurations were found on the best branch of
    /// the arm. Without a `share` none were looked at, here and in `dead_m`.
    pub free_m: Vec<[f64; 3]>,
    /// Those for which none were.
    pub dead_m: Vec<[f64; 3]>,
    /// The nearest centre found at which it can be washed whole, and the arm gets there and away \[m\]; on a grid of a
    /// millimetre, so that what is printed is what was tried.
    pub nearest_m: Option<[f64; 2]>,
    /// How that was looked for.
    pub place_search: PlaceSearch,
}

/// How another place for a plate was looked for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PlaceSearch {
    /// On rings up to this distance from where it lies \[m\].
    Within(f64),
    /// Not at all: the job does not ask for it.
    Off,
    /// Not yet: the job asks for it, but whoever asked for an answer did not wait for it.
    Later,
}

/// Why a plate cannot be washed, without another place for it.
struct Why<'a>(&'a UnwashablePlate);

impl UnwashablePlate {
    /// Why it cannot be washed, or that no way to was found, in words; without another place for it.
    #[must_use]
    pub fn why(&self) -> impl fmt::Display + '_ {
        Why(self)
    }
}

impl fmt::Display for Why<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(of) = self;
        let ([x, y], plate) = (of.centre_m, of.plate);
        let percent = of.share.map(|share| 100.0 * share);
        match (of.conclusion.is_proved(), percent) {
            (true, Some(percent)) => write!(
                f,
                "plate {plate} at ({x:.3}, {y:.3}) m cannot be washed whole: {percent:.1} % of its wash path can"
            )?,
            (false, Some(percent)) => write!(
                f,
                "no way to wash plate {plate} at ({x:.3}, {y:.3}) m whole was found, which does not prove that there is none: \
                 configurations were found for {percent:.1} % of its wash path"
            )?,
            (_, None) => write!(
                f,
                "no way to wash plate {plate} at ({x:.3}, {y:.3}) m whole was found, which does not prove that there is none: {}",
                of.error
            )?,
        }
        for cause in &of.causes {
            write!(f, "; {}", cause.words(of.conclusion))?;
        }
        Ok(())
    }
}

impl fmt::Display for UnwashablePlate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.why().fmt(f)?;
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
