//! Rings about the pole, evenly apart along the meridian, joined by blends.
//!
//! Of n rings the k-th, from 0, has ℓ = ℓ₀ + k (R − ℓ₀)/(n − 1). The arm follows it until λₖ before the full turn, and then moves over the
//! angle wₖ to the next one by the septic smoothstep `S(x) = x⁴ (35 − 84 x + 70 x² − 20 x³)`, so that ℓ(θ) is C³. Blends farther out have
//! about the same length in metres with a smaller angle: λₖ and wₖ fall as (k + 1)^(−3/8). The last ring is the closing one: a full turn, or
//! less by [`WashCurve::trim_rad`]. With several laps the arm goes round each ring as often before it leaves it.

use crate::wash_path::pattern::{
    CandidateRequest, CurveNumber, Density, PatternPath, PatternRules, TRIMS_RAD, TurnsRule, WashPattern,
};
use crate::wash_path::{LEAST_RADIUS_M, LONGEST_M, WashCurve};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Greatest number of rings of a curve.
pub const MOST_RINGS: usize = 100;

/// Greatest number of times that a path goes round a ring, and that a soil may ask for.
pub const MOST_LAPS: u32 = 20;

/// Least angle of a blend between two rings \[rad\].
pub const LEAST_BLEND_RAD: f64 = 1e-3;

/// λ₀ and w₀ of blends \[rad\]: shorter ones are shorter ways, and longer times where joints reach their accelerations.
const BLENDS: [[f64; 2]; 2] = [[2.0, 1.7], [1.8, 1.4]];

/// ℓ of the innermost ring, relative to that of evenly spaced rings: farther out it lies nearer to the next ones.
const INNER: [f64; 3] = [1.0, 1.08, 1.17];

/// Rings that are tried at most, where their number is not stated.
const MOST_TRIED: usize = 40;

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
    /// Rules for what a job states.
    pub(crate) const RULES: PatternRules = PatternRules {
        name: "rings",
        turns: TurnsRule::Whole {
            counted: "the rings but the last",
            most: MOST_RINGS - 1,
        },
        always_closes: true,
        repeats: true,
    };

    /// Number of turns before the closing ring.
    #[must_use]
    pub fn turns(&self) -> f64 {
        self.length_rad() / TAU
    }

    /// θ at which the closing ring begins \[rad\].
    fn length_rad(&self) -> f64 {
        (0..self.blends()).map(|k| self.lengths(k).iter().sum::<f64>()).sum()
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

impl PatternPath for Rings {
    fn laps(&self) -> u32 {
        self.laps
    }

    fn end(&self, _curve: &WashCurve) -> f64 {
        self.length_rad()
    }

    fn pitch_m(&self, curve: &WashCurve) -> f64 {
        (curve.radius_m - self.inner_m) / self.blends() as f64
    }

    fn arc(&self, curve: &WashCurve, theta: f64) -> [f64; 3] {
        let (outer_m, pitch_m) = (curve.radius_m, self.pitch_m(curve));
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

    fn greatest_arc(&self, curve: &WashCurve, [_, to]: [f64; 2]) -> f64 {
        // ℓ never falls.
        let [arc_m, ..] = self.arc(curve, to);
        arc_m
    }

    fn greatest_rates(&self, curve: &WashCurve, [from, to]: [f64; 2]) -> [f64; 2] {
        let (pitch_m, mut start, mut rates) = (self.pitch_m(curve).abs(), 0.0, [0.0_f64; 2]);
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

    fn blend_rad(&self) -> Option<f64> {
        Some(self.blend_rad)
    }

    fn numbers(&self, curve: &WashCurve) -> Vec<CurveNumber> {
        let (count, laps) = (self.count as f64, f64::from(self.laps));
        // No ring is longer than the outermost.
        let length_m = TAU * curve.radius_m * (laps * count + 1.0);
        vec![
            ("curve.rings.laps", laps, [1.0, f64::from(MOST_LAPS)]),
            ("curve.rings.count", count, [2.0, MOST_RINGS as f64]),
            ("curve.rings.inner_m", self.inner_m, [0.0, curve.radius_m]),
            ("curve.rings.lead_rad", self.lead_rad, [0.0, TAU]),
            ("curve.rings.blend_rad", self.blend_rad, [LEAST_BLEND_RAD, TAU]),
            ("length of the rings", length_m, [0.0, 2.0 * LONGEST_M]),
        ]
    }

    fn words(&self, _curve: &WashCurve) -> String {
        match self.laps {
            0 | 1 => format!("{} rings", self.count),
            laps => format!("{} rings, each {laps} times", self.count),
        }
    }
}

/// Lists rings that lie evenly, or nearly so: about half a pitch from the pole to the first, and half a pitch or less from the last to the
/// rim. As many as are stated, however far apart; at least one curve.
pub(crate) fn candidates(request: &CandidateRequest<'_>) -> Vec<WashCurve> {
    let (stated, arc_m) = (request.stated, request.surface.arc_m());
    let mut all = Vec::new();
    let [least, most] = match stated.turns {
        Some(turns) => [(turns.round() as usize).saturating_add(1).clamp(2, MOST_RINGS); 2],
        None => {
            let least = ((arc_m / (2.0 * request.sponge_m)).ceil().max(2.0) as usize).min(MOST_TRIED);
            let few = (least + 2).min(MOST_TRIED);
            match request.density {
                Density::Usual => [least, few],
                Density::Dense => [few + 1, (few + 4).min(MOST_TRIED)],
            }
        }
    };
    for count in least..=most {
        let half_m = arc_m / (2 * count) as f64;
        let mut outers = request.outer_m();
        if stated.path_radius_m.is_none() {
            outers.push(arc_m - half_m);
        }
        for radius_m in outers.into_iter().map(|radius_m| radius_m.max(LEAST_RADIUS_M)) {
            let even_m = radius_m / (2 * count - 1) as f64;
            for inner_m in INNER.map(|share| share * even_m) {
                all.extend(BLENDS.map(|blend| ringed((count, request.laps), [inner_m, radius_m], blend)));
            }
        }
    }
    all
}

/// Rings, each gone round a number of times, with ℓ of the innermost and of the outermost.
fn ringed((count, laps): (usize, u32), [inner_m, radius_m]: [f64; 2], [lead_rad, blend_rad]: [f64; 2]) -> WashCurve {
    let rings = Rings {
        count,
        inner_m,
        lead_rad,
        blend_rad,
        laps,
    };
    WashCurve {
        radius_m,
        turns: rings.turns(),
        start_angle_rad: 0.0,
        closing_ring: true,
        trim_rad: TRIMS_RAD[0],
        pattern: WashPattern::Rings(rings),
    }
}
