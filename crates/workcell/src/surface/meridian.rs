//! Meridian by knots: arcs and lines, one after the other, with a continuous slope.
//!
//! Between knots (ρ, β), radius and slope, sin β is linear in ρ. With κ = Δ sin β / Δρ every piece is an arc of curvature κ, or a line
//! where κ = 0, and neighbours share their slope. The first knot is the pole, (0, 0), and is not stated. From a knot on,
//! with ℓ the length along the meridian and m = (β₀ + β)/2:
//!
//! - Δz = (cos β₀ − cos β)/κ = Δρ (sin β₀ + sin β)/(cos β₀ + cos β),
//! - ℓ = (β − β₀)/κ, sin((β − β₀)/2) = κ Δρ / (2 cos m),
//! - the curvature along the meridian is κ, that across it sin β / ρ,
//! - the area is 2π ∫ ρ dℓ.

use platewash_kinematics::trig::{asin, cos, sin, sin_cos};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use thiserror::Error;
use ts_rs::TS;

/// Greatest number of knots of a meridian, without the pole.
pub const MOST_KNOTS: usize = 16;

/// Greatest slope of a meridian \[rad\]: 60°. Walls of bowls are steeper.
pub const STEEPEST_RAD: f64 = PI / 3.0;

/// Least radius of curvature of a meridian \[m\]. Real edges are not sharper, and sharper ones take too long to prove.
pub const SHARPEST_M: f64 = 1e-4;

/// Greatest radius of a meridian \[m\].
const GREATEST_M: f64 = 1e3;

/// Positive nodes of the Gauss–Legendre rule of eight points on [−1, 1], with their weights.
const GAUSS: [[f64; 2]; 4] = [
    [0.183_434_642_495_649_8, 0.362_683_783_378_362],
    [0.525_532_409_916_329, 0.313_706_645_877_887_3],
    [0.796_666_477_413_626_7, 0.222_381_034_453_374_47],
    [0.960_289_856_497_536_2, 0.101_228_536_290_376_26],
];

/// Knot of a meridian.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Knot {
    /// Distance from the axis \[m\].
    pub radius_m: f64,
    /// Slope of the face there, above 0 if it rises outwards \[rad\].
    pub slope_rad: f64,
}

/// Point of a meridian.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeridianPoint {
    /// Distance ρ from the axis \[m\].
    pub radius_m: f64,
    /// Height over the pole \[m\].
    pub height_m: f64,
    /// sin β.
    pub sine: f64,
    /// cos β.
    pub cosine: f64,
    /// Curvature along the meridian, above 0 if the face is hollow \[1/m\].
    pub curvature: f64,
}

/// Ranges of slope and curvature on a part of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Patch {
    /// Least and greatest sin β.
    pub sine: [f64; 2],
    /// Least and greatest curvature, along and across the meridian \[1/m\].
    pub curvature: [f64; 2],
}

impl Patch {
    /// Patch of a flat face.
    pub const FLAT: Self = Self {
        sine: [0.0; 2],
        curvature: [0.0; 2],
    };

    /// Empty patch, the start value of a fold.
    const NONE: Self = Self {
        sine: [f64::INFINITY, f64::NEG_INFINITY],
        curvature: [f64::INFINITY, f64::NEG_INFINITY],
    };

    fn see_sine(&mut self, sine: f64) {
        self.sine = [self.sine[0].min(sine), self.sine[1].max(sine)];
    }

    fn see_curvature(&mut self, curvature: f64) {
        self.curvature = [self.curvature[0].min(curvature), self.curvature[1].max(curvature)];
    }

    /// Least cos β.
    #[must_use]
    pub fn least_cosine(&self) -> f64 {
        let sine = self.sine[0].abs().max(self.sine[1].abs());
        (1.0 - sine * sine).max(0.0).sqrt()
    }

    /// Greatest magnitude of the curvature \[1/m\].
    #[must_use]
    pub fn greatest_curvature(&self) -> f64 {
        self.curvature[0].abs().max(self.curvature[1].abs())
    }
}

