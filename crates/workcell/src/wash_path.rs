//! Path of the sponge on a plate: a curve on its face, and the cone for the tool's axis.
//!
//! In its plate's frame the curve is stated by the length ℓ along the meridian from the pole as a function of the angle θ about the axis
//! ([`WashCurve`]): a spiral that runs into a closing ring, or rings joined by blends. On a flat disc ℓ is the distance from the centre.
//!
//! Wash curves: ℓ as a function of θ.
//!
//! The angle θ goes from 0 to `Θ`, the spiral's turns, and on to `Θ + 2π`, less a trim, with a ring. ℓ grows at the constant rate
//! `a = R / (Θ − β/2)` until the last `β` = [`BLEND_RAD`] of the spiral, over which the rate falls to zero as `a (1 − S(x))`,
//! `S(x) = x³ (10 − 15 x + 6 x²)`. So `ℓ(θ)` is C³ and meets the ring at `ℓ = R` without a bend.
//!
//! Rings about the pole, evenly apart along the meridian, joined by blends.
//!
//! Of n rings the k-th, from 0, has ℓ = ℓ₀ + k (R − ℓ₀)/(n − 1). The arm follows it until λₖ before the full turn, and then moves over the
//! angle wₖ to the next one by the septic smoothstep `S(x) = x⁴ (35 − 84 x + 70 x² − 20 x³)`, so that ℓ(θ) is C³. Blends farther out have
//! about the same length in metres with a smaller angle: λₖ and wₖ fall as (k + 1)^(−3/8). The last ring is the closing one: a full turn, or
//! less by [`WashCurve::trim_rad`]. With several laps the arm goes round each ring as often before it leaves it.

use crate::plate::Plate;
use crate::surface::Surface;
use crate::trig::sin_cos;
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

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

/// Angle over which the end of the spiral blends into the ring \[rad\].
pub const BLEND_RAD: f64 = 1.0;

/// Least outer radius of a wash curve \[m\].
pub const LEAST_RADIUS_M: f64 = 1e-4;

/// Greatest angle by which the closing ring is shorter than a full turn \[rad\].
pub const MOST_TRIM_RAD: f64 = 1.5;

/// Least number of turns of a wash curve.
pub const LEAST_TURNS: f64 = 0.25;

/// Greatest number of turns of a wash curve.
pub const MOST_TURNS: f64 = 200.0;

/// Greatest length of a wash curve \[m\]. It bounds time and memory.
pub const LONGEST_M: f64 = 100.0;

/// Greatest slope of S.
const STEEPEST: f64 = 1.875;

/// Number of points per blend at which its bend is examined in advance, and below the greatest number.
const LOOKS_A_BLEND: f64 = 8.0;
const MOST_LOOKS: f64 = 64.0;

/// Greatest depth of halving of a step.
const MOST_HALVINGS: u32 = 6;

/// Factor by which the chord of a step may leave the curve by more than asked for.
const MOST_MORE: f64 = 1.08;

