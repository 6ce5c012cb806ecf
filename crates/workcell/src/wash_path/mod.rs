//! Path of the sponge on a plate: a curve on its face, and the cone for the tool's axis.
//!
//! In its plate's frame the curve is stated by the length ℓ along the meridian from the pole as a function of the angle θ about the axis
//! ([`WashCurve`]). On a flat disc ℓ is the distance from the centre. Behind it the curve may go round once more, on a closing ring.
//!
//! | concept | module |
//! | --- | --- |
//! | a wash path; its curve on a face, whatever its pattern | here |
//! | the patterns, and what each of them states | `pattern` |
//! | a spiral from the pole | `spiral` |
//! | rings joined by blends | `rings` |

mod pattern;
mod rings;
mod spiral;

pub use crate::wash_path::pattern::{
    CandidateRequest, CurveNumber, Density, PatternName, PatternRules, StatedNumbers, TRIMS_RAD, TurnsRule, WashPattern,
};
pub use crate::wash_path::rings::{LEAST_BLEND_RAD, MOST_LAPS, MOST_RINGS, Rings};
pub use crate::wash_path::spiral::BLEND_RAD;

use crate::plate::Plate;
use crate::surface::Surface;
use crate::wash_path::pattern::{PatternPath, of_pattern};
use nalgebra::{Vector2, Vector3};
use platewash_kinematics::trig::sin_cos;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Wash path of a plate: the curve of the tip on the face, and the cone for the tool's axis, given by parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WashPath {
    /// Index of the plate.
    pub plate: usize,
    /// Curve of the tip, seen along the plate's axis; its x is the plate's.
    pub curve: WashCurve,
    /// Length of the approach and the retreat along the normal over the ends of the curve \[m\].
    pub lift_m: f64,
    /// Half angle of the cone about the local normal within which the tool stays \[rad\].
    pub cone_rad: f64,
}

impl WashPath {
    /// The contact point at θ \[rad\], world frame \[m\].
    #[must_use]
    pub fn contact(&self, plate: &Plate, theta: f64) -> Vector3<f64> {
        plate.world(&self.curve.on(&plate.surface, theta).position)
    }

    /// Returns the foot of the line of the approach and that of the retreat, world frame \[m\].
    #[must_use]
    pub fn feet(&self, plate: &Plate) -> [Vector3<f64>; 2] {
        [0.0, self.curve.end()].map(|theta| self.contact(plate, theta))
    }
}

/// Least outer radius of a wash curve \[m\].
pub const LEAST_RADIUS_M: f64 = 1e-4;

/// Greatest outer radius of a wash curve \[m\].
const MOST_RADIUS_M: f64 = 10.0;

/// Greatest angle by which the closing ring is shorter than a full turn \[rad\].
pub const MOST_TRIM_RAD: f64 = 1.5;

/// Least number of turns of a wash curve.
pub const LEAST_TURNS: f64 = 0.25;

/// Greatest number of turns of a wash curve.
pub const MOST_TURNS: f64 = 200.0;

/// Greatest length of a wash curve \[m\]. It bounds time and memory.
pub const LONGEST_M: f64 = 100.0;

/// Number of points per blend at which its bend is examined in advance, and below the greatest number.
const LOOKS_A_BLEND: f64 = 8.0;
const MOST_LOOKS: f64 = 64.0;

/// Greatest depth of halving of a step.
const MOST_HALVINGS: u32 = 6;

/// Factor by which the chord of a step may leave the curve by more than asked for.
const MOST_MORE: f64 = 1.08;

/// Curve on the face of a plate, given by parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "FlatCurve", into = "FlatCurve")]
pub struct WashCurve {
    /// Greatest ℓ, R, on a flat face the outer radius \[m\], above 0.
    pub radius_m: f64,
    /// Number of turns before the closing ring; at least a quarter.
    pub turns: f64,
    /// Direction in which the spiral leaves the centre, counter-clockwise from +x \[rad\].
    pub start_angle_rad: f64,
    /// True if a circle at the outer radius follows.
    pub closing_ring: bool,
    /// Angle by which that circle ends before a full turn \[rad\].
    pub trim_rad: f64,
    /// Pattern before the closing ring, which takes `turns` turns.
    pub pattern: WashPattern,
}

