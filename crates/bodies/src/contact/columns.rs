//! Face of a sponge as columns of foam, each compressed by the plate's surface below it.
//!
//! The face is cut into a disc and rings of equal width, the k-th ring into 6 k sectors. A column stands at the centroid of its part: of
//! a compression that is linear over the part it has the mean, exactly. Where the surface bends, the mean is off by no more than
//! ½ K d², with d² the mean square of the distance from the part's centroid and K the greatest second derivative of the compression across
//! the sponge.
//! Beyond the rim there is nothing: a part that is there in part counts for the greatest force and not for the least.

use crate::contact::foundation::Foundation;
use crate::contact::parts::{PartBounds, Size, Spread, SurfaceHit};
use crate::contact::sponge_pose::SpongePose;
use nalgebra::Vector3;
use platewash_kinematics::trig::{sin, sin_cos};
use platewash_workcell::surface::Surface;
use std::f64::consts::{PI, TAU};

/// Number of rings about the disc in the middle, and below for bounds that must be tight on sharp bends.
const RINGS: usize = 5;
const FINE_RINGS: usize = 8;

/// Greatest number of steps of Newton's method; each squares the error.
const STEPS: usize = 20;

/// Accuracy at which a column meets the surface \[m\].
const MEETS_M: f64 = 1e-11;

/// Part of the sponge's face, by its centroid on the unit disc.
#[derive(Debug, Clone, Copy)]
struct Part {
    at: [f64; 2],
    /// Area as a share of the unit disc.
    share: f64,
    /// Mean square of the distance from the centroid.
    square: f64,
    /// Index of its neighbour on the ring within; for the disc in the middle its own.
    inner: usize,
}

/// Face of a sponge in columns.
#[derive(Debug, Clone)]
pub struct Columns {
    parts: Vec<Part>,
    sizes: Vec<Size>,
    foundation: Foundation,
    /// Number of rings about the disc in the middle.
    rings: usize,
}

/// Column that meets a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// Point where the column meets the surface, plate frame \[m\].
    pub point: Vector3<f64>,
    /// Normal of the surface there.
    pub normal: Vector3<f64>,
    /// Compression w \[m\]; below 0 where the column does not reach the surface.
    pub compression_m: f64,
    /// Cross-section \[m²\].
    pub area_m2: f64,
}

/// Load on the foam for a pose, as bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load {
    /// Least and greatest V = ∫ max(w, 0) dA \[m³\].
    pub volume_m3: [f64; 2],
    /// Upper bound on the compression of the columns \[m\].
    pub deepest_m: f64,
    /// Lower bound on the compression of the columns \[m\]; below 0 where one does not reach the surface.
    pub shallowest_m: f64,
}

impl Columns {
    /// Returns the columns of a sponge.
    #[must_use]
    pub fn new(foundation: &Foundation) -> Self {
        Self::in_rings(foundation, RINGS)
    }

    /// Returns more and smaller columns, for bounds that are tight on sharp bends.
    #[must_use]
    pub fn fine(foundation: &Foundation) -> Self {
        Self::in_rings(foundation, FINE_RINGS)
    }

    fn in_rings(foundation: &Foundation, rings: usize) -> Self {
        let width = 2.0 / (2 * rings + 1) as f64;
        let mut parts = vec![Part {
            at: [0.0; 2],
            share: 0.25 * width * width,
            square: 0.125 * width * width,
            inner: 0,
        }];
        let mut within = 0;
        for ring in 1..=rings {
            let count = 6 * ring;
            let [inner, outer] = [ring as f64 - 0.5, ring as f64 + 0.5].map(|k| k * width);
            let (squares, cubes) = (
                outer * outer - inner * inner,
                outer * outer * outer - inner * inner * inner,
            );
            let half = PI / count as f64;
            let centroid = 2.0 / 3.0 * cubes / squares * sin(half) / half;
            for k in 0..count {
                let (s, c) = sin_cos(TAU * k as f64 / count as f64);
                parts.push(Part {
                    at: [centroid * c, centroid * s],
                    share: squares / count as f64,
                    square: 0.5 * (inner * inner + outer * outer) - centroid * centroid,
                    inner: within + k * (ring - 1) / ring,
                });
            }
            within = parts.len() - count;
        }
        let sizes = parts.iter().map(|part| part.size(foundation, rings)).collect();
        Self {
            parts,
            sizes,
            foundation: *foundation,
            rings,
        }
    }