/// Curve on the face of a plate, given by parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
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
    #[serde(default, skip_serializing_if = "crate::json::is_zero")]
    pub trim_rad: f64,
    /// Rings joined by blends, which take `turns` turns; `None` for a spiral.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rings: Option<Rings>,
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
        self.rings.map_or(1, |rings| rings.laps)
    }

    /// θ at which the closing ring begins \[rad\]: the end of the spiral, or of the last blend.
    #[must_use]
    pub fn spiral_end(&self) -> f64 {
        match &self.rings {
            Some(rings) => rings.end(),
            None => TAU * self.turns,
        }
    }

    /// The curve with another trim of its closing ring.
    #[must_use]
    pub fn trimmed(&self, trim_rad: f64) -> Self {
        Self { trim_rad, ..*self }
    }

    /// Distance between neighbouring windings along the meridian \[m\].
    #[must_use]
    pub fn pitch_m(&self) -> f64 {
        match &self.rings {
            Some(rings) => rings.pitch_m(self.radius_m),
            None => TAU * self.rate(),
        }
    }

    /// Returns ℓ and its first two derivatives by θ, at θ in [0, [`WashCurve::end`]] \[m, m/rad, m/rad²\].
    #[must_use]
    pub fn arc(&self, theta: f64) -> [f64; 3] {
        match &self.rings {
            Some(rings) => rings.arc(self.radius_m, theta),
            None => self.radius(theta),
        }
    }

    /// Upper bounds on |ℓ′| and |ℓ″| between two θ \[m/rad, m/rad²\].
    #[must_use]
    pub fn greatest_rates(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        if let Some(rings) = &self.rings {
            return rings.greatest_rates(self.radius_m, [from, to]);
        }
        let rate = self.rate();
        let blends = to >= self.spiral_end() - BLEND_RAD && from <= self.spiral_end();
        let turns = from <= self.spiral_end();
        [
            if turns { rate } else { 0.0 },
            if blends { STEEPEST * rate / BLEND_RAD } else { 0.0 },
        ]
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
    /// |ℓ″| + |κ| ℓ′² + ρ + 2 |ρ′|.
    #[must_use]
    pub fn greatest_second(&self, surface: &Surface, between: [f64; 2]) -> f64 {
        let [first, second] = self.greatest_rates(between);
        let [least, most] = surface.curvature_bounds();
        // ρ is no greater than ℓ, which never falls.
        let [arc_m, ..] = self.arc(between[1]);
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
                let halvings = if surface.is_flat() && self.rings.is_some() {
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
        let Some(rings) = &self.rings else { return step };
        // A blend bends more than what is before it, and not at all in its middle.
        let looks = (LOOKS_A_BLEND * step / rings.blend_rad).ceil().clamp(2.0, MOST_LOOKS);
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

    fn rate(&self) -> f64 {
        self.radius_m / (self.spiral_end() - 0.5 * BLEND_RAD)
    }

    /// Returns r, r′, r″ at θ.
    fn radius(&self, theta: f64) -> [f64; 3] {
        let (a, blend) = (self.rate(), self.spiral_end() - BLEND_RAD);
        if theta <= blend {
            return [a * theta, a, 0.0];
        }
        if theta >= self.spiral_end() {
            return [self.radius_m, 0.0, 0.0];
        }
        let x = (theta - blend) / BLEND_RAD;
        let (x2, x3) = (x * x, x * x * x);
        // ∫S = x⁴ (5/2 − 3 x + x²), S and S′.
        let area = x2 * x2 * (2.5 - 3.0 * x + x2);
        let rise = x3 * (10.0 - 15.0 * x + 6.0 * x2);
        let slope = 30.0 * x2 * (1.0 - x) * (1.0 - x);
        [
            a * (blend + BLEND_RAD * (x - area)),
            a * (1.0 - rise),
            -a * slope / BLEND_RAD,
        ]
    }
}

/// Greatest number of rings of a curve.
pub const MOST_RINGS: usize = 100;

/// Greatest |S′| and |S″|: at x = 1/2, and at x = 1/2 ± √5/10.
const STEEPEST_BLEND: [f64; 2] = [2.1875, 7.513_188_404_399_293];

/// Rings joined by blends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rings {
    /// Number of rings n, at least 2.
    pub count: usize,
    /// Length ℓ₀ of the innermost ring \[m\].
    pub inner_m: f64,
    /// Angle λ₀ before a full turn at which the first blend begins \[rad\].
    pub lead_rad: f64,
    /// Angle w₀ of the first blend \[rad\].
    pub blend_rad: f64,
    /// Number of times that the path goes round each ring.
    #[serde(default = "once", skip_serializing_if = "is_once")]
    pub laps: u32,
}

fn once() -> u32 {
    1
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "as serde asks")]
fn is_once(laps: &u32) -> bool {
    *laps == 1
}

