//! Patterns of wash curves, and what each of them states.
//!
//! A pattern is a file: its path, the numbers of a plan file with their ranges, its rules for the keys of a job, and the curves that a planner
//! tries. Another one is its file, its lines here, and its field of a plan file in `FlatCurve`.

use crate::surface::Surface;
use crate::wash_path::rings::Rings;
use crate::wash_path::spiral::Spiral;
use crate::wash_path::{WashCurve, rings, spiral};
use serde::{Deserialize, Serialize};

/// Pattern of a wash curve, with its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum WashPattern {
    /// A spiral from the pole.
    Spiral,
    /// Rings about the pole, joined by blends.
    Rings(Rings),
}

/// Names of the patterns, as jobs and files state them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PatternName {
    /// A spiral from the centre.
    Spiral,
    /// Rings about the centre, joined by blends.
    Rings,
}

/// Calls a method of the pattern's own type.
macro_rules! of_pattern {
    ($pattern:expr, $path:ident => $call:expr) => {
        match $pattern {
            $crate::wash_path::pattern::WashPattern::Spiral => {
                let $path = &$crate::wash_path::spiral::Spiral;
                $call
            }
            $crate::wash_path::pattern::WashPattern::Rings($path) => $call,
        }
    };
}
pub(crate) use of_pattern;

impl PatternName {
    /// All patterns, in the order in which a planner tries them.
    pub const ALL: [Self; 2] = [Self::Rings, Self::Spiral];

    /// Names, as files state them.
    pub const NAMES: [&'static str; 2] = [Spiral::RULES.name, Rings::RULES.name];

    /// Rules of the pattern.
    #[must_use]
    pub fn rules(self) -> PatternRules {
        match self {
            Self::Spiral => Spiral::RULES,
            Self::Rings => Rings::RULES,
        }
    }

    /// Lists the curves of the pattern that a request leaves open, with the greatest trim.
    #[must_use]
    pub fn candidates(self, request: &CandidateRequest<'_>) -> Vec<WashCurve> {
        match self {
            Self::Spiral => spiral::candidates(request),
            Self::Rings => rings::candidates(request),
        }
    }

    /// Returns the pattern that a job asks for: the one that it states, or a spiral where it states the numbers of a curve and no pattern.
    #[must_use]
    pub fn asked(stated: Option<Self>, numbers: &StatedNumbers) -> Option<Self> {
        stated.or(numbers.is_any().then_some(Self::Spiral))
    }
}

/// Rules of a pattern for what a job states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatternRules {
    /// Name, as files state it.
    pub name: &'static str,
    /// Rule for the turns that a job states.
    pub turns: TurnsRule,
    /// True if the closing ring is part of the pattern.
    pub always_closes: bool,
    /// True if the path can go over each place several times, as a soil may ask.
    pub repeats: bool,
}

/// Rule for the turns that a job states.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TurnsRule {
    /// Any number within the range of all curves.
    Any,
    /// A whole number from 1 on.
    Whole {
        /// Things that the turns count, in words.
        counted: &'static str,
        /// The greatest number.
        most: usize,
    },
}

/// Density with which a curve covers a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Density {
    /// Density for a usual job.
    Usual,
    /// Denser than that.
    Dense,
}

/// Numbers of a curve that a job states; a planner chooses the others.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StatedNumbers {
    /// Turns, as the pattern counts them: [`TurnsRule`].
    pub turns: Option<f64>,
    /// Greatest ℓ \[m\].
    pub path_radius_m: Option<f64>,
    /// True if a circle at the greatest ℓ closes the curve.
    pub closing_ring: Option<bool>,
}

impl StatedNumbers {
    /// True if the job states one of them.
    #[must_use]
    pub fn is_any(&self) -> bool {
        self.turns.is_some() || self.path_radius_m.is_some() || self.closing_ring.is_some()
    }
}

/// Request for the curves that a planner may choose from.
#[derive(Debug, Clone, Copy)]
pub struct CandidateRequest<'a> {
    /// Numbers that are kept.
    pub stated: StatedNumbers,
    /// Face of the plate.
    pub surface: &'a Surface,
    /// Radius of the sponge \[m\].
    pub sponge_m: f64,
    /// Density of the curves.
    pub density: Density,
    /// Number of times that the path goes over each place.
    pub laps: u32,
}

/// Distances of the outermost winding from the rim that are tried, in sponge radii.
const INSETS: [f64; 6] = [0.95, 0.92, 0.85, 0.77, 0.7, 0.5];

/// Trims of the closing ring that are tried \[rad\], the greatest first: the blend before it covers some of its beginning.
pub const TRIMS_RAD: [f64; 3] = [0.55, 0.4, 0.2];

impl CandidateRequest<'_> {
    /// Greatest ℓ: the one stated, or those tried \[m\].
    pub(crate) fn outer_m(&self) -> Vec<f64> {
        let arc_m = self.surface.arc_m();
        match self.stated.path_radius_m {
            Some(radius_m) => vec![radius_m],
            None => INSETS
                .iter()
                .map(|inset| (arc_m - inset * self.sponge_m).max(0.3 * arc_m))
                .collect(),
        }
    }
}

/// Number of a curve: its name in a plan file, its value, and the least and greatest that can be judged.
pub type CurveNumber = (&'static str, f64, [f64; 2]);

/// Path of a pattern: ℓ as a function of θ.
pub(crate) trait PatternPath {
    /// Number of times that the path goes over each place.
    fn laps(&self) -> u32 {
        1
    }

    /// θ at which the closing ring begins \[rad\].
    fn end(&self, curve: &WashCurve) -> f64;

    /// Distance between neighbouring windings along the meridian \[m\].
    fn pitch_m(&self, curve: &WashCurve) -> f64;

    /// Returns ℓ and its first two derivatives by θ \[m, m/rad, m/rad²\].
    fn arc(&self, curve: &WashCurve, theta: f64) -> [f64; 3];

    /// Upper bound on ℓ between two θ \[m\]. A pattern whose ℓ falls must look for the greatest in between: the proof of the path
    /// deviation rests on it.
    fn greatest_arc(&self, curve: &WashCurve, between: [f64; 2]) -> f64;

    /// Upper bounds on |ℓ′| and |ℓ″| between two θ \[m/rad, m/rad²\].
    fn greatest_rates(&self, curve: &WashCurve, between: [f64; 2]) -> [f64; 2];

    /// Upper bound on the second derivative by θ of the point on a flat face between two θ \[m/rad²\], where there is a closer one than for
    /// any curve.
    fn greatest_second_flat(&self, _curve: &WashCurve, _between: [f64; 2]) -> Option<f64> {
        None
    }

    /// Angle of a blend that bends more than what is before it \[rad\]; `None` without blends.
    fn blend_rad(&self) -> Option<f64> {
        None
    }

    /// Numbers of the pattern beside those that every curve has.
    fn numbers(&self, _curve: &WashCurve) -> Vec<CurveNumber> {
        Vec::new()
    }

    /// The pattern in words, with its count.
    fn words(&self, curve: &WashCurve) -> String;
}
