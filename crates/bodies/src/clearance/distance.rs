//! Distance between two placed convex parts: quickly, and between bounds.
//!
//! The gap g of formulas (24.2) and (24.3) in `docs/certificate.md`.
//!
//! Routines of the GJK kind stop at a distance from the true one that depends on the shapes: 21 µm too much were seen between the arm and
//! its tool, 75 µm with tools thinner than a millimetre. A proof cannot depend on that. But along any direction n the gap g(n) = min n·b −
//! max n·a over the points of both parts is a lower bound of the distance, and the distance of any two of their points an upper one; both
//! meet at the nearest points (duality of the nearest point of a convex set). So the directions and points that a routine finds are only
//! proposals, and their quality is known afterwards.
//!
//! Where the first proposal leaves more than [`ERROR_M`] between the bounds, the nearest point of the Minkowski difference b − a to the origin
//! is looked for once more, by Wolfe's method (Finding the nearest point in a polytope, Math. Programming 11, 1976): it keeps at most four
//! extreme points and steps to the point of their affine hull nearest to the origin, or, where that leaves their convex hull, to
//! its border.

use crate::clearance::part::{Core, Extent, PlacedPart};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::query::details::closest_points_segment_segment;
use parry3d_f64::query::{ClosestPoints, DefaultQueryDispatcher, QueryDispatcher};
use parry3d_f64::shape::{Shape, SharedShape};

/// Distance between two parts, with the middle between their nearest points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Separation {
    /// Distance \[m\]; ≤ 0 if they touch or overlap.
    pub distance: f64,
    /// Middle between the nearest points, base frame \[m\].
    pub place: [f64; 3],
    /// Unit vector from the first part to the second along the nearest points, base frame; zero where their cores meet.
    pub normal: [f64; 3],
}

impl Separation {
    /// Nearest point of each part \[m\], base frame: half of the distance from the middle, either way.
    pub fn points(&self) -> [[f64; 3]; 2] {
        let (middle, half) = (
            Vector::from_array(self.place),
            Vector::from_array(self.normal) * (0.5 * self.distance),
        );
        [middle - half, middle + half].map(|point| point.to_array())
    }
}

/// Returns the distance between two parts, and a lower bound g(n) of it along the direction n that was found \[m\], up to the rounding of
/// closed forms and support functions. If the cores meet, the radii around them determine it.
pub(crate) fn bracketed(a: &PlacedPart<'_>, b: &PlacedPart<'_>) -> (Separation, f64) {
    let mut found = separation(a, b);
    if found.distance == f64::INFINITY {
        // The routine gave up.
        found = between_extremes(a, b);
    }
    let normal = Vector::from_array(found.normal);
    if a.is_exact_with(b) || normal == Vector::ZERO {
        let at_least = found.distance;
        return (found, at_least);
    }
    let radii = a.radius + b.radius;
    let bracket = Bracket::new(a, b, normal, found.distance + radii);
    found.distance = found.distance.min(bracket.at_most - radii);
    found.normal = bracket.normal.to_array();
    (found, bracket.at_least.max(0.0) - radii)
}

/// Distance of two points of two parts, those farthest along the line between their origins.
fn between_extremes(a: &PlacedPart<'_>, b: &PlacedPart<'_>) -> Separation {
    let way = b.pose.translation - a.pose.translation;
    let normal = if way.length() > 0.0 { way.normalize() } else { Vector::X };
    let [p, q] = [a.extreme(normal), b.extreme(-normal)];
    let (gap, length) = (q - p, (q - p).length());
    Separation {
        distance: length - a.radius - b.radius,
        place: ((p + q) * 0.5).to_array(),
        normal: (if length > 0.0 { gap / length } else { normal }).to_array(),
    }
}

/// Nearest points of two cores, base frame; equal if the cores meet.
type NearestPoints = (Vector, Vector);

/// Returns the distance between two parts quickly. It may be too great by some hundredths of a millimetre (see [`bracketed`]). NaN poses give
/// NaN, never a distance of 0.
pub(crate) fn separation(a: &PlacedPart<'_>, b: &PlacedPart<'_>) -> Separation {
    separation_below(a, b, f64::MAX)
}

