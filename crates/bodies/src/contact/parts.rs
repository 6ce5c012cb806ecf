//! Bounds of a part of the sponge's face, at a moment or over a stretch of time, from the point where its middle meets the surface.
//!
//! The columns belong to the tool. A column meets the surface λ along the sponge's axis a, so that w = c − λ. With n the normal where it
//! meets, cos γ = −a·n, v the velocity of the tool's point there, K the greatest curvature there, h the length of the stretch:
//!
//! - the place moves along the surface with ẏ = v + λ̇ a, |ẏ| ≤ |v| / cos γ and |λ̇| ≤ |v| / cos γ, as n·ẏ = 0;
//! - n·ÿ is the normal curvature times |ẏ|², so that |ẅ| = |λ̈| ≤ (K |v|²/cos² γ + |r̈| + 2 |v| |ȧ| / cos γ)/cos γ, r̈ the acceleration of
//!   the tool's point; a surface whose curvature jumps has such a bound all the same;
//! - γ grows by no more than K |ẏ| + |ȧ| a second, so that sin γ ≤ its value at the nearer end + (K |v| + |ȧ|) h/2;
//! - hence w leaves the values at both ends by at most h²/8 of that, and the place is never farther from where it is at the nearer end
//!   than |v| h / (2 cos γ), nor is λ more than that from its value there.
//!
//! Straight across the sponge from the middle of a part, a way dr is one of at most dr / cos γ along the surface, whose normal turns by no
//! more than K times that: d sin γ / dr ≤ K. So sin γ is at most sin γ₀ + K r, and the way along the surface, ∫ dr / cos γ of a convex
//! function of sin γ, no longer than r times the mean of 1 / cos γ at both ends. As long as way and place do not leave the rings of the
//! surface of which K is known, K holds all along.
//!
//! The bend of a face between two distances from its axis is looked up in a table: the curvatures of narrow rings.

use crate::contact::foundation::Foundation;
use crate::contact::moment::Drift;
use nalgebra::{Vector2, Vector3};
use platewash_workcell::surface::{Patch, Surface};

/// Greatest sine of the angle between a column and the normal for which parts are bounded: 78°.
const STEEPEST_SINE: f64 = 0.98;

/// Upper bound on the inverse cosine of that angle.
const LONGEST: f64 = 5.1;

/// Greatest number of times that the range of rings is widened for a part that leaves it.
const WIDENED: usize = 4;

/// Size of a part of a sponge's face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Size {
    /// Greatest distance of a point of the part from its middle \[m\].
    pub reach_m: f64,
    /// Mean square of the distance from its middle \[m²\].
    pub square_m2: f64,
    /// Cross-section \[m²\].
    pub area_m2: f64,
    /// Root mean square of the distance from its middle \[m\].
    pub spread_m: f64,
    /// Root mean square of the distance from the sponge's axis \[m\].
    pub arm_m: f64,
}

/// Point where the middle of a part meets a surface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SurfaceHit {
    /// Compression w \[m\].
    pub compression_m: f64,
    /// cos γ. It is not above 0 if the column does not meet the surface, or only along it.
    pub cosine: f64,
    /// sin γ.
    pub sine: f64,
    /// Distance from the plate's axis \[m\].
    pub rho_m: f64,
    /// Position, seen along the plate's axis \[m\].
    pub seen_m: Vector2<f64>,
}

impl SurfaceHit {
    /// Returns the state for a point and its normal, and the sponge's axis.
    pub fn new(compression_m: f64, point: &Vector3<f64>, normal: &Vector3<f64>, axis: &Vector3<f64>) -> Self {
        let cosine = -normal.dot(axis);
        let seen_m = point.xy();
        Self {
            compression_m,
            cosine: if compression_m.is_finite() { cosine } else { f64::NAN },
            sine: (1.0 - cosine * cosine).max(0.0).sqrt(),
            rho_m: (seen_m.x * seen_m.x + seen_m.y * seen_m.y).sqrt(),
            seen_m,
        }
    }
}

/// Bounds on the change over a stretch of time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spread {
    /// Half of the length, h/2 \[s\].
    half_s: f64,
    /// Bounds |v| \[m/s\], and below |r̈| \[m/s²\].
    speed: f64,
    acceleration: f64,
    /// Bound |ȧ| \[1/s\].
    axis: f64,
    /// Change of λ for which |v| and |r̈| hold \[m\].
    slid_m: f64,
    /// Error of a compression at the ends \[m\].
    unsure_m: f64,
}

