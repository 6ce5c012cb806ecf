//! Convex hulls, with a check that they are reliable.
//!
//! A hull from the collision library may be too small, down to a flat one for a body that is much wider than high, or bent inwards. So it
//! is compared with its points. If it fails, it is computed once more from the same points scaled to be as high as wide: a hull stays a
//! hull under any such map.
//!
//! The facets of a convex hull are available for display.

use nalgebra::Point3;
use parry3d_f64::math::Vector;
use parry3d_f64::shape::ConvexPolyhedron;
use parry3d_f64::transformation::try_convex_hull;
use std::collections::HashMap;

/// Greatest number of distinct corners of a mesh. A hull with all of them takes seconds.
pub(crate) const MOST_CORNERS: usize = 10_000;

/// Greatest number of vertices of a mesh whose hull is computed. Beyond that it takes minutes.
pub(crate) const MOST_VERTICES: usize = 50_000;

/// Distance of a point outside of a face that counts as rounding, and below the least thickness of a hull, both as a part of its size.
const HULL_ROUNDING: f64 = 1e-12;
const THINNEST_HULL: f64 = 1e-9;

/// Greatest distance from the hull of a point that counts as within \[m\]: less than [`crate::clearance::motion`] allows for rounding.
const LEFT_OUT_M: f64 = 1e-10;

/// Reason that points have no hull.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum HullFault {
    /// The points have no volume.
    Flat,
    /// There are more points than [`MOST_VERTICES`].
    ManyPoints(usize),
    /// The hull has more corners than [`MOST_CORNERS`].
    ManyCorners(usize),
}

/// Convex hull of points.
pub(crate) struct ConvexHull {
    /// The hull as a solid of the collision library.
    pub solid: ConvexPolyhedron,
    /// Points whose hull holds all points. The farthest point along a direction is among these, even if the solid is wrong, so that a gap
    /// along a direction is never overstated.
    pub corners: Vec<Vector>,
    /// True if the faces of the solid are those of the hull: its corners are complete.
    pub is_sound: bool,
}

impl ConvexHull {
    /// Computes the hull of points.
    pub fn of(points: &[Vector]) -> Result<Self, HullFault> {
        if points.len() > MOST_VERTICES {
            return Err(HullFault::ManyPoints(points.len()));
        }
        let frame = Frame::of(points).ok_or(HullFault::Flat)?;
        let plain = ConvexPolyhedron::from_convex_hull(points);
        match plain.as_ref().map_or(0, |solid| solid.points().len()) {
            corners if corners > MOST_CORNERS => return Err(HullFault::ManyCorners(corners)),
            _ => {}
        }
        let plain = plain.map(|solid| Self::checked(solid, points));
        let hull = match plain {
            Some(hull) if hull.is_sound => Some(hull),
            plain => {
                let drawn_out = frame.hull(points).map(|solid| Self::checked(solid, points));
                drawn_out.filter(|hull| hull.is_sound).or(plain)
            }
        };
        hull.ok_or(HullFault::Flat)
    }

    /// Makes the hull of some points from a computed solid. Points outside the solid are added to its corners.
    ///
    /// Points are dropped only where the faces close the solid and every vertex lies behind each face. If such a solid holds a ball of
    /// radius r about c, then a point p that lies at most ε beyond the faces is at most ε ‖p − c‖/r away from the solid: moved towards c by
    /// the factor r/(r + ε), it lies behind all faces.
    fn checked(solid: ConvexPolyhedron, points: &[Vector]) -> Self {
        let size = points.iter().map(|p| p.length()).fold(0.0, f64::max);
        let planes = planes(&solid);
        // The middle of the vertices is within.
        let middle = solid.points().iter().fold(Vector::ZERO, |sum, p| sum + *p) / solid.points().len() as f64;
        let depth = planes.iter().map(|(normal, at)| at - normal.dot(middle));
        let ball = depth.fold(f64::INFINITY, f64::min);
        let rounding = (HULL_ROUNDING * size).min(LEFT_OUT_M * ball / (2.0 * size));
        // NaN is outside.
        let is_behind = |point: &Vector| planes.iter().all(|(normal, at)| normal.dot(*point) - at <= rounding);
        if !(ball > 0.0 && is_closed(&solid) && solid.points().iter().all(is_behind)) {
            let corners = points.to_vec();
            return Self {
                solid,
                corners,
                is_sound: false,
            };
        }
        let outside: Vec<_> = points.iter().filter(|point| !is_behind(point)).copied().collect();
        Self {
            is_sound: outside.is_empty(),
            corners: solid.points().iter().copied().chain(outside).collect(),
            solid,
        }
    }