/// Same as [`separation`], but infinite where the search finds that the distance is above `most_m` \[m\], which takes fewer steps.
pub(crate) fn separation_below(a: &PlacedPart<'_>, b: &PlacedPart<'_>, most_m: f64) -> Separation {
    if !(a.pose.translation.is_finite() && b.pose.translation.is_finite()) {
        return Separation {
            distance: f64::NAN,
            place: [f64::NAN; 3],
            normal: [0.0; 3],
        };
    }
    let most_m = most_m + a.radius + b.radius;
    let found = match (a.core, b.core) {
        (Core::HalfSpace, _) => return over_half_space(a, b, 1.0),
        (_, Core::HalfSpace) => return over_half_space(b, a, -1.0),
        (Core::Segment(half_a), Core::Segment(half_b)) => Some(segments(a, *half_a, b, *half_b)),
        (Core::Segment(half), Core::Solid(solid, _)) => segment_and_solid(a, *half, b, solid, most_m),
        (Core::Solid(solid, _), Core::Segment(half)) => {
            segment_and_solid(b, *half, a, solid, most_m).map(|(p, q)| (q, p))
        }
        (Core::Solid(solid_a, _), Core::Solid(solid_b, _)) => {
            iterative(&a.pose, &**solid_a, &b.pose, &**solid_b, most_m)
        }
    };
    let Some((p, q)) = found else {
        return Separation {
            distance: f64::INFINITY,
            place: a.pose.translation.to_array(),
            normal: [0.0; 3],
        };
    };
    let gap = q - p;
    let length = gap.length();
    let direction = if length > 0.0 { gap / length } else { Vector::ZERO };
    let middle = (p + direction * a.radius + q - direction * b.radius) * 0.5;
    Separation {
        distance: length - a.radius - b.radius,
        place: middle.to_array(),
        normal: direction.to_array(),
    }
}

/// Nearest points of two segments, a closed form.
fn segments(a: &PlacedPart<'_>, half_a: f64, b: &PlacedPart<'_>, half_b: f64) -> NearestPoints {
    let (sa, sb) = (a.segment(half_a), b.segment(half_b));
    match closest_points_segment_segment(&Pose::IDENTITY, &sa, &sb, f64::MAX) {
        ClosestPoints::WithinMargin(p, q) => (p, q),
        ClosestPoints::Intersecting | ClosestPoints::Disjoint => (sa.a, sa.a),
    }
}

/// Returns the point of a part's core that is nearest to a point, base frame; for a half-space, the point itself.
pub(crate) fn nearest_to(part: &PlacedPart<'_>, point: Vector) -> Vector {
    match part.core {
        Core::Segment(half) => {
            let axis = part.pose.rotation * Vector::Z;
            let along = axis.dot(point - part.pose.translation).clamp(-half, *half);
            part.pose.translation + axis * along
        }
        Core::Solid(solid, _) => solid.project_point(&part.pose, point, true).point,
        Core::HalfSpace => point,
    }
}

/// Nearest points of a segment or point and a solid: a point is projected, a segment uses the iterative routine.
fn segment_and_solid(
    a: &PlacedPart<'_>,
    half: f64,
    b: &PlacedPart<'_>,
    solid: &SharedShape,
    most_m: f64,
) -> Option<NearestPoints> {
    let segment = a.segment(half);
    if half == 0.0 {
        let projection = solid.project_point(&b.pose, segment.a, true);
        return Some((segment.a, projection.point));
    }
    iterative(&Pose::IDENTITY, &segment, &b.pose, &**solid, most_m)
}

/// Nearest points of two convex shapes by GJK; `None` if they are found to be farther apart than `most_m` \[m\].
fn iterative(pose_a: &Pose, a: &dyn Shape, pose_b: &Pose, b: &dyn Shape, most_m: f64) -> Option<NearestPoints> {
    let relative = pose_a.inv_mul(pose_b);
    match DefaultQueryDispatcher.closest_points(&relative, a, b, most_m) {
        Ok(ClosestPoints::WithinMargin(p, q)) => Some((*pose_a * p, *pose_b * q)),
        Ok(ClosestPoints::Disjoint) => None,
        Ok(ClosestPoints::Intersecting) | Err(_) => Some((pose_a.translation, pose_a.translation)),
    }
}

