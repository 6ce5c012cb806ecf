//! Load on the foam by a plate over a stretch of time, for every plate height within its error.
//!
//! The integrals of formulas (31.1), (31.2), (33.1) and (33.2) in `docs/contact.md`, column by column.
//!
//! The bounds of every part of the sponge's face, from the points where its middle meets the plate at both ends of the stretch, are in
//! `parts.rs`.
//!
//! A plate that lies higher compresses every column more, as the surface is a graph that no column meets from below: bounds for the lowest
//! and the highest position of a plate hold for all between.
//!
//! Over a part W = max(w, 0), with r the distance from the sponge's axis, the mean of W r is that of W times that of r and what both vary
//! together. The mean of r is at most the root of that of r², which is the square of the distance of the part's middle and the mean of the
//! square of that from it; and r varies by no more than the root of the latter, W by half of what its extremes are apart.
//!
//! What holds the plate takes what the sponge pushes across the plate's axis and turns about it. A column presses with W / cos γ along the
//! normal, whose share across the axis is |sin β|, β the slope of the face: at most the greatest one between the distances at which the part
//! is met. The normals of a face of revolution meet its axis: what turns the plate about it is friction alone, with ρ as its lever.

use crate::contact::columns::{Columns, meet_from};
use crate::contact::moment::Drift;
use crate::contact::parts::{Bends, PartBounds, Size, Spread, SurfaceHit};
use crate::contact::sponge_pose::SpongePose;
use nalgebra::Vector3;

/// Upper bounds of what the holder of a plate takes, as volumes of foam, with γ the angle between the sponge's axis and the normal.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HolderVolumes {
    /// ∫ max(w, 0) / cos γ dA \[m³\]: what is pressed along normals, N of formula (33.1) divided by E/H.
    pub normal_m3: f64,
    /// ∫ max(w, 0) |sin β| / cos γ dA \[m³\], β the slope of the face: what of it pushes across the plate's axis, for x̄ of formula (33.1).
    pub slope_m3: f64,
    /// ∫ max(w, 0) ρ / cos γ dA \[m⁴\], ρ the distance from the plate's axis: the torque of formula (33.2) divided by μ E/H.
    pub turn_m4: f64,
    /// ‖∫ max(w, 0) x / cos γ dA‖ \[m⁴\], for O of formula (33.5); x is the place across the sponge from its axis; infinite where it is not
    /// bounded.
    pub lean_m4: f64,
}

impl HolderVolumes {
    /// Volumes of which nothing is known.
    pub const UNKNOWN: Self = Self {
        normal_m3: f64::INFINITY,
        slope_m3: f64::INFINITY,
        turn_m4: f64::INFINITY,
        lean_m4: f64::INFINITY,
    };

    /// The greater of both, each by itself. NaN bounds nothing; it counts as infinite.
    #[must_use]
    pub fn or_greater(&self, other: &Self) -> Self {
        let greater = |a: f64, b: f64| if b.is_nan() { f64::INFINITY } else { a.max(b) };
        Self {
            normal_m3: greater(self.normal_m3, other.normal_m3),
            slope_m3: greater(self.slope_m3, other.slope_m3),
            turn_m4: greater(self.turn_m4, other.turn_m4),
            lean_m4: greater(self.lean_m4, other.lean_m4),
        }
    }
}

/// Load on the foam by a plate, for every height within its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// Bounds on V = ∫ max(w, 0) dA, formula (31.1) \[m³\]: the least with the plate at its lowest, the greatest with it at its highest.
    pub volume_m3: [f64; 2],
    /// Upper bound on the compression w of the columns, H times the strain of requirement 30 \[m\].
    pub deepest_m: f64,
    /// Upper bound on ∫ max(w, 0) r / cos γ dA \[m⁴\], r the distance from the sponge's axis: the torque of formula (31.2) divided by μ E/H.
    pub twist_m4: f64,
    /// Upper bounds of what the plate's holder takes.
    pub holder: HolderVolumes,
    /// Part of a compression that comes from the bounds between the ends of a stretch \[m\].
    pub sag_m: f64,
}

impl Press {
    /// Load of which nothing is known.
    pub const UNKNOWN: Self = Self {
        volume_m3: [0.0, f64::INFINITY],
        deepest_m: f64::INFINITY,
        twist_m4: f64::INFINITY,
        holder: HolderVolumes::UNKNOWN,
        sag_m: f64::INFINITY,
    };

    /// Load without any part, the start value of a fold.
    const NONE: Self = Self {
        volume_m3: [0.0; 2],
        deepest_m: f64::NEG_INFINITY,
        twist_m4: 0.0,
        holder: HolderVolumes {
            normal_m3: 0.0,
            slope_m3: 0.0,
            turn_m4: 0.0,
            lean_m4: f64::INFINITY,
        },
        sag_m: 0.0,
    };

