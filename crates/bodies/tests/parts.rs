//! Bodies by their planes, apart from the collision library's distances: what lies within one.

use nalgebra::{Point3, Vector3};
use platewash_bodies::clearance::hull_triangles;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_workcell::surface::Surface;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

pub fn rng(seed: u64) -> Pcg64 {
    Pcg64::seed_from_u64(seed)
}

/// A convex body.
pub struct Solid {
    pose: Pose,
    kind: Kind,
}

enum Kind {
    /// Points, and planes by normal and offset.
    Hull(Vec<Point3<f64>>, Vec<(Vector3<f64>, f64)>),
    /// Radius and half length.
    Cylinder(f64, f64),
}

impl Solid {
    pub fn new((shape, pose): &(Shape, Pose)) -> Self {
        let kind = match shape {
            Shape::Cylinder {
                radius_m,
                half_length_m,
            } => Kind::Cylinder(*radius_m, *half_length_m),
            Shape::Hull { points } => {
                let hull = hull_triangles(points).expect("a hull with a volume");
                let planes = hull.triangles.iter().filter_map(|triangle| {
                    let [a, b, c] = triangle.map(|i| hull.corners[i]);
                    let normal = (b - a).cross(&(c - a)).try_normalize(1e-30)?;
                    // Where the library's hull left points out, the plane is moved to hold them.
                    let most = points
                        .iter()
                        .map(|p| normal.dot(&p.coords))
                        .fold(f64::NEG_INFINITY, f64::max);
                    let size = points.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
                    // Slivers have no normal to trust.
                    (most - normal.dot(&a.coords) < 1e-6 * size).then_some((normal, most))
                });
                Kind::Hull(points.clone(), planes.collect())
            }
            other => panic!("no part of a plate: {other:?}"),
        };
        Self { pose: *pose, kind }
    }

    /// By how much a point is outside of some face \[m\]; ≤ 0 within.
    pub fn outside(&self, point: &Point3<f64>) -> f64 {
        let local = self.pose.inverse_transform_point(point);
        match &self.kind {
            Kind::Cylinder(radius, half) => (local.xy().coords.norm() - radius).max(local.z.abs() - half),
            Kind::Hull(_, planes) => {
                let beyond = planes.iter().map(|(normal, offset)| normal.dot(&local.coords) - offset);
                beyond.fold(f64::NEG_INFINITY, f64::max)
            }
        }
    }

    /// The corners; of a cylinder some points of its edges.
    pub fn corners(&self) -> Vec<Point3<f64>> {
        let local = match &self.kind {
            Kind::Hull(points, _) => points.clone(),
            Kind::Cylinder(radius, half) => {
                let angles = (0..24).map(|k| k as f64 * std::f64::consts::TAU / 24.0);
                let ends = |a: f64| [-half, *half].map(|z| Point3::new(radius * a.cos(), radius * a.sin(), z));
                angles.flat_map(ends).collect()
            }
        };
        local.iter().map(|point| self.pose * point).collect()
    }

    /// Corners and points between them: of edges, of facets, of all of it.
    pub fn samples(&self, rng: &mut Pcg64, count: usize) -> Vec<Point3<f64>> {
        let corners = self.corners();
        let mut samples = corners.clone();
        for k in 0..count {
            let of = 2 + k % 2;
            let mut sum = Vector3::zeros();
            let mut weight = 0.0;
            for _ in 0..of {
                let share = rng.random_range(0.01..1.0);
                sum += corners[rng.random_range(0..corners.len())].coords * share;
                weight += share;
            }
            samples.push((sum / weight).into());
        }
        for (i, a) in corners.iter().enumerate() {
            samples.extend(corners[i + 1..].iter().map(|b| nalgebra::center(a, b)));
        }
        samples
    }
}

/// The distance of a point over the face along the axis, times the cosine of the slope: not less than the distance from it where the
/// face is hollow.
pub fn height_over_face(surface: &Surface, point: &Point3<f64>) -> f64 {
    let at = surface.at_radius(point.xy().coords.norm());
    (point.z - at.height_m) * at.cosine
}