/// A curve as plan files state it: the numbers of a pattern under its name, none of them for a spiral.
#[derive(Serialize, Deserialize)]
struct FlatCurve {
    radius_m: f64,
    turns: f64,
    start_angle_rad: f64,
    closing_ring: bool,
    #[serde(default, skip_serializing_if = "crate::json::is_zero")]
    trim_rad: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rings: Option<Rings>,
}

impl From<FlatCurve> for WashCurve {
    fn from(flat: FlatCurve) -> Self {
        Self {
            radius_m: flat.radius_m,
            turns: flat.turns,
            start_angle_rad: flat.start_angle_rad,
            closing_ring: flat.closing_ring,
            trim_rad: flat.trim_rad,
            pattern: flat.rings.map_or(WashPattern::Spiral, WashPattern::Rings),
        }
    }
}

impl From<WashCurve> for FlatCurve {
    fn from(curve: WashCurve) -> Self {
        Self {
            radius_m: curve.radius_m,
            turns: curve.turns,
            start_angle_rad: curve.start_angle_rad,
            closing_ring: curve.closing_ring,
            trim_rad: curve.trim_rad,
            rings: curve.rings(),
        }
    }
}

/// A point of a wash curve, relative to the plate's centre, with derivatives by θ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// Position \[m\].
    pub position: Vector2<f64>,
    /// First derivative \[m/rad\].
    pub first: Vector2<f64>,
    /// Second derivative \[m/rad²\].
    pub second: Vector2<f64>,
}

/// A point of a wash curve on a surface, plate frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Position \[m\].
    pub position: Vector3<f64>,
    /// First derivative by θ \[m/rad\].
    pub first: Vector3<f64>,
    /// The normal of the surface, out of it.
    pub normal: Vector3<f64>,
}

impl WashCurve {
    /// Last θ \[rad\].
    #[must_use]
    pub fn end(&self) -> f64 {
        let ring_rad = TAU * f64::from(self.laps()) - self.trim_rad;
        self.spiral_end() + if self.closing_ring { ring_rad } else { 0.0 }
    }

    /// Number of times that the path goes round each ring; 1 for a spiral.
    #[must_use]
    pub fn laps(&self) -> u32 {
        of_pattern!(&self.pattern, path => path.laps())
    }

    /// θ at which the closing ring begins \[rad\]: the end of the spiral, or of the last blend.
    #[must_use]
    pub fn spiral_end(&self) -> f64 {
        of_pattern!(&self.pattern, path => path.end(self))
    }

    /// The curve with another trim of its closing ring.
    #[must_use]
    pub fn trimmed(&self, trim_rad: f64) -> Self {
        Self { trim_rad, ..*self }
    }

    /// Distance between neighbouring windings along the meridian \[m\].
    #[must_use]
    pub fn pitch_m(&self) -> f64 {
        of_pattern!(&self.pattern, path => path.pitch_m(self))
    }

    /// Returns ℓ and its first two derivatives by θ, at θ in [0, [`WashCurve::end`]] \[m, m/rad, m/rad²\].
    #[must_use]
    pub fn arc(&self, theta: f64) -> [f64; 3] {
        of_pattern!(&self.pattern, path => path.arc(self, theta))
    }

    /// Upper bounds on |ℓ′| and |ℓ″| between two θ \[m/rad, m/rad²\].
    #[must_use]
    pub fn greatest_rates(&self, between: [f64; 2]) -> [f64; 2] {
        of_pattern!(&self.pattern, path => path.greatest_rates(self, between))
    }

    /// Rings of the curve, if they are its pattern.
    #[must_use]
    pub fn rings(&self) -> Option<Rings> {
        match self.pattern {
            WashPattern::Rings(rings) => Some(rings),
            WashPattern::Spiral => None,
        }
    }

