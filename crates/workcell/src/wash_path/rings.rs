//! Rings about the pole, evenly apart along the meridian, joined by blends.
//!
//! Of n rings the k-th, from 0, has ℓ = ℓ₀ + k (R − ℓ₀)/(n − 1). The arm goes round on it until λₖ before the full turn, and over the angle
//! wₖ on to the next one as the septic smoothstep `S(x) = x⁴ (35 − 84 x + 70 x² − 20 x³)`, so that ℓ(θ) is C³. Blends farther out are as
//! long in metres with less of a turn: λₖ and wₖ fall as (k + 1)^(−3/8). The last ring is the closing one, a full turn.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Rings of a curve at most.
pub const MOST_RINGS: usize = 100;

/// The greatest |S′| and |S″|: at x = 1/2, and at x = 1/2 ± √5/10.
const STEEPEST: [f64; 2] = [2.1875, 7.513_188_404_399_293];

/// Rings joined by blends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rings {
    /// n, at least 2.
    pub count: usize,
    /// ℓ₀: that of the innermost ring \[m\].
    pub inner_m: f64,
    /// λ₀: how long before a full turn the first blend begins \[rad\].
    pub lead_rad: f64,
    /// w₀: over which angle the first blend goes \[rad\].
    pub blend_rad: f64,
}

/// A ring with its blend, or the closing ring.
#[derive(Debug, Clone, Copy)]
struct Stage {
    /// Its index.
    k: usize,
    /// θ since it began \[rad\].
    theta: f64,
    /// θ on the ring before the blend, and of the blend \[rad\].
    lengths: [f64; 2],
}

impl Rings {
    /// θ at which the closing ring begins \[rad\].
    #[must_use]
    pub fn end(&self) -> f64 {
        (0..self.blends()).map(|k| self.lengths(k).iter().sum::<f64>()).sum()
    }

    /// Turns before the closing ring.
    #[must_use]
    pub fn turns(&self) -> f64 {
        self.end() / TAU
    }

    /// Distance between neighbouring rings along the meridian, the outermost one at `outer_m` \[m\].
    #[must_use]
    pub fn pitch_m(&self, outer_m: f64) -> f64 {
        (outer_m - self.inner_m) / self.blends() as f64
    }

    /// ℓ, ℓ′ and ℓ″ at θ.
    pub(super) fn arc(&self, outer_m: f64, theta: f64) -> [f64; 3] {
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

    /// What |ℓ′| and |ℓ″| are not above between two θ.
    pub(super) fn greatest_rates(&self, outer_m: f64, [from, to]: [f64; 2]) -> [f64; 2] {
        let (pitch_m, mut start, mut rates) = (self.pitch_m(outer_m).abs(), 0.0, [0.0_f64; 2]);
        for [ring, blend] in (0..self.blends()).map(|k| self.lengths(k)) {
            let (begins, ends) = (start + ring, start + ring + blend);
            if from <= ends && to >= begins {
                let [first, second] = STEEPEST;
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

    /// θ on the k-th ring before its blend, and of the blend \[rad\].
    fn lengths(&self, k: usize) -> [f64; 2] {
        let n = (k + 1) as f64;
        let share = 1.0 / (n * n * n).sqrt().sqrt().sqrt();
        [(TAU - self.lead_rad * share).max(0.0), self.blend_rad * share]
    }

    /// Where a θ is; `None` on the closing ring.
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
