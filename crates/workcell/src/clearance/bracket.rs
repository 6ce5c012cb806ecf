//! The distance of two convex parts between two bounds.
//!
//! Where routines of the GJK kind stop, and how far from the distance, depends on the shapes: 21 µm too much were seen between the arm and
//! its tool, 75 µm with tools thinner than a millimetre. Nothing can rest on that. But along any direction n the gap g(n) = min n·b − max n·a
//! over the points of both parts is a lower bound of the distance, and the distance of any two of their points an upper one; both
//! meet at the nearest points (duality of the nearest point of a convex set). So the directions and points that a routine finds are only
//! proposals, and how good they are is known afterwards.
//!
//! Where the first proposal leaves more than [`ERROR_M`] between the bounds, the nearest point of the Minkowski difference b − a to the origin
//! is looked for once more, by Wolfe's method (Finding the nearest point in a polytope, Math. Programming 11, 1976): it keeps at most four
//! extreme points and steps to the point of their affine hull nearest to the origin, or, where that leaves their convex hull, to
//! its border.

use super::part::Placed;
use parry3d_f64::math::Vector;

/// How far apart the bounds are, where the search ends by itself \[m\].
pub(super) const ERROR_M: f64 = 2e-6;

/// Directions that are tried at most.
const MOST_STEPS: usize = 64;

/// A part of a whole below which a weight or a direction counts as none.
const NOTHING: f64 = 1e-13;

/// Bounds of the distance between two cores, without the radii around them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bracket {
    /// The gap along `normal` \[m\].
    pub at_least: f64,
    /// The distance of two points \[m\].
    pub at_most: f64,
    /// Unit vector from the first part towards the second, base frame.
    pub normal: Vector,
}

impl Bracket {
    /// The bounds for the cores of two parts, from the nearest points that another routine found: their direction, not zero, and
    /// their distance \[m\].
    pub fn new(a: &Placed<'_>, b: &Placed<'_>, normal: Vector, distance: f64) -> Self {
        let nearest = |n: Vector| b.extreme(-n) - a.extreme(n);
        let first = nearest(normal);
        let mut bracket = Self {
            at_least: normal.dot(first),
            at_most: distance,
            normal,
        };
        if !bracket.is_tight() {
            bracket.search(first, nearest);
        }
        bracket
    }

    fn is_tight(&self) -> bool {
        let between = self.at_most - self.at_least;
        // No number gets any better.
        between <= ERROR_M || between.is_nan()
    }

    /// Improves both bounds, from an extreme point of the difference; `nearest` gives that which is least along a direction.
    fn search(&mut self, first: Vector, nearest: impl Fn(Vector) -> Vector) {
        let mut hull = Hull::point(first);
        for _ in 0..MOST_STEPS {
            let x = hull.nearest();
            let length = x.length();
            self.at_most = self.at_most.min(length);
            if length <= NOTHING || length.is_nan() {
                return;
            }
            let normal = x / length;
            let next = nearest(normal);
            let gap = normal.dot(next);
            if gap > self.at_least {
                (self.at_least, self.normal) = (gap, normal);
            }
            if self.is_tight() || !hull.add(next) {
                return;
            }
        }
    }
}

/// A simplex of up to four points, with the weights of its point nearest to the origin.
#[derive(Debug, Clone, Copy)]
struct Hull {
    points: [Vector; 4],
    weights: [f64; 4],
    count: usize,
}

impl Hull {
    fn point(point: Vector) -> Self {
        Self {
            points: [point; 4],
            weights: [1.0, 0.0, 0.0, 0.0],
            count: 1,
        }
    }

    /// Its point nearest to the origin.
    fn nearest(&self) -> Vector {
        (0..self.count).fold(Vector::ZERO, |sum, i| sum + self.points[i] * self.weights[i])
    }

    /// Takes in a point and leaves those that the nearest point does not need. False where nothing comes of it: the point is known, or
    /// there are four already, with the origin among them.
    fn add(&mut self, point: Vector) -> bool {
        if self.count == 4 || self.points[..self.count].contains(&point) {
            return false;
        }
        self.points[self.count] = point;
        self.weights[self.count] = 0.0;
        self.count += 1;
        loop {
            let Some(wanted) = self.affine() else { return false };
            // The share of the way to the affine hull's nearest point that stays within the convex hull.
            let leaves = (0..self.count).filter(|&i| wanted[i] <= NOTHING);
            let way = |i: usize| self.weights[i] / (self.weights[i] - wanted[i]).max(f64::MIN_POSITIVE);
            let out = leaves.min_by(|&i, &j| way(i).total_cmp(&way(j)));
            let share = out.map_or(1.0, way).clamp(0.0, 1.0);
            for (weight, wanted) in self.weights.iter_mut().zip(wanted).take(self.count) {
                *weight += share * (wanted - *weight);
            }
            let Some(out) = out else { return true };
            if self.count == 1 {
                return false;
            }
            self.count -= 1;
            self.points[out] = self.points[self.count];
            self.weights[out] = self.weights[self.count];
        }
    }

    /// Weights, of sum 1, of the affine hull's point nearest to the origin; `None` where the points are not independent. Least squares by
    /// Gram and Schmidt, from the point last taken in.
    fn affine(&self) -> Option<[f64; 4]> {
        let last = self.count - 1;
        let origin = self.points[last];
        let mut basis = [Vector::ZERO; 3];
        let mut upper = [[0.0; 3]; 3];
        let mut rest = -origin;
        let mut along = [0.0; 3];
        for i in 0..last {
            let edge = self.points[i] - origin;
            let mut across = edge;
            for k in 0..i {
                upper[k][i] = basis[k].dot(across);
                across -= basis[k] * upper[k][i];
            }
            let length = across.length();
            if length <= NOTHING * edge.length() || length.is_nan() {
                return None;
            }
            upper[i][i] = length;
            basis[i] = across / length;
            along[i] = basis[i].dot(rest);
            rest -= basis[i] * along[i];
        }
        let mut weights = [0.0; 4];
        for i in (0..last).rev() {
            let known: f64 = (i + 1..last).map(|k| upper[i][k] * weights[k]).sum();
            weights[i] = (along[i] - known) / upper[i][i];
        }
        weights[last] = 1.0 - weights[..last].iter().sum::<f64>();
        Some(weights)
    }
}
