//! Square cell of a plate's face, seen along the plate's axis, and its state under the sponge at a moment.
//!
//! A point of its patch is X + J δ + b ẑ, X the face over its middle, δ from there to the point (‖δ‖ ≤ r), J the tangents (1, 0, G_x) and
//! (0, 1, G_y), G the gradient there, and |b| ≤ ½ K r², K the greatest second derivative of the height over the cell. A plate that lies
//! higher by e adds e ẑ.
//!
//! The file also has functions that are affine over a square cell, and the share of the cell where one is below 0.

use crate::washing::shares::Sags;
use crate::washing::shares::edges::{Edges, Look};
use nalgebra::{Vector2, Vector3};
use platewash_bodies::coverage::area_of_rectangle_in_disc;
use platewash_workcell::surface::Surface;

/// Cell of the face, with bounds over its patch.
pub(crate) struct Cell {
    middle: [f64; 2],
    /// Half of the edge \[m\].
    pub half: f64,
    /// Point X of the face over the middle \[m\].
    pub point: Vector3<f64>,
    /// Gradient G of the height.
    gradient: Vector2<f64>,
    /// Half of the diagonal, r \[m\].
    pub reach_m: f64,
    /// Bound on the deviation of the patch from its tangent plane, ½ K r² \[m\].
    pub bend_m: f64,
    /// Upper bound on ‖J δ‖: r √(1 + G²) \[m\].
    pub tangent_m: f64,
    /// True if the gradient is 0.
    is_level: bool,
}

/// State of a cell under the sponge at a moment.
#[derive(Clone, Copy, Default)]
pub(crate) struct CellState {
    pub index: u32,
    /// True if all of the cell is in contact from the moment before to this one.
    pub full: bool,
    /// Compression over the middle \[m\].
    pub compression_m: f64,
    /// Greatest loss of compression over the patch, with the plate at its stated height \[m\].
    pub sloping_m: f64,
    /// Vector from the sponge's axis to the middle, across the axis \[m\].
    pub way: Vector3<f64>,
    /// Length of `way` \[m\].
    pub off_m: f64,
    /// Depth of the whole cell within the sponge's rim \[m\]; negative where a part is outside.
    pub inside_m: f64,
    /// Compression of the whole cell above the wanted one \[m\]; negative where a part has less.
    pub pressed_m: f64,
}

impl CellState {
    /// True if all of the cell is in contact by more than what is lost to the sags.
    pub fn is_in(&self, sags: &Sags) -> bool {
        (self.inside_m >= sags.aside_m) & (self.pressed_m >= sags.compression_m)
    }
}

impl Cell {
    pub fn new(surface: &Surface, [x, y]: [f64; 2], half: f64) -> Self {
        let reach_m = half * std::f64::consts::SQRT_2;
        let middle = Vector2::new(x, y);
        let rho = middle.norm();
        let at = surface.at_radius(rho);
        let slope = at.sine / at.cosine;
        let out = if rho > 0.0 { middle / rho } else { Vector2::x() };
        let patch = surface.patch(distances([x, y], half));
        // d tan β / dρ = κ / cos³ β, and tan β / ρ across.
        let steep = patch.least_cosine();
        let gradient = out * slope;
        Self {
            middle: [x, y],
            half,
            point: middle.push(at.height_m),
            gradient,
            reach_m,
            bend_m: 0.5 * patch.greatest_curvature() / (steep * steep * steep) * reach_m * reach_m,
            tangent_m: reach_m * (1.0 + slope * slope).sqrt(),
            is_level: gradient.x == 0.0 && gradient.y == 0.0,
        }
    }

    /// Upper bound on the distance of a point of the patch from X \[m\].
    pub fn max_distance_m(&self) -> f64 {
        self.tangent_m + self.bend_m
    }

    /// Components of a vector along the tangents.
    pub fn along(&self, v: &Vector3<f64>) -> [f64; 2] {
        [v.x + self.gradient.x * v.z, v.y + self.gradient.y * v.z]
    }

    /// Tangents of the patch along x and y, not normalised.
    pub fn tangents(&self) -> [Vector3<f64>; 2] {
        [
            Vector3::new(1.0, 0.0, self.gradient.x),
            Vector3::new(0.0, 1.0, self.gradient.y),
        ]
    }

    /// Writes the state at a moment, and tells the distance of the sponge's axis from the middle \[m\]. Beyond `reach_m` of it, nothing else
    /// is computed.
    #[inline]
    pub fn see(&self, edges: &Edges<'_>, look: &Look, reach_m: f64, state: &mut CellState) -> f64 {
        let axis = &look.axis;
        let away = self.point - look.tip;
        let along = away.dot(axis);
        let way = away - axis * along;
        let off_m = way.norm_squared().sqrt();
        let is_near = off_m <= reach_m;
        if !is_near {
            return off_m;
        }
        let across = if self.is_level {
            look.tilt
        } else {
            let [gx, gy] = self.along(axis);
            (gx * gx + gy * gy).sqrt()
        };
        let sloping_m = across * self.reach_m + look.upright * self.bend_m;
        let compression_m = edges.foundation.compression_m - along;
        state.index = look.index;
        state.compression_m = compression_m;
        state.sloping_m = sloping_m;
        state.way = way;
        state.off_m = off_m;
        state.inside_m = edges.foundation.radius_m - off_m - self.farther_m(look);
        state.pressed_m = compression_m - look.shallower_m(sloping_m) - edges.thresholds.compression_m;
        off_m
    }

    /// Greatest amount by which a point of the patch is farther from the sponge's axis than the middle, for every plate height within its
    /// error \[m\].
    pub fn farther_m(&self, look: &Look) -> f64 {
        self.max_distance_m() + look.aside_m
    }

