//! A spiral from the pole that runs into the closing ring.
//!
//! The angle θ goes from 0 to `Θ`, the spiral's turns, and on to `Θ + 2π`, less a trim, with a ring. ℓ grows at the constant rate
//! `a = R / (Θ − β/2)` until the last `β` = [`BLEND_RAD`] of the spiral, over which the rate falls to zero as `a (1 − S(x))`,
//! `S(x) = x³ (10 − 15 x + 6 x²)`. So `ℓ(θ)` is C³ and meets the ring at `ℓ = R` without a bend.

use crate::wash_path::pattern::{
    CandidateRequest, Density, PatternPath, PatternRules, TRIMS_RAD, TurnsRule, WashPattern,
};
use crate::wash_path::{LEAST_RADIUS_M, LEAST_TURNS, MOST_TURNS, WashCurve};
use std::f64::consts::TAU;

/// Angle over which the end of the spiral blends into the ring \[rad\].
pub const BLEND_RAD: f64 = 1.0;

/// Greatest slope of S.
const STEEPEST: f64 = 1.875;

/// Distances of neighbouring windings that are tried, in sponge radii: two of them touch at 2.
const PITCHES: [f64; 9] = [1.95, 1.8, 1.65, 1.5, 1.4, 1.3, 1.2, 1.0, 0.8];

/// Pitches of denser curves, for doses that the usual ones do not give.
const DENSE_PITCHES: [f64; 3] = [0.65, 0.5, 0.35];

/// A spiral. All of its numbers are those of every curve.
pub(crate) struct Spiral;

impl Spiral {
    /// Rules for what a job states.
    pub(crate) const RULES: PatternRules = PatternRules {
        name: "spiral",
        turns: TurnsRule::Any,
        always_closes: false,
        repeats: false,
    };
}

impl PatternPath for Spiral {
    fn end(&self, curve: &WashCurve) -> f64 {
        TAU * curve.turns
    }

    fn pitch_m(&self, curve: &WashCurve) -> f64 {
        TAU * rate(curve)
    }

    fn arc(&self, curve: &WashCurve, theta: f64) -> [f64; 3] {
        let (a, end) = (rate(curve), self.end(curve));
        let blend = end - BLEND_RAD;
        if theta <= blend {
            return [a * theta, a, 0.0];
        }
        if theta >= end {
            return [curve.radius_m, 0.0, 0.0];
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

    fn greatest_arc(&self, curve: &WashCurve, [_, to]: [f64; 2]) -> f64 {
        // ℓ never falls.
        let [arc_m, ..] = self.arc(curve, to);
        arc_m
    }

    fn greatest_rates(&self, curve: &WashCurve, [from, to]: [f64; 2]) -> [f64; 2] {
        let (rate, end) = (rate(curve), self.end(curve));
        let blends = to >= end - BLEND_RAD && from <= end;
        let turns = from <= end;
        [
            if turns { rate } else { 0.0 },
            if blends { STEEPEST * rate / BLEND_RAD } else { 0.0 },
        ]
    }

    /// Bound |r″| + r + 2 r′: r never falls, r′ is at most the rate a, and r″ is 0 before the blend and at most 15/8 a / β in it.
    fn greatest_second_flat(&self, curve: &WashCurve, [_, theta]: [f64; 2]) -> Option<f64> {
        let rate = self.pitch_m(curve) / TAU;
        let r = curve.at(theta).position.norm();
        let blends = theta >= self.end(curve) - BLEND_RAD;
        Some(r + 2.0 * rate + if blends { 1.875 * rate / BLEND_RAD } else { 0.0 })
    }

    fn words(&self, curve: &WashCurve) -> String {
        let ring = if curve.closing_ring { " and a ring" } else { "" };
        format!("spiral of {:.2} turns{ring}", curve.turns)
    }
}

/// Rate a \[m/rad\].
fn rate(curve: &WashCurve) -> f64 {
    curve.radius_m / (Spiral.end(curve) - 0.5 * BLEND_RAD)
}

/// Lists spirals that a request leaves open.
pub(crate) fn candidates(request: &CandidateRequest<'_>) -> Vec<WashCurve> {
    let stated = request.stated;
    let pitches: &[f64] = match request.density {
        Density::Usual => &PITCHES,
        Density::Dense => &DENSE_PITCHES,
    };
    let trim_rad = if stated.is_any() { 0.0 } else { TRIMS_RAD[0] };
    let mut all = Vec::new();
    for radius_m in request.outer_m() {
        let turns = match stated.turns {
            Some(turns) => vec![turns],
            None => pitches
                .iter()
                .map(|pitch| radius_m / (pitch * request.sponge_m) + 0.5 * BLEND_RAD / TAU)
                .collect(),
        };
        for turns in turns {
            all.push(WashCurve {
                radius_m: radius_m.max(LEAST_RADIUS_M),
                turns: turns.clamp(LEAST_TURNS, MOST_TURNS),
                start_angle_rad: 0.0,
                closing_ring: stated.closing_ring.unwrap_or(true),
                trim_rad,
                pattern: WashPattern::Spiral,
            });
        }
    }
    all
}