/// Ring with its blend, or the closing ring.
#[derive(Debug, Clone, Copy)]
struct Stage {
    /// Index of the ring.
    k: usize,
    /// Angle θ since it began \[rad\].
    theta: f64,
    /// Angles on the ring before the blend, and of the blend \[rad\].
    lengths: [f64; 2],
}

impl Rings {
    /// θ at which the closing ring begins \[rad\].
    #[must_use]
    pub fn end(&self) -> f64 {
        (0..self.blends()).map(|k| self.lengths(k).iter().sum::<f64>()).sum()
    }

    /// Number of turns before the closing ring.
    #[must_use]
    pub fn turns(&self) -> f64 {
        self.end() / TAU
    }

    /// Distance between neighbouring rings along the meridian, with the outermost one at `outer_m` \[m\].
    #[must_use]
    pub fn pitch_m(&self, outer_m: f64) -> f64 {
        (outer_m - self.inner_m) / self.blends() as f64
    }

    /// Returns ℓ, ℓ′ and ℓ″ at θ.
    fn arc(&self, outer_m: f64, theta: f64) -> [f64; 3] {
        let pitch_m = self.pitch_m(outer_m);
        let Some(Stage {
            k,
            theta,
            lengths: [ring, blend],
        }) = self.stage(theta)
        else {
            return [outer_m, 0.0, 0.0];
        };
        let from_m = self.inner_m + k as f64 * pitch_m;
        if theta <= ring {
            return [from_m, 0.0, 0.0];
        }
        let x = ((theta - ring) / blend).min(1.0);
        let (y, x2) = (1.0 - x, x * x);
        let x3 = x2 * x;
        let rise = x2 * x2 * (35.0 - 84.0 * x + 70.0 * x2 - 20.0 * x3);
        let slope = 140.0 * x3 * y * y * y;
        let bend = 420.0 * x2 * y * y * (1.0 - 2.0 * x);
        [
            from_m + pitch_m * rise,
            pitch_m * slope / blend,
            pitch_m * bend / (blend * blend),
        ]
    }

    /// Upper bounds on |ℓ′| and |ℓ″| between two θ.
    fn greatest_rates(&self, outer_m: f64, [from, to]: [f64; 2]) -> [f64; 2] {
        let (pitch_m, mut start, mut rates) = (self.pitch_m(outer_m).abs(), 0.0, [0.0_f64; 2]);
        for [ring, blend] in (0..self.blends()).map(|k| self.lengths(k)) {
            let (begins, ends) = (start + ring, start + ring + blend);
            if from <= ends && to >= begins {
                let [first, second] = STEEPEST_BLEND;
                rates = [
                    rates[0].max(pitch_m * first / blend),
                    rates[1].max(pitch_m * second / (blend * blend)),
                ];
            }
            start = ends;
        }
        rates
    }

    fn blends(&self) -> usize {
        self.count.saturating_sub(1).clamp(1, MOST_RINGS)
    }

    /// Returns the angles on the k-th ring before its blend, and of the blend \[rad\].
    fn lengths(&self, k: usize) -> [f64; 2] {
        let n = (k + 1) as f64;
        let share = 1.0 / (n * n * n).sqrt().sqrt().sqrt();
        [
            (TAU * f64::from(self.laps) - self.lead_rad * share).max(0.0),
            self.blend_rad * share,
        ]
    }

    /// Returns the ring or blend at a θ; `None` on the closing ring.
    fn stage(&self, theta: f64) -> Option<Stage> {
        let mut start = 0.0;
        for k in 0..self.blends() {
            let lengths = self.lengths(k);
            let next = start + lengths[0] + lengths[1];
            if theta < next {
                return Some(Stage {
                    k,
                    theta: theta - start,
                    lengths,
                });
            }
            start = next;
        }
        None
    }
}
