//! Axis of a measured plate: first by second moments, then by least squares.
//!
//! With the profile f, the residual of a point is z − f(ρ). A small turn (a, b, 0), about the pole, and a small shift of the axis by
//! (p, q) change it by a (y + f′ z y/ρ) − b (x + f′ z x/ρ) + f′ (p x + q y)/ρ. The profile is fitted anew after each step. A flat face does not
//! fix the shift, nor a sphere one of both: the rim, whose radius should be the same all round, takes part with little weight.

use crate::measured::algebra::{cholesky, median};
use crate::measured::knots::Profile;
use nalgebra::{Matrix3, Vector3};

/// Points with weights \[m², or any\].
pub(super) type Cloud = Vec<(Vector3<f64>, f64)>;

/// Weight of all of the rim's points relative to all points of the face.
const RIM_WEIGHT: f64 = 1e-3;

/// Factor from the median of residuals to the greatest one that is fitted, and the least value of that \[m\].
const OUTLIER: f64 = 8.0;
const LEAST_OUTLIER_M: f64 = 3e-4;

/// Number of points of a ring in which outliers are sought, and least and greatest number of these rings: of few points none is left out.
const RING_POINTS: usize = 12;
const LEAST_RINGS: usize = 20;
const MOST_RINGS: usize = 256;

/// Length of a step below which the axis is found \[m\].
const STILL_M: f64 = 1e-9;

/// Frame of a plate in that of its file.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    /// Rows: x, y and z of the plate.
    pub turn: Matrix3<f64>,
    /// Origin.
    pub origin: Vector3<f64>,
}

impl Frame {
    /// Returns the frame with z along an axis and x as near the file's as can be.
    pub fn new(axis: &Vector3<f64>, origin: Vector3<f64>) -> Self {
        let z = axis.normalize();
        // Of an axis along the file's x, x of the plate is near the file's y.
        let near = if z.x.abs() < 0.999 { Vector3::x() } else { Vector3::y() };
        let x = (near - z * z.dot(&near)).normalize();
        let turn = Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()]);
        Self { turn, origin }
    }

    /// Axis of the plate.
    pub fn axis(&self) -> Vector3<f64> {
        self.turn.row(2).transpose()
    }

    /// Converts a point to the plate frame.
    pub fn local(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.turn * (point - self.origin)
    }

    /// Converts a point from the plate frame.
    pub fn outside(&self, local: &Vector3<f64>) -> Vector3<f64> {
        self.origin + self.turn.transpose() * local
    }

    /// Returns the frame after a turn about its x and y \[rad\] and a shift of its origin along them \[m\].
    fn moved(&self, [a, b, p, q]: [f64; 4]) -> Self {
        let axis = self.turn.transpose() * Vector3::new(-b, a, 1.0);
        Self::new(&axis, self.outside(&Vector3::new(p, q, 0.0)))
    }

    /// Returns the frame with the origin moved along its axis.
    pub fn raised(&self, by: f64) -> Self {
        let origin = self.origin + self.axis() * by;
        Self { origin, ..*self }
    }
}

/// Face whose axis is sought.
pub(super) struct Fitted<'c> {
    /// Points of the face.
    pub cloud: &'c Cloud,
    /// Points of the rim; empty if it does not take part.
    pub rim: &'c [Vector3<f64>],
}