    /// Angle of the first blend between rings \[rad\]; `None` without such blends.
    fn blend_rad(&self) -> Option<f64> {
        of_pattern!(&self.pattern, path => path.blend_rad())
    }

    /// Upper bound on the length of the curve, but for what the numbers of its pattern add: a spiral of mean radius R/2, and a ring \[m\].
    #[must_use]
    pub fn length_m(&self) -> f64 {
        PI * self.radius_m * (self.turns + 2.0)
    }

    /// Numbers that every curve has, with the ranges that can be judged.
    #[must_use]
    pub fn numbers(&self) -> [CurveNumber; 5] {
        [
            ("curve.radius_m", self.radius_m, [LEAST_RADIUS_M, MOST_RADIUS_M]),
            ("curve.turns", self.turns, [LEAST_TURNS, MOST_TURNS]),
            ("curve.start_angle_rad", self.start_angle_rad, [-TAU, TAU]),
            ("curve.trim_rad", self.trim_rad, [0.0, MOST_TRIM_RAD]),
            ("length of the curve", self.length_m(), [0.0, LONGEST_M]),
        ]
    }

    /// True if all numbers are within the ranges that can be judged, so that the curve has few enough points to be drawn.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let is_within = |(_, found, [least, most]): CurveNumber| (least..=most).contains(&found);
        self.numbers().into_iter().chain(self.pattern_numbers()).all(is_within)
    }

    /// Numbers of the pattern beside those that every curve has, with the ranges that can be judged.
    #[must_use]
    pub fn pattern_numbers(&self) -> Vec<CurveNumber> {
        of_pattern!(&self.pattern, path => path.numbers(self))
    }

    /// The pattern in words, with its count: `spiral of 3.50 turns and a ring`.
    #[must_use]
    pub fn words(&self) -> String {
        of_pattern!(&self.pattern, path => path.words(self))
    }

    /// Returns the point on a surface at θ in [0, [`WashCurve::end`]] \[rad\], and its derivative by θ, plate frame.
    #[must_use]
    pub fn on(&self, surface: &Surface, theta: f64) -> SurfacePoint {
        if surface.is_flat() {
            let CurvePoint { position, first, .. } = self.at(theta);
            return SurfacePoint {
                position: position.push(0.0),
                first: first.push(0.0),
                normal: Vector3::z(),
            };
        }
        let [arc_m, rate, _] = self.arc(theta);
        let at = surface.at_arc(arc_m);
        let (s, c) = sin_cos(self.start_angle_rad + theta);
        let (rise, out) = (at.sine * rate, at.cosine * rate);
        SurfacePoint {
            position: Vector3::new(at.radius_m * c, at.radius_m * s, at.height_m),
            first: Vector3::new(out * c - at.radius_m * s, out * s + at.radius_m * c, rise),
            normal: Vector3::new(-at.sine * c, -at.sine * s, at.cosine),
        }
    }

    /// Upper bound on the second derivative by θ of the point on a surface between two θ \[m/rad²\]: with κ the curvature of the meridian,
    /// |ℓ″| + |κ| ℓ′² + ρ + 2 |ρ′|; on a flat face that of the pattern, where it has a closer one.
    #[must_use]
    pub fn greatest_second(&self, surface: &Surface, between: [f64; 2]) -> f64 {
        let of_flat = || of_pattern!(&self.pattern, path => path.greatest_second_flat(self, between));
        surface
            .is_flat()
            .then(of_flat)
            .flatten()
            .unwrap_or_else(|| self.greatest_second_by_rates(surface, between))
    }

    fn greatest_second_by_rates(&self, surface: &Surface, between: [f64; 2]) -> f64 {
        let [first, second] = self.greatest_rates(between);
        let [least, most] = surface.curvature_bounds();
        // ρ is no greater than ℓ.
        let arc_m = of_pattern!(&self.pattern, path => path.greatest_arc(self, between));
        second + least.abs().max(most.abs()) * first * first + arc_m + 2.0 * first
    }

    /// Returns the point of a flat face at θ in [0, [`WashCurve::end`]] \[rad\].
    #[must_use]
    pub fn at(&self, theta: f64) -> CurvePoint {
        let [r, r1, r2] = self.arc(theta);
        let (s, c) = sin_cos(self.start_angle_rad + theta);
        let (along, across) = (Vector2::new(c, s), Vector2::new(-s, c));
        CurvePoint {
            position: along * r,
            first: along * r1 + across * r,
            second: along * (r2 - r) + across * (2.0 * r1),
        }
    }

    /// Returns values of θ from 0 to the end, so close that the chord between neighbours leaves the curve on a surface by at most
    /// `chord_error_m`. The beginning of the closing ring is one of them.
    #[must_use]
    pub fn parameters(&self, surface: &Surface, chord_error_m: f64) -> Vec<f64> {
        let mut all = vec![0.0];
        for (from, to) in [(0.0, self.spiral_end()), (self.spiral_end(), self.end())] {
            let mut steps = Vec::new();
            let mut theta = from;
            while theta < to {
                let step = self.step(surface, theta, chord_error_m);
                steps.push(step);
                theta += step;
            }
            // Shrunk evenly so that the last one ends where it should.
            let shrink = (to - from) / (theta - from).max(f64::MIN_POSITIVE);
            let mut theta = from;
            for (k, step) in steps.iter().enumerate() {
                theta = if k + 1 == steps.len() {
                    to
                } else {
                    theta + step * shrink
                };
                let before = all[all.len() - 1];
                let halvings = if surface.is_flat() && self.blend_rad().is_some() {
                    MOST_HALVINGS
                } else {
                    0
                };
                self.push_straight(&mut all, [before, theta], chord_error_m, halvings);
            }
        }
        all
    }

    /// Returns a step in θ over which the chord leaves the curve by `error`: |p″| Δθ² / 8, with the part of the second derivative across
    /// the curve.
    fn step(&self, surface: &Surface, theta: f64, error: f64) -> f64 {
        if !surface.is_flat() {
            // A tenth of a turn ahead the rates are bounded, so that no bend is stepped over.
            let second = self.greatest_second(surface, [theta, theta + 0.1]);
            return (8.0 * error / second).sqrt().min(0.1);
        }
        let step = self.fitting(theta, error);
        let Some(blend_rad) = self.blend_rad() else {
            return step;
        };
        // A blend bends more than what is before it, and not at all in its middle.
        let looks = (LOOKS_A_BLEND * step / blend_rad).ceil().clamp(2.0, MOST_LOOKS);
        let ahead = (1..=looks as u32).map(|k| self.fitting(theta + f64::from(k) / looks * step, error));
        ahead.fold(step, f64::min)
    }

    /// Returns the step on a flat face over which the chord leaves the curve by `error`, with the bend at `at`.
    fn fitting(&self, at: f64, error: f64) -> f64 {
        let CurvePoint { first, second, .. } = self.at(at.min(self.end()));
        let across = (first.x * second.y - first.y * second.x).abs() / first.norm();
        (8.0 * error / across).sqrt().min(0.25)
    }

    /// Checks that the chord of a stretch on a flat face leaves the curve by no more than [`MOST_MORE`] times `error`. The tolerance is
    /// needed as shrunk steps begin a little before the point for which they were computed.
    fn is_straight(&self, [from, to]: [f64; 2], error: f64) -> bool {
        let most = MOST_MORE * error;
        [0.0, 0.25, 0.5, 0.75, 1.0]
            .iter()
            .all(|share| to - from <= self.fitting(from + share * (to - from), most))
    }

    /// Adds the end of a stretch, and the halving points if its chord leaves the curve by too much.
    fn push_straight(&self, all: &mut Vec<f64>, [from, to]: [f64; 2], error: f64, halvings: u32) {
        let middle = 0.5 * (from + to);
        if halvings > 0 && from < middle && middle < to && !self.is_straight([from, to], error) {
            self.push_straight(all, [from, middle], error, halvings - 1);
            self.push_straight(all, [middle, to], error, halvings - 1);
        } else {
            all.push(to);
        }
    }
}