    /// Returns the planes of its faces: outward unit normals and their distances from the origin \[m\]; empty for an unreliable hull.
    pub fn planes(&self) -> Vec<(Vector, f64)> {
        if self.is_sound { planes(&self.solid) } else { Vec::new() }
    }
}

fn planes(solid: &ConvexPolyhedron) -> Vec<(Vector, f64)> {
    let corner = |first: u32| solid.points()[solid.vertices_adj_to_face()[first as usize] as usize];
    let plane = |normal: Vector, first: u32| (normal, normal.dot(corner(first)));
    let faces = solid.faces().iter();
    faces
        .map(|face| plane(face.normal, face.first_vertex_or_edge))
        .collect()
}

/// True if the faces of a hull have no border: each edge belongs to two faces.
fn is_closed(hull: &ConvexPolyhedron) -> bool {
    let mut faces_of: HashMap<[u32; 2], usize> = HashMap::new();
    for face in hull.faces() {
        let first = face.first_vertex_or_edge as usize;
        let corners = &hull.vertices_adj_to_face()[first..first + face.num_vertices_or_edges as usize];
        let next = corners.iter().cycle().skip(1);
        for (a, b) in corners.iter().zip(next) {
            *faces_of.entry([*a.min(b), *a.max(b)]).or_default() += 1;
        }
    }
    !faces_of.is_empty() && faces_of.values().all(|count| *count == 2)
}

/// Axes along which points extend, the longest first, with their extents.
struct Frame {
    origin: Vector,
    axes: [Vector; 3],
    lengths: [f64; 3],
}

impl Frame {
    /// Returns the axes of points; `None` if they have no volume: no point is off the plane through three that are far apart.
    fn of(points: &[Vector]) -> Option<Self> {
        let origin = points.first().copied()?;
        let farthest = |distance: &dyn Fn(Vector) -> f64| {
            let far = points
                .iter()
                .copied()
                .max_by(|a, b| distance(*a).total_cmp(&distance(*b)));
            far.map_or((origin, 0.0), |point| (point, distance(point)))
        };
        let (second, size) = farthest(&|p| (p - origin).length());
        let along = (second - origin) / size;
        let (third, width) = farthest(&|p| (p - origin).cross(along).length());
        let normal = along.cross(third - origin).normalize_or_zero();
        let (_, height) = farthest(&|p| (p - origin).dot(normal).abs());
        let has_volume = width > THINNEST_HULL * size && height > THINNEST_HULL * size;
        has_volume.then(|| Self {
            origin,
            axes: [along, normal.cross(along), normal],
            lengths: [size, width, height],
        })
    }

    /// Computes the hull of points after scaling them to be as high as wide.
    fn hull(&self, points: &[Vector]) -> Option<ConvexPolyhedron> {
        let [x, y, z] = [0, 1, 2].map(|k| self.axes[k] / self.lengths[k]);
        let drawn_out: Vec<_> = points
            .iter()
            .map(|p| *p - self.origin)
            .map(|p| Vector::new(p.dot(x), p.dot(y), p.dot(z)))
            .collect();
        let (corners, faces) = try_convex_hull(&drawn_out).ok()?;
        let [x, y, z] = [0, 1, 2].map(|k| self.axes[k] * self.lengths[k]);
        let back = |p: Vector| self.origin + x * p.x + y * p.y + z * p.z;
        ConvexPolyhedron::from_convex_mesh(corners.into_iter().map(back).collect(), &faces)
    }
}

/// True if the points span a volume.
pub(crate) fn has_volume(points: &[Vector]) -> bool {
    Frame::of(points).is_some()
}

/// Body given by its triangles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TriangleMesh {
    /// Corners \[m\].
    pub corners: Vec<Point3<f64>>,
    /// Triangles by their corners' indices, counter-clockwise as seen from outside.
    pub triangles: Vec<[usize; 3]>,
}

/// Returns the convex hull of points \[m\]; `None` if it has no volume or is too large to judge.
#[must_use]
pub fn hull_triangles(points: &[Point3<f64>]) -> Option<TriangleMesh> {
    let vertices: Vec<_> = points.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
    let (corners, triangles) = ConvexHull::of(&vertices).ok()?.solid.to_trimesh();
    let corners = corners.into_iter().map(|c| Point3::new(c.x, c.y, c.z));
    let triangles = triangles
        .into_iter()
        .map(|triangle| triangle.map(|corner| corner as usize));
    Some(TriangleMesh {
        corners: corners.collect(),
        triangles: triangles.collect(),
    })
}
