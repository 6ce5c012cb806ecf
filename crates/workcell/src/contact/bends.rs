//! How much a face bends between two distances from its axis, looked up: the curvatures of narrow rings.

use crate::surface::{Patch, Surface};

/// Rings between the axis and the rim, and all of them: what is farther out is asked of the surface.
const RINGS: usize = 128;
const ALL: usize = RINGS + RINGS / 2;

/// How exactly a line meets a face where Newton's method has settled \[m\].
pub(super) const MEETS_WITHIN_M: f64 = 1e-9;

/// With the height F over the face along the line, the error after a step e is no more than max|F″| / (2 min|F′|) e². Slopes are at most
/// 60°, and where nothing is steeper than 78° against the line that is at most 10 K e², K the greatest curvature.
const NEWTON: f64 = 10.0;

/// A face with the curvatures of its rings.
#[derive(Debug, Clone)]
pub struct Bends<'a> {
    surface: &'a Surface,
    rim_m: f64,
    /// Rings a metre.
    per_m: f64,
    /// A step of Newton's method after which a line meets the face to [`MEETS_WITHIN_M`] \[m\].
    settled_m: f64,
    /// Least and greatest curvature of each ring and of as many after it as make 1, 2, 4 … \[1/m\]; none of a flat face.
    levels: Vec<Vec<[f64; 2]>>,
}

impl<'a> Bends<'a> {
    /// Those of a face.
    #[must_use]
    pub fn of(surface: &'a Surface) -> Self {
        let rim_m = surface.rim_m();
        let width_m = rim_m / RINGS as f64;
        // Wider than the ring by more than what is rounded where a distance finds its ring.
        let ring = |k: usize| {
            let [from, to] = [k as f64 - 0.001, k as f64 + 1.001].map(|k| (k * width_m).max(0.0));
            surface.patch([from, to]).curvature
        };
        let [least, most] = surface.curvature_bounds();
        let greatest = most.max(-least).max(f64::MIN_POSITIVE);
        let mut levels = Vec::new();
        if !surface.is_flat() {
            levels.push((0..ALL).map(ring).collect());
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
        }
    }

    /// A step of Newton's method after which a line meets the face to [`MEETS_WITHIN_M`] \[m\].
    pub(super) fn settled_m(&self) -> f64 {
        self.settled_m
    }

    /// The face.
    #[must_use]
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// Radius of its rim \[m\].
    #[must_use]
    pub fn rim_m(&self) -> f64 {
        self.rim_m
    }

    /// Between what the curvatures along and across the meridian lie between two distances from the axis \[1/m\]; below 0 is as far out
    /// on the other side.
    #[must_use]
    pub fn between(&self, [near_m, far_m]: [f64; 2]) -> [f64; 2] {
        if self.levels.is_empty() {
            return Patch::FLAT.curvature;
        }
        let [first, last] = [near_m, far_m].map(|rho_m| (rho_m * self.per_m) as usize);
        let known = last.checked_sub(first).and_then(|more| {
            // Two runs of rings that overlap hold all of them.
            let level = (more + 1).ilog2() as usize;
            let runs = self.levels.get(level)?;
            Some(both(*runs.get(first)?, *runs.get(last + 1 - (1 << level))?))
        });
        known.unwrap_or_else(|| self.surface.patch([near_m.max(0.0), far_m]).curvature)
    }
}

/// What holds two ranges.
fn both([a, b]: [f64; 2], [least, most]: [f64; 2]) -> [f64; 2] {
    [if least < a { least } else { a }, if most > b { most } else { b }]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// What is looked up holds all that the surface says, and no more than that of a ring more to each side.
        #[test]
        fn what_is_looked_up_is_what_the_face_says(profile in 0..4usize, near in -0.01..0.2f64, wide in 0.0..0.04f64) {
            let surface = Surface::shipped(crate::surface::SHIPPED_PROFILES[profile]).unwrap();
            let (far, ring) = (near + wide, 1.01 * surface.rim_m() / RINGS as f64);
            prop_assume!(far > 0.0);
            let found = Bends::of(&surface).between([near, far]);
            let exact = surface.patch([near.max(0.0), far]).curvature;
            let wider = surface.patch([(near - ring).max(0.0), far + ring]).curvature;
            // Where sin β / ρ is the same everywhere it is rounded differently everywhere.
            let rounded = 1e-12 * surface.curvature_bounds().map(f64::abs).into_iter().fold(0.0, f64::max);
            prop_assert!(found[0] <= exact[0] + rounded && found[1] >= exact[1] - rounded, "{found:?} {exact:?}");
            prop_assert!(found[0] >= wider[0] - rounded && found[1] <= wider[1] + rounded, "{found:?} {wider:?}");
        }
    }
}