impl Spread {
    /// Spread of a single moment at which the positions are exact up to rounding.
    pub const NONE: Self = Self {
        half_s: 0.0,
        speed: 0.0,
        acceleration: 0.0,
        axis: 0.0,
        slid_m: 0.0,
        unsure_m: 0.0,
    };

    /// Returns the spread of a sponge: h/2, |v|, |r̈| and |ȧ| of the head of this file. `drift` bounds the motion of its tip and axis. Its
    /// parts reach `reach_m` from their middles, which meet the surface no farther than `along_m` along its axis at both ends.
    pub fn new(foundation: &Foundation, reach_m: f64, along_m: f64, drift: &Drift) -> Self {
        let s = foundation.radius_m;
        let half_s = 0.5 * drift.length_s;
        let far_m = |slid_m: f64| {
            let z = along_m + reach_m + slid_m;
            (s * s + z * z).sqrt()
        };
        // A little more than what it is without what it slides, so that what it slides is a little less.
        let slid_m = 1.1 * LONGEST * half_s * (drift.tip_m_s + drift.turning * far_m(0.0));
        let far_m = far_m(slid_m);
        Self {
            half_s,
            speed: drift.tip_m_s + drift.turning * far_m,
            acceleration: drift.tip_m_s2 + drift.bending * far_m,
            axis: drift.axis,
            slid_m,
            unsure_m: MEETS_WITHIN_M,
        }
    }
}

/// Bounds of a part, at a moment or over a stretch of time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PartBounds {
    /// Least and greatest compression \[m\].
    pub ends_m: [f64; 2],
    /// Least and greatest mean of the compression over the part \[m\].
    pub mean_m: [f64; 2],
    /// Least and greatest distance from the plate's axis at which it is met \[m\].
    pub rho_m: [f64; 2],
    /// Least cosine of the angle between the axis of the sponge and the direction onto the surface.
    pub cosine: f64,
    /// Greatest distance along the surface from its position at the nearer end \[m\].
    pub slid_m: f64,
    /// Sag of the compression: h²/8 times the bound of its second derivative, plus its error \[m\].
    pub sag_m: f64,
}

impl PartBounds {
    /// Bounds of a part of which nothing is known.
    const UNKNOWN: Self = Self {
        ends_m: [f64::NEG_INFINITY, f64::INFINITY],
        mean_m: [f64::NEG_INFINITY, f64::INFINITY],
        rho_m: [0.0, f64::INFINITY],
        cosine: 0.0,
        slid_m: f64::INFINITY,
        sag_m: f64::INFINITY,
    };