/// Meridian by knots.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(try_from = "MeridianFields", into = "MeridianFields")]
#[ts(as = "MeridianFields")]
pub struct Meridian {
    count: usize,
    knots: [Knot; MOST_KNOTS],
    /// Points at the pole and at each knot, each with the curvature of the piece that begins there, and its ℓ \[m\].
    starts: [(MeridianPoint, f64); MOST_KNOTS + 1],
}

/// Reason that a list of knots is no valid meridian.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum MeridianError {
    /// There is no knot, or there are too many.
    #[error("a profile has from 1 to {MOST_KNOTS} knots; found {found}")]
    Count {
        /// Number of knots found.
        found: usize,
    },
    /// The radii do not grow.
    #[error(
        "knot {knot} of the profile: radius {found_m} m, expected more than {before_m} m, that of the knot before, and at most 1000 m"
    )]
    Radius {
        /// Index of the knot.
        knot: usize,
        /// Radius of the knot \[m\].
        found_m: f64,
        /// Radius of the knot before, or of the pole \[m\].
        before_m: f64,
    },
    /// A slope is too steep.
    #[error(
        "knot {knot} of the profile: slope {found_rad} rad, expected from −π/3 to π/3 (60°): walls of bowls are steeper"
    )]
    Slope {
        /// Index of the knot.
        knot: usize,
        /// Slope of the knot \[rad\].
        found_rad: f64,
    },
    /// A bend is too sharp.
    #[error(
        "knot {knot} of the profile: the face turns towards it with a radius of {found_m} m, expected {SHARPEST_M} m or more: move it \
         farther from the knot before, or let the slope change less"
    )]
    Sharp {
        /// Index of the knot.
        knot: usize,
        /// Radius of the arc that ends there \[m\].
        found_m: f64,
    },
}

#[derive(Clone, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
#[ts(rename = "Meridian")]
struct MeridianFields {
    knots: Vec<Knot>,
}

impl TryFrom<MeridianFields> for Meridian {
    type Error = MeridianError;

    fn try_from(file: MeridianFields) -> Result<Self, MeridianError> {
        Self::new(&file.knots)
    }
}

impl From<Meridian> for MeridianFields {
    fn from(meridian: Meridian) -> Self {
        Self {
            knots: meridian.knots().to_vec(),
        }
    }
}

impl Meridian {
    /// Builds the meridian through knots, from the pole on.
    ///
    /// # Errors
    /// [`MeridianError`]: no knot or more than [`MOST_KNOTS`], radii that do not grow, slopes beyond [`STEEPEST_RAD`], arcs sharper than
    /// [`SHARPEST_M`], or numbers that are not finite.
    pub fn new(knots: &[Knot]) -> Result<Self, MeridianError> {
        let found = knots.len();
        if !(1..=MOST_KNOTS).contains(&found) {
            return Err(MeridianError::Count { found });
        }
        let mut before_m = 0.0;
        for (knot, &Knot { radius_m, slope_rad }) in knots.iter().enumerate() {
            let found_m = radius_m;
            if !(radius_m > before_m && radius_m <= GREATEST_M) {
                return Err(MeridianError::Radius {
                    knot,
                    found_m,
                    before_m,
                });
            }
            if !(-STEEPEST_RAD..=STEEPEST_RAD).contains(&slope_rad) {
                let found_rad = slope_rad;
                return Err(MeridianError::Slope { knot, found_rad });
            }
            before_m = radius_m;
        }
        let none = Knot {
            radius_m: 0.0,
            slope_rad: 0.0,
        };
        let pole = MeridianPoint {
            radius_m: 0.0,
            height_m: 0.0,
            sine: 0.0,
            cosine: 1.0,
            curvature: 0.0,
        };
        let mut meridian = Self {
            count: found,
            knots: [none; MOST_KNOTS],
            starts: [(pole, 0.0); MOST_KNOTS + 1],
        };
        meridian.knots[..found].copy_from_slice(knots);
        for (k, &Knot { radius_m, slope_rad }) in knots.iter().enumerate() {
            let (from, arc_m) = &mut meridian.starts[k];
            let (sine, cosine) = sin_cos(slope_rad);
            from.curvature = (sine - from.sine) / (radius_m - from.radius_m);
            if from.curvature.abs() * SHARPEST_M > 1.0 {
                return Err(MeridianError::Sharp {
                    knot: k,
                    found_m: 1.0 / from.curvature.abs(),
                });
            }
            let (from, arc_m) = (*from, *arc_m);
            let end = MeridianPoint {
                radius_m,
                height_m: from.height_m + rise(&from, radius_m, sine, cosine),
                sine,
                cosine,
                curvature: 0.0,
            };
            meridian.starts[k + 1] = (end, arc_m + length(&from, radius_m, sine, cosine));
        }
        Ok(meridian)
    }