    /// Returns the columns on a surface for a pose. A column that runs along the surface without meeting it counts as not compressed.
    pub fn on<'a>(&'a self, surface: &'a Surface, pose: &'a SpongePose) -> impl Iterator<Item = Column> + 'a {
        self.turned(surface, pose, across(&pose.axis))
    }

    /// Same as [`Self::on`], with the columns turned about the axis so that they stand along two unit vectors across it and each other:
    /// those of a sponge that turns with its tool.
    pub fn turned<'a>(
        &'a self,
        surface: &'a Surface,
        pose: &'a SpongePose,
        [u, v]: [Vector3<f64>; 2],
    ) -> impl Iterator<Item = Column> + 'a {
        let Foundation {
            radius_m,
            compression_m,
            ..
        } = self.foundation;
        let area_m2 = PI * radius_m * radius_m;
        self.parts.iter().map(move |part| {
            let start = pose.tip + (u * part.at[0] + v * part.at[1]) * radius_m;
            let (along_m, point, normal) = meet(surface, &start, &pose.axis);
            Column {
                point,
                normal,
                compression_m: compression_m - along_m,
                area_m2: area_m2 * part.share,
            }
        })
    }

    /// Half of the width of a part \[m\].
    #[must_use]
    pub fn half_width_m(&self) -> f64 {
        self.foundation.radius_m / (2 * self.rings + 1) as f64
    }

    /// Number of rings about the disc in the middle: the k-th has 6 k columns, the last one the last of [`Self::on_unit_disc`].
    #[must_use]
    pub fn rings(&self) -> usize {
        self.rings
    }

    /// Returns the positions of the columns on the unit disc, and their shares of its area: the disc in the middle first, then ring by
    /// ring.
    pub fn on_unit_disc(&self) -> impl Iterator<Item = ([f64; 2], f64)> + '_ {
        self.parts.iter().map(|part| (part.at, part.share))
    }

    /// Bounds the load on the foam for a pose: V of formula (31.1) in `docs/contact.md`, with every column compressed by `more_m` more.
    #[must_use]
    pub fn load(&self, surface: &Surface, pose: &SpongePose, more_m: f64) -> Load {
        let mut load = Load::NONE;
        for (column, size) in self.on(surface, pose).zip(self.sizes()) {
            let met = SurfaceHit::new(column.compression_m + more_m, &column.point, &column.normal, &pose.axis);
            let part = PartBounds::over([&met; 2], size, &Spread::NONE, |[near_m, far_m]| {
                surface.patch([near_m.max(0.0), far_m]).curvature
            });
            load.see(&part, column.area_m2, surface.rim_m());
        }
        load
    }

    /// Upper bound on the reach of a column's part from the column \[m\]. A part is hardly longer than it is wide.
    #[must_use]
    pub fn reach_m(&self) -> f64 {
        reach_m(&self.foundation, self.rings)
    }

    /// Returns the sizes of the parts.
    pub(crate) fn sizes(&self) -> &[Size] {
        &self.sizes
    }

    /// Returns the middles of the parts on the sponge's face, along the two unit vectors of [`Self::turned`] \[m\].
    pub(crate) fn middles_m(&self) -> impl Iterator<Item = [f64; 2]> {
        let radius_m = self.foundation.radius_m;
        self.parts.iter().map(move |part| part.at.map(|x| x * radius_m))
    }

    /// Returns the indices of the parts' neighbours on the ring within.
    pub(crate) fn inner(&self) -> impl Iterator<Item = usize> {
        self.parts.iter().map(|part| part.inner)
    }

    /// Returns the sponge as a foundation.
    #[must_use]
    pub fn foundation(&self) -> &Foundation {
        &self.foundation
    }
}