    /// Bounds w of formula (27.1) in `docs/contact.md`, and cos γ, of a part between two moments, as the head of this file derives. `from`
    /// and `to` are the values at its middle at both, `size` has r and the mean of r², `spread` has h/2, |v|, |r̈| and |ȧ|. `curvatures`
    /// returns the least and greatest K of the face between two distances from its axis.
    pub fn over(
        [from, to]: [&SurfaceHit; 2],
        size: &Size,
        spread: &Spread,
        curvatures: impl Fn([f64; 2]) -> [f64; 2],
    ) -> Self {
        let reach_m = size.reach_m;
        let Spread {
            half_s, speed: v, axis, ..
        } = *spread;
        if !(from.cosine > 0.0 && to.cosine > 0.0) {
            return Self::UNKNOWN;
        }
        let (sine, cosine) = (greater(from.sine, to.sine), lesser(from.cosine, to.cosine));
        let rho_m = [lesser(from.rho_m, to.rho_m), greater(from.rho_m, to.rho_m)];
        let mut known_m = 1.15 * (reach_m + half_s * v) / cosine;
        for _ in 0..WIDENED {
            let bends = curvatures([rho_m[0] - known_m, rho_m[1] + known_m]);
            let curvature = greater(-bends[0], bends[1]);
            let turned = sine + half_s * (curvature * v + axis);
            let steepest = turned + curvature * reach_m;
            if steepest.is_nan() || steepest > STEEPEST_SINE {
                break;
            }
            let [inner, least] = [turned, steepest].map(|s| (1.0 - s * s).sqrt());
            let (over_inner, over_least) = (1.0 / inner, 1.0 / least);
            let way_m = 0.5 * reach_m * (over_inner + over_least);
            let slid_m = half_s * v * over_least;
            if way_m + slid_m > known_m {
                known_m = 1.02 * (way_m + slid_m);
                continue;
            }
            if slid_m > spread.slid_m {
                break;
            }
            let bend = curvature * v * v * over_least * over_least + spread.acceleration + 2.0 * v * axis * over_least;
            let sag_m = 0.5 * half_s * half_s * bend * over_least + spread.unsure_m;
            // w as a function of the place across the sponge has the surface's second derivatives: its curvature over cos³. A hollow
            // rises away from the middle: more compression.
            let steep = 0.5 * over_least * over_least * over_least;
            let (less, more) = (lesser(bends[0], 0.0) * steep, greater(bends[1], 0.0) * steep);
            let [a, b] = [from, to].map(|met| (met.compression_m, met.sine / met.cosine * reach_m));
            let (r2, mean_r2) = (reach_m * reach_m, size.square_m2);
            return Self {
                ends_m: [
                    lesser(a.0 - a.1, b.0 - b.1) + less * r2 - sag_m,
                    greater(a.0 + a.1, b.0 + b.1) + more * r2 + sag_m,
                ],
                mean_m: [
                    lesser(a.0, b.0) + less * mean_r2 - sag_m,
                    greater(a.0, b.0) + more * mean_r2 + sag_m,
                ],
                rho_m: [rho_m[0] - way_m - slid_m, rho_m[1] + way_m + slid_m],
                cosine: least,
                slid_m,
                sag_m,
            };
        }
        Self::UNKNOWN
    }

    /// Upper bound on the mean of max(w, 0) over the part \[m\]. This function of w is convex, and no higher than the chord between its extremes.
    pub fn most_mean_m(&self) -> f64 {
        let ([least, most], [_, mean]) = (self.ends_m, self.mean_m);
        if most <= 0.0 {
            0.0
        } else if !(least.is_finite() && most.is_finite()) {
            f64::INFINITY
        } else if least >= 0.0 {
            mean
        } else {
            (most * (mean - least) / (most - least)).clamp(0.0, most)
        }
    }
}

/// Returns the lesser of two numbers, the second one if either is NaN: quicker than `f64::min`.
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// Returns the greater of two numbers, the second one if either is NaN.
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Number of rings between the axis and the rim, and below of all rings. Beyond those the surface itself is asked.
const RINGS: usize = 128;
const ALL: usize = RINGS + RINGS / 2;

/// Accuracy at which a line meets a face once Newton's method has settled \[m\].
const MEETS_WITHIN_M: f64 = 1e-9;

/// Factor of the error of Newton's method. With the height F over the face along the line, the error after a step e is no more than max|F″|
/// / (2 min|F′|) e². Slopes are at most 60°, and where nothing is steeper than 78° against the line that is at most 10 K e², K the greatest
/// curvature.
const NEWTON: f64 = 10.0;

/// Face with the curvatures of its rings.
#[derive(Debug, Clone)]
pub struct Bends<'a> {
    surface: &'a Surface,
    rim_m: f64,
    /// Number of rings per metre.
    per_m: f64,
    /// Length of a Newton step after which a line meets the face to [`MEETS_WITHIN_M`] \[m\].
    settled_m: f64,
    /// Least and greatest curvature of runs of 1, 2, 4 … rings from each ring on \[1/m\]; empty for a flat face.
    levels: Vec<Vec<[f64; 2]>>,
    /// Greatest |sin β| of each ring; empty for a flat face.
    sines: Vec<f64>,
}