    /// Knots, without the pole.
    #[must_use]
    pub fn knots(&self) -> &[Knot] {
        &self.knots[..self.count]
    }

    /// Radius of the rim \[m\].
    #[must_use]
    pub fn rim_m(&self) -> f64 {
        self.starts[self.count].0.radius_m
    }

    /// Length from the pole to the rim \[m\].
    #[must_use]
    pub fn arc_m(&self) -> f64 {
        self.starts[self.count].1
    }

    /// True if the meridian is a straight line across its axis.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.knots().iter().all(|knot| knot.slope_rad == 0.0)
    }

    /// Returns the point at a distance from the axis \[m\]. Beyond the rim the meridian continues straight.
    #[must_use]
    #[inline]
    pub fn at_radius(&self, radius_m: f64) -> MeridianPoint {
        let (from, _) = self.piece(|(start, _)| start.radius_m <= radius_m);
        on_piece(from, radius_m)
    }

    /// Same as [`Self::at_radius`], with the index of the piece found last as a guess: any number at first.
    #[must_use]
    #[inline]
    pub fn at_radius_near(&self, radius_m: f64, piece: &mut usize) -> MeridianPoint {
        let mut at = (*piece).min(self.count);
        while at > 0 && self.starts[at].0.radius_m > radius_m {
            at -= 1;
        }
        while at < self.count && self.starts[at + 1].0.radius_m <= radius_m {
            at += 1;
        }
        *piece = at;
        on_piece(&self.starts[at].0, radius_m)
    }

    /// Returns the point at a length along the meridian from the pole \[m\]. Beyond the rim the meridian continues straight.
    #[must_use]
    #[inline]
    pub fn at_arc(&self, arc_m: f64) -> MeridianPoint {
        let (from, before_m) = self.piece(|(_, start_m)| *start_m <= arc_m);
        let along_m = arc_m - before_m;
        // From the start by the chord: 2 sin(κℓ/2)/κ long, in the direction of the mean slope.
        let half = 0.5 * from.curvature * along_m;
        let chord_m = along_m * sinc(half);
        let (s, c) = sin_cos(half);
        let (mean_sine, mean_cosine) = (from.sine * c + from.cosine * s, from.cosine * c - from.sine * s);
        MeridianPoint {
            radius_m: from.radius_m + chord_m * mean_cosine,
            height_m: from.height_m + chord_m * mean_sine,
            sine: mean_sine * c + mean_cosine * s,
            cosine: mean_cosine * c - mean_sine * s,
            curvature: from.curvature,
        }
    }

    /// Length along the meridian from the pole to a distance from the axis \[m\].
    #[must_use]
    pub fn arc_at(&self, radius_m: f64) -> f64 {
        let (from, before_m) = self.piece(|(start, _)| start.radius_m <= radius_m);
        let there = self.at_radius(radius_m);
        before_m + length(from, radius_m, there.sine, there.cosine)
    }

    /// Least and greatest height over the pole \[m\].
    #[must_use]
    pub fn height_bounds_m(&self) -> [f64; 2] {
        let mut bounds = [0.0_f64; 2];
        let mut see = |height_m: f64| bounds = [bounds[0].min(height_m), bounds[1].max(height_m)];
        for pair in self.starts[..=self.count].windows(2) {
            let [(from, _), (to, _)] = [pair[0], pair[1]];
            see(to.height_m);
            // Level within the piece: where sin β passes through 0.
            if from.sine * to.sine < 0.0 {
                see(self.at_radius(from.radius_m - from.sine / from.curvature).height_m);
            }
        }
        bounds
    }

    /// Returns the ranges of slope and curvature between two distances from the axis \[m\].
    #[must_use]
    pub fn patch(&self, [from_m, to_m]: [f64; 2]) -> Patch {
        let mut patch = Patch::NONE;
        let starts = &self.starts[..=self.count];
        for (k, (start, _)) in starts.iter().enumerate() {
            let end_m = starts.get(k + 1).map_or(f64::INFINITY, |(next, _)| next.radius_m);
            let (from_m, to_m) = (from_m.max(start.radius_m), to_m.min(end_m));
            if from_m > to_m {
                continue;
            }
            patch.see_curvature(start.curvature);
            for radius_m in [from_m, to_m] {
                let sine = start.sine + start.curvature * (radius_m - start.radius_m);
                patch.see_sine(sine);
                // sin β / ρ is (s₀ − κ ρ₀)/ρ + κ: monotonic along a piece, and κ next to the pole.
                patch.see_curvature(if radius_m > 0.0 {
                    sine / radius_m
                } else {
                    start.curvature
                });
            }
        }
        patch
    }

    /// Area of the surface from the pole to a distance from the axis \[m²\].
    #[must_use]
    pub fn area_within_m2(&self, radius_m: f64) -> f64 {
        let end_m = self.arc_at(radius_m);
        let mut area = 0.0;
        for pair in self.starts[..=self.count].windows(2) {
            let (from_m, to_m) = (pair[0].1, pair[1].1.min(end_m));
            if to_m > from_m {
                let half = 0.5 * (to_m - from_m);
                let middle = 0.5 * (to_m + from_m);
                let radii = |[node, weight]: [f64; 2]| {
                    weight * (self.at_arc(middle - half * node).radius_m + self.at_arc(middle + half * node).radius_m)
                };
                area += 2.0 * PI * half * GAUSS.into_iter().map(radii).sum::<f64>();
            }
        }
        area
    }

    /// Returns the start of the last piece for which `begins` is true; beyond the rim, the rim.
    #[inline]
    fn piece(&self, begins: impl Fn(&(MeridianPoint, f64)) -> bool) -> &(MeridianPoint, f64) {
        let starts = &self.starts[..=self.count];
        let after = starts.partition_point(begins).max(1);
        &starts[after - 1]
    }
}