impl Fitted<'_> {
    /// Radius of the rim: the median over its sectors \[m\].
    pub fn rim_m(&self, frame: &Frame) -> f64 {
        median(self.rim.iter().map(|point| frame.local(point).xy().norm()).collect())
    }

    /// Points as ρ, z and weight \[m\].
    pub fn placed(&self, frame: &Frame) -> Vec<([f64; 2], f64)> {
        let placed = |(point, weight): &(Vector3<f64>, f64)| {
            let local = frame.local(point);
            ([local.xy().norm(), local.z], *weight)
        };
        self.cloud.iter().map(placed).collect()
    }

    /// Same as [`Self::placed`], with no weight left to outliers among the points of about the same radius.
    pub fn kept(&self, frame: &Frame, profile: &Profile) -> Vec<([f64; 2], f64)> {
        let mut all = self.placed(frame);
        let count = (all.len() / RING_POINTS).min(MOST_RINGS);
        if count < LEAST_RINGS {
            return all;
        }
        let ring = |rho: f64| ((rho / profile.rim_m() * count as f64) as usize).min(count - 1);
        let off = |[rho, z]: [f64; 2]| z - profile.height_m(rho);
        let mut off: Vec<f64> = all.iter().map(|(at, _)| off(*at)).collect();
        let mut sums = vec![[0.0; 2]; count];
        for (([rho, _], _), off) in all.iter().zip(&off) {
            let sum = &mut sums[ring(*rho)];
            *sum = [sum[0] + 1.0, sum[1] + off];
        }
        for (([rho, _], _), off) in all.iter().zip(&mut off) {
            let [number, sum] = sums[ring(*rho)];
            *off = (*off - sum / number).abs();
        }
        let limit = limit_m(off.clone());
        for ((_, weight), off) in all.iter_mut().zip(off) {
            if off > limit {
                *weight = 0.0;
            }
        }
        all
    }

    /// Moves the frame until the points are as near to the profile as can be. `refit` fits the profile to points, stated by ρ, z and weight.
    /// Returns the uncertainty of the centre \[m\], too.
    pub fn refine(
        &self,
        frame: &mut Frame,
        profile: &mut Profile,
        rounds: usize,
        refit: impl Fn(&[([f64; 2], f64)], &Profile) -> Profile,
    ) -> f64 {
        let mut unsure_m = f64::INFINITY;
        for _ in 0..rounds {
            *profile = refit(&self.kept(frame, profile), profile);
            let (step, sigma_m) = self.step(frame, profile);
            unsure_m = sigma_m;
            let rim_m = profile.rim_m();
            // Far from the axis that is sought, a step may lead too far.
            let bound = |x: f64, most: f64| x.clamp(-most, most);
            let [a, b, p, q] = step;
            *frame = frame.moved([
                bound(a, 0.1),
                bound(b, 0.1),
                bound(p, 0.1 * rim_m),
                bound(q, 0.1 * rim_m),
            ]);
            if (a.abs() + b.abs()) * rim_m + p.abs() + q.abs() < STILL_M {
                break;
            }
        }
        unsure_m
    }

    /// Returns the step to the least sum of squares, as turn and shift, and the standard deviation of the shift \[m\].
    fn step(&self, frame: &Frame, profile: &Profile) -> ([f64; 4], f64) {
        let (mut n, mut g) = ([0.0; 16], [0.0; 4]);
        let mut add = |change: [f64; 4], residual: f64, weight: f64| {
            for i in 0..4 {
                g[i] -= weight * change[i] * residual;
                (0..4).for_each(|j| n[4 * i + j] += weight * change[i] * change[j]);
            }
        };
        let (mut total, mut squares) = (0.0, 0.0);
        for ((point, _), ([rho, z], weight)) in self.cloud.iter().zip(self.kept(frame, profile)) {
            let local = frame.local(point);
            let [c, s] = [local.x, local.y].map(|x| x / rho.max(f64::MIN_POSITIVE));
            let (height_m, tan) = profile.at(rho);
            let residual = z - height_m;
            let change = [local.y + tan * z * s, -local.x - tan * z * c, tan * c, tan * s];
            add(change, residual, weight);
            total += weight;
            squares += weight * residual * residual;
        }
        let radii = self.rim.iter().map(|point| {
            let local = frame.local(point);
            (local, local.xy().norm())
        });
        let rim_m = median(radii.clone().map(|(_, rho)| rho).collect());
        let limit = limit_m(radii.clone().map(|(_, rho)| (rho - rim_m).abs()).collect());
        for (local, rho) in radii.filter(|(_, rho)| (rho - rim_m).abs() <= limit) {
            let [c, s] = [local.x / rho, local.y / rho];
            let weight = RIM_WEIGHT * total / self.rim.len() as f64;
            add([-local.z * s, local.z * c, -c, -s], rho - rim_m, weight);
        }
        // A little more on the diagonal: along what nothing fixes the frame stays.
        (0..4).for_each(|k| n[5 * k] += 1e-9 * total * if k < 2 { profile.rim_m() * profile.rim_m() } else { 1.0 });
        let inverse = |axis: usize| {
            let mut unit = [0.0; 4];
            unit[axis] = 1.0;
            cholesky(&mut n.clone(), &mut unit);
            unit[axis]
        };
        let mean = squares / total / self.cloud.len() as f64;
        let sigma_m = (mean * total * inverse(2).max(inverse(3))).sqrt();
        cholesky(&mut n, &mut g);
        (g, sigma_m)
    }
}

/// Greatest residual that is no outlier, from the magnitudes of all \[m\].
fn limit_m(off: Vec<f64>) -> f64 {
    (OUTLIER * median(off)).max(LEAST_OUTLIER_M)
}