impl Load {
    /// Load without any part, the start value of a fold.
    const NONE: Self = Self {
        volume_m3: [0.0; 2],
        deepest_m: f64::NEG_INFINITY,
        shallowest_m: f64::INFINITY,
    };

    /// Adds a part on a plate with the given rim.
    fn see(&mut self, part: &PartBounds, area_m2: f64, rim_m: f64) {
        let [near_m, far_m] = part.rho_m;
        if near_m > rim_m {
            return;
        }
        self.deepest_m = self.deepest_m.max(part.ends_m[1]);
        self.volume_m3[1] += part.most_mean_m() * area_m2;
        if far_m < rim_m {
            self.shallowest_m = self.shallowest_m.min(part.ends_m[0]);
            self.volume_m3[0] += part.mean_m[0].max(0.0) * area_m2;
        }
    }
}

/// Upper bound on the reach of a column's part from the column \[m\].
fn reach_m(foundation: &Foundation, rings: usize) -> f64 {
    0.85 * 2.0 / (2 * rings + 1) as f64 * foundation.radius_m
}

impl Part {
    fn size(&self, foundation: &Foundation, rings: usize) -> Size {
        let (radius_m, square) = (foundation.radius_m, self.square);
        let ([x, y], r2) = (self.at, radius_m * radius_m);
        Size {
            reach_m: reach_m(foundation, rings),
            square_m2: square * r2,
            area_m2: PI * r2 * self.share,
            spread_m: square.sqrt() * radius_m,
            arm_m: (x * x + y * y + square).sqrt() * radius_m,
        }
    }
}

/// Returns two unit vectors across a unit vector and each other.
fn across(axis: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let side = if axis.x.abs() < 0.6 { Vector3::x() } else { Vector3::y() };
    let u = axis.cross(&side).normalize();
    [u, axis.cross(&u)]
}

/// Intersection of a line with a surface: the length along the line \[m\], the point \[m\] and the normal there.
type Meets = (f64, Vector3<f64>, Vector3<f64>);

/// Intersects a line along a unit vector from a point with a surface, by Newton's method on the height over the surface.
fn meet(surface: &Surface, start: &Vector3<f64>, axis: &Vector3<f64>) -> Meets {
    meet_from(surface, start, axis, (0.0, &mut 0), MEETS_M)
}

/// Same as [`meet`], from a guess of the length and of the piece of the meridian, until a step is no longer than `settled_m`: each squares
/// the error. `piece` becomes the one that is met.
pub(crate) fn meet_from(
    surface: &Surface,
    start: &Vector3<f64>,
    axis: &Vector3<f64>,
    (guess_m, piece): (f64, &mut usize),
    settled_m: f64,
) -> Meets {
    let Surface::Profile(meridian) = surface else {
        let along_m = -start.z / axis.z;
        let met = if along_m.is_finite() { along_m } else { f64::INFINITY };
        return (met, start + axis * along_m, Vector3::z());
    };
    let mut along_m = if guess_m.is_finite() { guess_m } else { 0.0 };
    let mut there = (*start, Vector3::z());
    for _ in 0..STEPS {
        let point = start + axis * along_m;
        let rho = point.xy().norm();
        let at = meridian.at_radius_near(rho, piece);
        let out = if rho > 0.0 { point.xy() / rho } else { Vector3::x().xy() };
        let normal = Vector3::new(-at.sine * out.x, -at.sine * out.y, at.cosine);
        there = (point, normal);
        let height_m = point.z - at.height_m;
        // By the normal, the height over the tangent plane is that over the surface times cos β.
        let step_m = -height_m * at.cosine / normal.dot(axis);
        if !step_m.is_finite() {
            return (f64::INFINITY, point, normal);
        }
        along_m += step_m;
        if step_m.abs() <= settled_m {
            return (along_m, there.0, there.1);
        }
    }
    // If a knot keeps it from settling, nothing is known.
    (f64::INFINITY, there.0, there.1)
}