/// Returns the point of a piece at a distance from the axis \[m\].
#[inline]
fn on_piece(from: &MeridianPoint, radius_m: f64) -> MeridianPoint {
    let sine = from.sine + from.curvature * (radius_m - from.radius_m);
    let cosine = (1.0 - sine * sine).max(0.0).sqrt();
    let height_m = from.height_m + rise(from, radius_m, sine, cosine);
    MeridianPoint {
        radius_m,
        height_m,
        sine,
        cosine,
        curvature: from.curvature,
    }
}

/// Height difference Δz from the start of a piece to a radius on it, with known sin β and cos β \[m\].
#[inline]
fn rise(from: &MeridianPoint, radius_m: f64, sine: f64, cosine: f64) -> f64 {
    (radius_m - from.radius_m) * (from.sine + sine) / (from.cosine + cosine)
}

/// Length ℓ from the start of a piece to a radius on it \[m\].
fn length(from: &MeridianPoint, radius_m: f64, sine: f64, cosine: f64) -> f64 {
    let along = radius_m - from.radius_m;
    // cos m = √((1 + cos 2m)/2), 2m the sum of both slopes.
    let mean = (0.5 * (1.0 + from.cosine * cosine - from.sine * sine)).max(0.0).sqrt();
    let half = 0.5 * from.curvature * along / mean;
    let stretched = if half.abs() < 1e-4 {
        1.0 + half * half / 6.0
    } else {
        asin(half) / half
    };
    along / mean * stretched
}

/// sin x / x.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { sin(x) / x }
}

/// Returns cos and sin of the angle whose slope is a share of that of the meridian.
#[must_use]
pub fn share_of_slope(point: &MeridianPoint, share: f64) -> [f64; 2] {
    let slope = share * asin(point.sine.clamp(-1.0, 1.0));
    [cos(slope), sin(slope)]
}