    /// Returns upper bounds on the area of the patch within the rim, for parts that are the given shares of it seen along the axis \[m²\].
    pub fn greatest_areas(&self, surface: &Surface, shares: [f64; 3]) -> [f64; 3] {
        let ([x, y], half) = (self.middle, self.half);
        let rim_m = surface.rim_m();
        let between = distances([x, y], half);
        let all = 4.0 * half * half;
        let within = if between[1] <= rim_m {
            all
        } else {
            area_of_rectangle_in_disc(rim_m, [x - half, x + half], [y - half, y + half])
        };
        let cosine = surface.patch(between).least_cosine();
        shares.map(|share| (share * all).min(within) / cosine)
    }

    /// Checks that all of a square is beyond the rim.
    pub fn is_beyond([x, y]: [f64; 2], half: f64, rim_m: f64) -> bool {
        let [near_m, _] = distances([x, y], half);
        near_m >= rim_m
    }
}

/// Least and greatest distance of a square from the plate's axis \[m\].
fn distances([x, y]: [f64; 2], half: f64) -> [f64; 2] {
    let (x, y) = (x.abs(), y.abs());
    let (near, far) = (
        Vector2::new((x - half).max(0.0), (y - half).max(0.0)),
        Vector2::new(x + half, y + half),
    );
    [near.norm(), far.norm()]
}

/// Lower bound over a cell: value + slope·(place − middle), seen along the plate's axis, and −|over_height| times the height error of the
/// plate.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Lower {
    /// Value at the middle.
    pub value: f64,
    /// Slope along x and y.
    pub slope: [f64; 2],
    /// Slope along the height of the plate.
    pub over_height: f64,
    /// Likely upper bound on the amount by which the bounded quantity exceeds the bound.
    pub slack: f64,
}

impl Lower {
    /// Returns a bound that is the same everywhere.
    pub const fn flat(value: f64, slack: f64) -> Self {
        Self {
            value,
            slope: [0.0; 2],
            over_height: 0.0,
            slack,
        }
    }

    pub fn add(&mut self, other: &Self) {
        self.value += other.value;
        self.slope = [self.slope[0] + other.slope[0], self.slope[1] + other.slope[1]];
        self.over_height += other.over_height;
        self.slack += other.slack;
    }

    /// Returns the bound that holds for every height of the plate within its error; its slope along the height is 0.
    pub fn over_height_error(&self, height_error_m: f64) -> Self {
        Self {
            value: self.value - self.over_height.abs() * height_error_m,
            over_height: 0.0,
            ..*self
        }
    }

    /// Length of the slope.
    pub fn steepness(&self) -> f64 {
        let [x, y] = self.slope;
        (x * x + y * y).sqrt()
    }

    /// Least value over a cell.
    pub fn least(&self, half: f64) -> f64 {
        self.value - half * (self.slope[0].abs() + self.slope[1].abs())
    }

    /// Upper bound on the share of a cell where the bound is below a threshold.
    pub fn share_below(&self, threshold: f64, half: f64) -> f64 {
        share_below_0(self.value - threshold, self.slope.map(|slope| slope.abs() * half))
    }

    /// Returns the likely upper bound.
    pub fn likely(&self) -> Self {
        Self {
            value: self.value + self.slack,
            ..*self
        }
    }

    /// Returns the same bound with another middle, `[x, y]` away from this one.
    pub fn seen_from(&self, [x, y]: [f64; 2]) -> Self {
        Self {
            value: self.value + (self.slope[0] * x + self.slope[1] * y),
            ..*self
        }
    }
}

/// Share of the square [−1, 1]² where value + a x + b y < 0, with a and b not below 0, rounded up. With t = a + b − value it is the
/// distribution of a sum of two uniform variables, (t₊² − (t − 2a)₊² − (t − 2b)₊² + (t − 2a − 2b)₊²) / (8 a b).
fn share_below_0(value: f64, [a, b]: [f64; 2]) -> f64 {
    let (a, b) = (a.max(b), a.min(b));
    let t = a + b - value;
    if t <= 0.0 {
        return 0.0;
    }
    if value.is_nan() || t >= 2.0 * (a + b) {
        return 1.0;
    }
    // Hardly any slope along one edge: as if all were as low as the lower end of it.
    if b <= 1e-6 * a {
        return (t / (2.0 * a)).min(1.0);
    }
    let part = |less: f64| (t - less).max(0.0) * (t - less).max(0.0);
    let sum = part(0.0) - part(2.0 * a) - part(2.0 * b);
    // The error of the cancellation is less than this.
    (sum / (8.0 * a * b) + 1e-9).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against squares a hundredth of the cell wide.
        #[test]
        fn the_share_agrees_with_counted_squares(value in -3.0..3.0f64, a in 0.0..2.0f64, b in 0.0..2.0f64, flat in 0..4) {
            let (a, b) = if flat == 0 { (a, 0.0) } else { (a, b) };
            let n = 100;
            let at = |k: i32| (2.0 * f64::from(k) + 1.0) / f64::from(n) - 1.0;
            let below = (0..n * n).filter(|k| value + a * at(k / n) + b * at(k % n) < 0.0).count();
            let share = below as f64 / f64::from(n * n);
            prop_assert!((share_below_0(value, [a, b]) - share).abs() < 0.03, "{share}");
        }
    }

    #[test]
    fn nan_counts_as_below() {
        assert!(share_below_0(f64::NAN, [1.0, 1.0]) >= 1.0);
        assert!(share_below_0(-1.0, [0.0, 0.0]) >= 1.0 && share_below_0(1.0, [0.0, 0.0]) <= 0.0);
    }
}