/// Height of a part over a half-space, a closed form. `towards` is 1 if the half-space comes first, else −1.
fn over_half_space(space: &PlacedPart<'_>, part: &PlacedPart<'_>, towards: f64) -> Separation {
    let up = space.pose.rotation * Vector::Z;
    let height = |p: &Vector| space.height_of(*p);
    let lowest = |points: &mut dyn Iterator<Item = Vector>| {
        points
            .min_by(|p, q| height(p).total_cmp(&height(q)))
            .unwrap_or(part.pose.translation)
    };
    let low = match part.core {
        Core::Segment(half) => {
            let segment = part.segment(*half);
            lowest(&mut [segment.a, segment.b].into_iter())
        }
        Core::Solid(_, Extent::Vertices(vertices)) => lowest(&mut vertices.iter().map(|v| part.pose * *v)),
        Core::Solid(_, Extent::Cylinder(radius, half)) => lowest_of_cylinder(part, *radius, *half, up),
        Core::HalfSpace => part.pose.translation,
    };
    let high = height(&low);
    let distance = high - part.radius;
    Separation {
        distance,
        place: (low - up * high + up * (distance * 0.5)).to_array(),
        normal: (up * towards).to_array(),
    }
}

/// Returns a unit vector that is level where `up` is up: x, if that is level.
fn level_direction(up: Vector) -> Vector {
    let side = if up.x.abs() < 0.9 { Vector::X } else { Vector::Y };
    (side - up * side.dot(up)).normalize()
}

/// Returns the lowest point of a cylinder where `up` is up: down along its axis, then down the steepest way across.
fn lowest_of_cylinder(part: &PlacedPart<'_>, radius: f64, half: f64, up: Vector) -> Vector {
    let axis = part.pose.rotation * Vector::Y;
    let along = axis.dot(up);
    let down_axis = if along > 0.0 { -axis } else { axis };
    // −up less its part along the axis, written so that nothing cancels when the axis is nearly upright.
    let level = axis.cross(up);
    let steep = level.length();
    let across = if steep > 0.0 {
        up.cross(level) * along / steep - up * steep
    } else {
        level_direction(up)
    };
    part.pose.translation + down_axis * half + across * radius
}

/// Rounding error allowed in a gap along a direction, or a distance in closed form \[m\].
///
/// A gap is the product of a direction with the difference of two support points. Each point passes through at most 10 rigid transforms:
/// mount, six joints, flange, body, part. A transform of a point x takes three products and three sums for each coordinate, and its rotation
/// is off by some units in the last place itself: together at most 20 u |x|, with u = 2⁻⁵³. With coordinates of at most L, and as much again
/// for the direction and the difference, the error is at most 420 u L, which is 5e-11 m for the greatest length that is judged, L = 1000 m.
pub(crate) const DISTANCE_ROUNDING_M: f64 = 1e-9;

/// Gap between the bounds at which the search ends \[m\].
pub(crate) const ERROR_M: f64 = 2e-6;

/// Greatest number of directions that are tried.
const MOST_STEPS: usize = 64;

/// Share below which a weight or a direction counts as zero.
const NOTHING: f64 = 1e-13;

/// Bounds of the distance between two cores, without the radii around them.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Bracket {
    /// Gap along `normal`, a lower bound \[m\].
    pub at_least: f64,
    /// Distance of two points, an upper bound \[m\].
    pub at_most: f64,
    /// Unit vector from the first part towards the second, base frame.
    pub normal: Vector,
}

impl Bracket {
    /// Returns the bounds for the cores of two parts, from the nearest points that another routine found: their direction, not zero, and
    /// their distance \[m\].
    pub fn new(a: &PlacedPart<'_>, b: &PlacedPart<'_>, normal: Vector, distance: f64) -> Self {
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

    /// Improves both bounds, from an extreme point of the difference. `nearest` returns the extreme point that is least along a direction.
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

/// Simplex of up to four points, with the weights of its point nearest to the origin.
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

    /// Returns the simplex's point nearest to the origin.
    fn nearest(&self) -> Vector {
        (0..self.count).fold(Vector::ZERO, |sum, i| sum + self.points[i] * self.weights[i])
    }

    /// Adds a point and keeps only those that the nearest point needs. Returns false if nothing changes: the point is known, or there are
    /// four already, with the origin among them.
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

    /// Returns the weights, of sum 1, of the affine hull's point nearest to the origin; `None` if the points are not independent. Least
    /// squares by Gram and Schmidt, from the point added last.
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
