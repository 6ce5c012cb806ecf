//! Square cell of a plate's face, seen along the plate's axis, and its state under the sponge at a moment.
//!
//! A point of its patch is X + J δ + b ẑ, X the face over its middle, δ from there to the point (‖δ‖ ≤ r), J the tangents (1, 0, G_x) and
//! (0, 1, G_y), G the gradient there, and |b| ≤ ½ K r², K the greatest second derivative of the height over the cell. A plate that lies
//! higher by e adds e ẑ.

use crate::washing::face_shares::look::Look;
use crate::washing::face_shares::sags::Sags;
use nalgebra::{Vector2, Vector3};
use platewash_bodies::coverage::area_of_rectangle_in_disc;
use platewash_workcell::surface::Surface;

/// FaceCell of the face, with bounds over its patch.
pub(crate) struct FaceCell {
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
    pub(super) is_level: bool,
}

/// State of a cell under the sponge at a moment.
#[derive(Clone, Copy, Default)]
pub(crate) struct CellState {
    pub index: u32,
    /// True if all of the cell is in contact from the moment before to this one.
    pub full: bool,
    /// Compression w over the middle, formula (27.1) \[m\].
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

impl FaceCell {
    /// Returns the square about a middle, with X, G, r and K of its patch: see the head of this file. `half` is half of the edge \[m\].
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

    /// Upper bound on the distance of a point of the patch from X \[m\]: r √(1 + G²) + ½ K r².
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