    /// Adds a part to V, to the twist and to the holder's integrals. `both` has its bounds, `size` its measures, `bends` the rim and |sin β|.
    fn add(&mut self, both: &PlatePartBounds, size: &Size, bends: &Bends<'_>) {
        let rim_m = bends.rim_m();
        let PlatePartBounds { low, high, .. } = both;
        let is_on = both.far_m < rim_m;
        self.sag_m = self.sag_m.max(low.sag_m).max(high.sag_m);
        if is_on {
            self.volume_m3[0] += low.mean_m[0].max(0.0) * size.area_m2;
        }
        if both.near_m <= rim_m {
            let mean_m = high.most_mean_m();
            self.volume_m3[1] += mean_m * size.area_m2;
            self.deepest_m = self.deepest_m.max(high.ends_m[1]);
            let least_m = if is_on { high.ends_m[0].max(0.0) } else { 0.0 };
            let half_range_m = 0.5 * (high.ends_m[1].max(0.0) - least_m);
            let moment_m2 = mean_m * size.arm_m + half_range_m * size.spread_m;
            // A part that is nowhere pressed twists nothing, even where nothing is known of it with the plate at its lowest.
            if moment_m2 != 0.0 {
                let seen_m2 = size.area_m2 / low.cosine.min(high.cosine);
                self.twist_m4 += moment_m2 * seen_m2;
                let (normal_m3, holder) = (mean_m * seen_m2, &mut self.holder);
                holder.normal_m3 += normal_m3;
                holder.slope_m3 += normal_m3 * bends.steepest([both.near_m, both.far_m]);
                holder.turn_m4 += normal_m3 * both.far_m.min(rim_m);
            }
        }
    }
}

/// Load that a plate certainly puts on the foam at a moment, for some height within its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateLoad {
    /// Attained ∫ max(w, 0) dA \[m³\]: no more than the first with the plate at its lowest, no less than the second with it at its highest.
    pub volume_m3: [f64; 2],
    /// Compression that a column has at least \[m\].
    pub deepest_m: f64,
    /// Point where the deepest column meets the surface, plate frame \[m\].
    pub deepest_at_m: [f64; 3],
}

/// Part of the sponge's face that may touch a plate over a stretch of time, in the frame of the tool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TouchRegion {
    /// Middle of the part, along the direction that turns with the tool, and across that and the axis \[m\].
    pub at_m: [f64; 2],
    /// Least and greatest distance from the tip along the axis at which it touches \[m\].
    pub along_m: [f64; 2],
}

/// State of a sponge on a plate at a moment: the points where its columns meet the plate at its lowest and at its highest.
#[derive(Debug, Clone)]
pub struct SpongeState {
    met: Vec<[SurfaceHit; 2]>,
    /// Point where the deepest column meets the plate at its highest \[m\].
    deepest_at_m: [f64; 3],
    /// Greatest |λ| \[m\].
    along_m: f64,
}

/// Bounds of a part over a stretch, with the plate at its lowest and at its highest.
struct PlatePartBounds {
    low: PartBounds,
    high: PartBounds,
    /// Least, and below greatest distance from the plate's axis at which it is met, for every height of the plate \[m\].
    near_m: f64,
    far_m: f64,
}

impl Columns {
    /// Computes the state of the sponge on a surface: w of formula (27.1) where each column meets it, with the plate at its lowest and at
    /// its highest. `pose` has p and a, `error_m` is δ \[m\]. `side` is a direction that turns with the tool, across its axis.
    #[must_use]
    pub fn sponge_state(&self, bends: &Bends<'_>, pose: &SpongePose, side: &Vector3<f64>, error_m: f64) -> SpongeState {
        let (surface, rim_m, axis) = (bends.surface(), bends.rim_m(), &pose.axis);
        let across = axis.cross(side);
        let compression_m = self.foundation().compression_m;
        let mut standing = SpongeState {
            met: Vec::with_capacity(self.sizes().len()),
            deepest_at_m: [0.0; 3],
            along_m: 0.0,
        };
        let (mut deepest_m, mut piece) = (f64::NEG_INFINITY, 0);
        // The planes through the places that were met: where the line begins, how far along, the normal and 1/(a·n).
        let mut planes: Vec<(Vector3<f64>, f64, Vector3<f64>, f64)> = Vec::with_capacity(standing.met.capacity());
        for ([x, y], inner) in self.middles_m().zip(self.inner()) {
            // A plate that lies lower is a sponge that stands higher.
            let middle = pose.tip + side * x + across * y;
            let low = middle + Vector3::z() * error_m;
            let guess_m = planes.get(inner).map_or(0.0, |(from, along_m, normal, over)| {
                along_m + (from - low).dot(normal) * over
            });
            let meets = meet_from(surface, &low, axis, (guess_m, &mut piece), bends.settled_m());
            let (along_m, normal) = (meets.0, meets.2);
            let over = 1.0 / normal.dot(axis);
            planes.push((low, along_m, normal, over));
            let high = middle - Vector3::z() * error_m;
            let guess_m = along_m + 2.0 * error_m * normal.z * over;
            let higher = meet_from(surface, &high, axis, (guess_m, &mut piece), bends.settled_m());
            let met = [&meets, &higher].map(|(along_m, point, normal)| {
                standing.along_m = standing.along_m.max(along_m.abs());
                SurfaceHit::new(compression_m - along_m, point, normal, axis)
            });
            if met[1].compression_m > deepest_m && met[1].rho_m < rim_m {
                deepest_m = met[1].compression_m;
                standing.deepest_at_m = higher.1.into();
            }
            standing.met.push(met);
        }
        standing
    }