impl<'a> Bends<'a> {
    /// Computes the table of a face.
    #[must_use]
    pub fn new(surface: &'a Surface) -> Self {
        let rim_m = surface.rim_m();
        let width_m = rim_m / RINGS as f64;
        // Wider than the ring by more than what is rounded where a distance finds its ring.
        let ring = |k: usize| {
            let [from, to] = [k as f64 - 0.001, k as f64 + 1.001].map(|k| (k * width_m).max(0.0));
            surface.patch([from, to])
        };
        let [least, most] = surface.curvature_bounds();
        let greatest = most.max(-least).max(f64::MIN_POSITIVE);
        let mut levels = Vec::new();
        let mut sines = Vec::new();
        if !surface.is_flat() {
            let rings: Vec<_> = (0..ALL).map(ring).collect();
            levels.push(rings.iter().map(|ring| ring.curvature).collect());
            sines = rings.iter().map(|ring| ring.sine[1].max(-ring.sine[0])).collect();
        }
        while let Some(rings) = levels
            .last()
            .filter(|rings: &&Vec<_>| rings.len() > 1 << (levels.len() - 1))
        {
            let step = 1 << (levels.len() - 1);
            let pairs = rings.iter().zip(&rings[step..]);
            let wider = pairs.map(|(a, b)| both(*a, *b)).collect();
            levels.push(wider);
        }
        Self {
            surface,
            rim_m,
            per_m: 1.0 / width_m,
            settled_m: (MEETS_WITHIN_M / (NEWTON * greatest)).sqrt().min(1e-6),
            levels,
            sines,
        }
    }

    /// Length of a Newton step after which a line meets the face to [`MEETS_WITHIN_M`] \[m\].
    pub(crate) fn settled_m(&self) -> f64 {
        self.settled_m
    }

    /// Returns the face.
    #[must_use]
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// Radius of the rim \[m\].
    #[must_use]
    pub fn rim_m(&self) -> f64 {
        self.rim_m
    }

    /// Least and greatest curvature, along and across the meridian, between two distances from the axis \[1/m\]. A negative distance stands
    /// for the same one on the other side.
    #[must_use]
    pub fn between(&self, [near_m, far_m]: [f64; 2]) -> [f64; 2] {
        if self.levels.is_empty() {
            return Patch::FLAT.curvature;
        }
        // An `i32` takes fewer instructions than a `usize`.
        let [first, last] = [near_m, far_m].map(|rho_m| ((rho_m * self.per_m) as i32).max(0) as usize);
        let known = last.checked_sub(first).and_then(|more| {
            // Two runs of rings that overlap hold all of them.
            let level = (more + 1).ilog2() as usize;
            let runs = self.levels.get(level)?;
            Some(both(*runs.get(first)?, *runs.get(last + 1 - (1 << level))?))
        });
        known.unwrap_or_else(|| self.surface.patch([near_m.max(0.0), far_m]).curvature)
    }
}

impl Bends<'_> {
    /// Greatest |sin β| between two distances from the axis, β the slope of the face. A negative distance stands for the same one on the other
    /// side. Beyond the rim the face ends.
    #[must_use]
    pub fn steepest(&self, [near_m, far_m]: [f64; 2]) -> f64 {
        let ring = |rho_m: f64| ((rho_m.min(self.rim_m) * self.per_m) as i32).max(0) as usize;
        let rings = self.sines.get(ring(near_m)..=ring(far_m)).unwrap_or(&self.sines);
        rings.iter().copied().fold(0.0, f64::max)
    }
}

/// Returns the smallest range that holds two ranges.
fn both([a, b]: [f64; 2], [least, most]: [f64; 2]) -> [f64; 2] {
    [if least < a { least } else { a }, if most > b { most } else { b }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The curvatures looked up hold those of the surface, and are within those of a range that is one ring wider on each side.
        #[test]
        fn looked_up_curvatures_contain_those_of_the_surface(profile in 0..4usize, near in -0.01..0.2f64, wide in 0.0..0.04f64) {
            let surface = Surface::shipped(platewash_workcell::surface::SHIPPED_PROFILES[profile]).unwrap();
            let (far, ring) = (near + wide, 1.01 * surface.rim_m() / RINGS as f64);
            prop_assume!(far > 0.0);
            let found = Bends::new(&surface).between([near, far]);
            let exact = surface.patch([near.max(0.0), far]).curvature;
            let wider = surface.patch([(near - ring).max(0.0), far + ring]).curvature;
            // If sin β / ρ is constant, it is rounded differently everywhere.
            let rounded = 1e-12 * surface.curvature_bounds().map(f64::abs).into_iter().fold(0.0, f64::max);
            prop_assert!(found[0] <= exact[0] + rounded && found[1] >= exact[1] - rounded, "{found:?} {exact:?}");
            prop_assert!(found[0] >= wider[0] - rounded && found[1] <= wider[1] + rounded, "{found:?} {wider:?}");
        }
    }
}
