//! Load on the foam by a flat face, from bounds of the tip's height and the tilt alone.
//!
//! Formulas (30.1) to (31.2) and (33.3) in `docs/contact.md`.
//!
//! With the tip at a height z over the face and the axis tilted by τ, the compression is linear across the sponge: its mean is
//! m = c − z / cos τ, and at the rim it is m ± k, k = s tan τ. The mean of max(w, 0) over the whole face of the sponge is at least m and,
//! being convex, at most m where m ≥ k, and at most (m + k)/2, half its greatest value, elsewhere; it grows with m and with k. Seen along
//! the sponge's axis, what is beyond the plate's rim is no more than what of a disc of radius s / cos τ is beyond it.
//!
//! With x across the sponge, max(w, 0) at x and at −x differ by 2 k x/s at most, so that ∫ max(w, 0) x dA ≤ π s³ k / 4; and together they are
//! no more than twice the mean above. Along its axis the sponge's face is seen on the plate stretched by 1 / cos τ at most, about a point at
//! the distance d from the plate's axis: of the distance ρ from that axis, by Cauchy and Schwarz, (∫ W ρ dA)² ≤ V ∫ W ρ² dA, and
//! ∫ W ρ² dA ≤ V d² + 2 d π s³ k / (4 cos τ) + V s² / (2 cos² τ). Columns beyond the rim press nothing: of ∫ max(w, 0) x dA they take no more
//! than their area times m + k and s.

use crate::contact::foundation::Foundation;
use crate::contact::plate_load::{HolderVolumes, Press};
use platewash_kinematics::trig::acos;
use std::f64::consts::PI;

/// Bounds of a sponge's pose on a flat face through a wash.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Least and greatest height of the tip over the face, negative below it, errors of the plate's height included \[m\].
    pub height_m: [f64; 2],
    /// Least cos τ, with τ the tilt.
    pub cosine: f64,
    /// Greatest distance of the tip from the plate's axis \[m\].
    pub distance_m: f64,
}

/// Load on the foam by a flat face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelPress {
    /// Least and greatest V = ∫ max(w, 0) dA \[m³\].
    pub volume_m3: [f64; 2],
    /// Greatest compression on the sponge's axis, m, and an upper bound on that of all columns, m + k \[m\].
    pub deepest_m: [f64; 2],
    /// Upper bound on ∫ max(w, 0) r / cos γ dA \[m⁴\], r the distance from the sponge's axis.
    pub twist_m4: f64,
    /// Upper bounds of what the plate's holder takes.
    pub holder: HolderVolumes,
}

impl From<LevelPress> for Press {
    fn from(level: LevelPress) -> Self {
        Self {
            volume_m3: level.volume_m3,
            deepest_m: level.deepest_m[1],
            twist_m4: level.twist_m4,
            holder: level.holder,
            sag_m: 0.0,
        }
    }
}

impl Foundation {
    /// Bounds the load on the foam by a flat face with a rim: the greatest compression m + k of formula (30.1), V of formula (31.1), the torque of
    /// formula (31.2) divided by μ E/H, and ∫ W ρ dA of formula (33.3) divided by cos τ. `level` has z, cos τ and d, `rim_m` is the radius of the plate.
    #[must_use]
    pub fn level_press(&self, level: &Level, rim_m: f64) -> LevelPress {
        let Level {
            height_m: [low_m, high_m],
            cosine,
            distance_m,
        } = *level;
        let tangent = (1.0 - cosine * cosine).max(0.0).sqrt() / cosine;
        // z / cos τ is greatest where the tip is high and the tool tilted, least where it is low: tilted below the face, upright above.
        let along = |height_m: f64, tilted: bool| height_m / if tilted { cosine } else { 1.0 };
        let means = [
            self.compression_m - along(high_m, high_m > 0.0),
            self.compression_m - along(low_m, low_m < 0.0),
        ];
        let k = self.radius_m * tangent;
        let [least, most] = means;
        let area_m2 = PI * self.radius_m * self.radius_m;
        let aside_m = low_m.abs().max(high_m.abs()) * tangent;
        let beyond_m2 = beyond_rim_m2(self.radius_m / cosine, distance_m + aside_m, rim_m).min(area_m2);
        let least_m3 = area_m2 * least.max(0.0) - beyond_m2 * (least + k).max(0.0);
        let most_m3 = area_m2 * if most >= k { most } else { 0.5 * (most + k).max(0.0) };
        let (d_m, s_m) = (distance_m + aside_m, self.radius_m / cosine);
        let around_m5 = most_m3 * (d_m * d_m + 0.5 * s_m * s_m) + 0.5 * d_m * area_m2 * s_m * k;
        let turn_m4 = (most_m3 * around_m5).sqrt().min(most_m3 * rim_m);
        LevelPress {
            volume_m3: [least_m3.max(0.0), most_m3],
            deepest_m: [most, most + k],
            // A linear compression has no first moment about the axis: ∫ r dA = 2/3 s A, and the same of half a cone's greatest value.
            twist_m4: 2.0 / 3.0 * self.radius_m * most_m3 / cosine,
            holder: HolderVolumes {
                normal_m3: most_m3 / cosine,
                slope_m3: 0.0,
                turn_m4: turn_m4 / cosine,
                lean_m4: (0.25 * area_m2 * k + beyond_m2 * (most + k).max(0.0)) * self.radius_m / cosine,
            },
        }
    }
}

/// Upper bound on the area of a disc beyond a rim about the axis \[m²\], for V beyond the rim in formula (31.1). `disc_m` is the radius of
/// the disc, s / cos τ, `distance_m` is that of its middle from the axis, d, and `rim_m` is the radius of the rim.
fn beyond_rim_m2(disc_m: f64, distance_m: f64, rim_m: f64) -> f64 {
    let (r, d, big) = (disc_m, distance_m, rim_m);
    let whole = PI * r * r;
    if !(r.is_finite() && d.is_finite()) || d - r >= big {
        return whole;
    }
    if d + r <= big {
        return 0.0;
    }
    if r - d >= big {
        // The plate lies within the disc.
        return whole - PI * big * big;
    }
    let cos_at = |a: f64, b: f64| ((d * d + a * a - b * b) / (2.0 * d * a)).clamp(-1.0, 1.0);
    let heron = (-d + r + big) * (d + r - big) * (d - r + big) * (d + r + big);
    let lens = r * r * acos(cos_at(r, big)) + big * big * acos(cos_at(big, r)) - 0.5 * heron.max(0.0).sqrt();
    // The rounding of the lens, of which parts of the plate's area cancel.
    (whole - lens + 1e-13 * big * big).clamp(0.0, whole)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Compared with squares a hundredth of the disc's radius wide.
        #[test]
        fn the_area_beyond_a_rim_agrees_with_counted_squares(r in 0.01..0.04f64, d in 0.0..0.2f64) {
            let (big, n) = (0.145, 200);
            let mut beyond = 0;
            let mut all = 0;
            for i in 0..n {
                for j in 0..n {
                    let [x, y] = [i, j].map(|k| (2.0 * (f64::from(k) + 0.5) / f64::from(n) - 1.0) * r);
                    if x * x + y * y <= r * r {
                        all += 1;
                        beyond += i32::from((d + x) * (d + x) + y * y > big * big);
                    }
                }
            }
            let share = f64::from(beyond) / f64::from(all);
            prop_assert!((beyond_rim_m2(r, d, big) / (PI * r * r) - share).abs() < 5e-3, "{share}");
        }
    }
}