    /// Bounds the load on the foam from one moment to another: the integrals of formulas (31.1), (31.2), (33.1) and (33.2). `drift` bounds
    /// the motion between both.
    #[must_use]
    pub fn bound_load(&self, bends: &Bends<'_>, ends: [&SpongeState; 2], drift: &Drift) -> Press {
        let mut press = Press::NONE;
        for (both, size) in self.over(bends, ends, drift).zip(self.sizes()) {
            press.add(&both, size, bends);
        }
        press
    }

    /// Returns the load that the plate certainly puts on the foam at a moment, and bounds of it.
    #[must_use]
    pub fn load_at(&self, bends: &Bends<'_>, at: &SpongeState) -> (PlateLoad, Press) {
        let rim_m = bends.rim_m();
        let mut press = Press::NONE;
        let mut seen = PlateLoad {
            volume_m3: [0.0; 2],
            deepest_m: f64::NEG_INFINITY,
            deepest_at_m: at.deepest_at_m,
        };
        for (both, size) in self.over(bends, [at; 2], &Drift::NONE).zip(self.sizes()) {
            press.add(&both, size, bends);
            if both.near_m <= rim_m {
                seen.volume_m3[0] += both.low.most_mean_m() * size.area_m2;
            }
            if both.far_m < rim_m {
                let mean_m = both.high.mean_m[0];
                seen.volume_m3[1] += mean_m.max(0.0) * size.area_m2;
                seen.deepest_m = seen.deepest_m.max(mean_m);
            }
        }
        (seen, press)
    }

    /// Returns the parts that may touch the plate at some moment of a stretch, for every height within its error. None reaches farther than
    /// [`Columns::reach_m`] from its middle. `None` if nothing is known of a part.
    #[must_use]
    pub fn touching(&self, bends: &Bends<'_>, ends: [&SpongeState; 2], drift: &Drift) -> Option<Vec<TouchRegion>> {
        let (rim_m, c) = (bends.rim_m(), self.foundation().compression_m);
        let mut all = Vec::new();
        for (at_m, PlatePartBounds { low, high, near_m, .. }) in self.middles_m().zip(self.over(bends, ends, drift)) {
            if high.ends_m[1] < 0.0 || near_m > rim_m {
                continue;
            }
            if !(low.ends_m[0].is_finite() && high.ends_m[1].is_finite()) {
                return None;
            }
            // It reaches no farther out than the free face.
            let along_m = [c - high.ends_m[1], (c - low.ends_m[0]).min(c)];
            all.push(TouchRegion { at_m, along_m });
        }
        Some(all)
    }

    /// Bounds every part over a stretch.
    fn over<'a>(
        &'a self,
        bends: &'a Bends<'_>,
        [from, to]: [&'a SpongeState; 2],
        drift: &Drift,
    ) -> impl Iterator<Item = PlatePartBounds> + 'a {
        let spread = Spread::new(self.foundation(), self.reach_m(), from.along_m.max(to.along_m), drift);
        let ends = from.met.iter().zip(&to.met).zip(self.sizes());
        ends.map(move |((from, to), size)| {
            let bound =
                |k: usize| PartBounds::over([&from[k], &to[k]], size, &spread, |between_m| bends.between(between_m));
            let (low, high) = (bound(0), bound(1));
            // With the plate between its lowest and its highest a part's place is between those of both, on a straight line seen from
            // above, and no farther from one of them than half of what they are apart.
            let apart_m = apart(from).max(apart(to)) + 0.5 * (low.slid_m + high.slid_m);
            PlatePartBounds {
                // If nothing is known, the position is unbounded.
                near_m: if apart_m.is_finite() {
                    low.rho_m[0].min(high.rho_m[0]) - apart_m
                } else {
                    f64::NEG_INFINITY
                },
                far_m: low.rho_m[1].max(high.rho_m[1]),
                low,
                high,
            }
        })
    }
}

/// Half of the distance between the positions of a part with the plate at its lowest and at its highest \[m\].
fn apart([low, high]: &[SurfaceHit; 2]) -> f64 {
    0.5 * (low.seen_m - high.seen_m).norm()
}
