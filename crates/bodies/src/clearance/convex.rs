//! Convex hulls that hold their points, whatever the collision library makes of them.
//!
//! A hull from the collision library may be too small, down to a flat one for a body that is much wider than high, or bent inwards. So a
//! point is left out only where it is a mixture of corners that stay: weights of these corners, none below 0 and of sum 1, give the point.
//! That needs no trust in the library. Points without such weights become corners. If there are some, the hull is computed once more from
//! the same points scaled to be as high as wide: a hull stays a hull under any such map.
//!
//! The library merges neighbouring triangles with nearly the same normal to faces. The planes of such faces may lie off their corners, by
//! millimetres for a sheet: they hold nothing. The triangles are kept as they were found.

use nalgebra::{Matrix3, Point3, Vector3};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::ConvexPolyhedron;
use parry3d_f64::transformation::try_convex_hull;
use std::collections::{BTreeMap, BTreeSet};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Greatest number of distinct corners of a mesh. A hull with all of them takes seconds.
pub(crate) const MOST_CORNERS: usize = 10_000;

/// Greatest number of vertices of a mesh whose hull is computed. Beyond that it takes minutes.
pub(crate) const MOST_VERTICES: usize = 50_000;

/// Least thickness of a hull, as a part of its size.
const THINNEST_HULL: f64 = 1e-9;

/// Greatest distance of a point from a mixture of corners that counts as the point itself \[m\]: less than [`crate::clearance::part_pair`] allows for rounding.
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
    /// Points whose hull holds all points, up to [`LEFT_OUT_M`]. The farthest point along a direction is among these, even if the solid is
    /// wrong, so that a gap along a direction is never overstated.
    pub corners: Vec<Vector>,
    /// Surface of the hull as the collision library found it, by the corners' indices, counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// True if the corners of the surface are all of the corners.
    pub is_sound: bool,
}

impl ConvexHull {
    /// Computes the hull of points.
    pub fn from_points(points: &[Vector]) -> Result<Self, HullFault> {
        if points.len() > MOST_VERTICES {
            return Err(HullFault::ManyPoints(points.len()));
        }
        let frame = Frame::from_points(points).ok_or(HullFault::Flat)?;
        let plain = Surface::from_points(points);
        match plain.as_ref().map_or(0, |surface| surface.corners.len()) {
            corners if corners > MOST_CORNERS => return Err(HullFault::ManyCorners(corners)),
            _ => {}
        }
        let hull = match plain.and_then(|surface| surface.holding(points)) {
            Some(hull) if hull.is_sound => Some(hull),
            plain => {
                let drawn_out = frame.surface(points).and_then(|surface| surface.holding(points));
                drawn_out.filter(|hull| hull.is_sound).or(plain)
            }
        };
        hull.ok_or(HullFault::Flat)
    }

    /// Returns the planes of its faces: outward unit normals and their distances from the origin \[m\]. Corners may lie beyond them. Empty
    /// for a hull whose surface does not hold its points.
    pub fn planes(&self) -> Vec<(Vector, f64)> {
        if !self.is_sound {
            return Vec::new();
        }
        let corner = |first: u32| self.solid.points()[self.solid.vertices_adj_to_face()[first as usize] as usize];
        let plane = |normal: Vector, first: u32| (normal, normal.dot(corner(first)));
        let faces = self.solid.faces().iter();
        faces
            .map(|face| plane(face.normal, face.first_vertex_or_edge))
            .collect()
    }
}

/// Surface of a hull as the collision library found it: some of the points, and triangles of them.
struct Surface {
    corners: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
}

impl Surface {
    fn from_points(points: &[Vector]) -> Option<Self> {
        let (corners, triangles) = guarded(|| try_convex_hull(points).ok()).flatten()?;
        Some(Self { corners, triangles })
    }

    /// Makes a hull that holds some points. Those that are no mixtures of the surface's corners become corners.
    fn holding(self, points: &[Vector]) -> Option<ConvexHull> {
        let mixtures = Mixtures::new(&self);
        let known: BTreeSet<_> = self.corners.iter().map(|corner| bits(*corner)).collect();
        let is_outside = |point: &Vector| !known.contains(&bits(*point)) && !mixtures.have(*point);
        let outside: Vec<_> = points.iter().copied().filter(is_outside).collect();
        let solid = guarded(|| ConvexPolyhedron::from_convex_mesh(self.corners.clone(), &self.triangles)).flatten()?;
        Some(ConvexHull {
            solid,
            is_sound: outside.is_empty(),
            corners: self.corners.into_iter().chain(outside).collect(),
            triangles: self.triangles,
        })
    }
}

/// Calls the collision library; `None` if it panics, as it does for some meshes.
pub(crate) fn guarded<T>(call: impl FnOnce() -> T) -> Option<T> {
    catch_unwind(AssertUnwindSafe(call)).ok()
}

/// Mean of some points; the origin without any.
pub(crate) fn middle(points: &[Vector]) -> Vector {
    points.iter().fold(Vector::ZERO, |sum, p| sum + *p) / points.len().max(1) as f64
}

/// Least and greatest coordinates of some points.
pub(crate) fn bounds(points: &[Vector]) -> [Vector; 2] {
    let none = [Vector::splat(f64::INFINITY), Vector::splat(f64::NEG_INFINITY)];
    points
        .iter()
        .fold(none, |[least, most], point| [least.min(*point), most.max(*point)])
}

/// Bits of a point's coordinates; those of 0 for −0.
pub(crate) fn bits(point: Vector) -> [u64; 3] {
    (point + Vector::ZERO).to_array().map(f64::to_bits)
}

/// Tetrahedra between the triangles of a surface and the middle of its corners.
struct Mixtures {
    /// Mean of the corners.
    middle: Vector,
    /// Triangles, each with the vector whose dot product with a point's place from the middle tells how far out the point is: 1 in the
    /// triangle's plane.
    faces: Vec<(Vector, [Vector; 3])>,
}

/// Share by which a point may be farther out of one triangle than of the farthest, and be looked for there.
const NEARLY: f64 = 1e-9;

impl Mixtures {
    fn new(surface: &Surface) -> Self {
        let middle = middle(&surface.corners);
        let face = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|k| surface.corners[k as usize]);
            let normal = (b - a).cross(c - a);
            let outwards = normal / normal.dot(a - middle);
            // A triangle without area, or through the middle, has no cone.
            (normal.dot(a - middle) > 0.0 && outwards.is_finite()).then_some((outwards, [a, b, c]))
        };
        Self {
            middle,
            faces: surface.triangles.iter().filter_map(face).collect(),
        }
    }

    /// True if a point is a mixture of the middle and the corners of one triangle, up to [`LEFT_OUT_M`]. The middle is a mixture of all
    /// corners. The triangle is proposed: it is the one that the ray from the middle through the point meets, if the surface is convex.
    fn have(&self, point: Vector) -> bool {
        let way = point - self.middle;
        let farthest = self
            .faces
            .iter()
            .map(|(outwards, _)| outwards.dot(way))
            .fold(0.0, f64::max);
        let mut met = self
            .faces
            .iter()
            .filter(|(outwards, _)| outwards.dot(way) >= farthest - NEARLY);
        met.any(|(_, triangle)| is_in_triangle(triangle, point) || self.is_in_cone(triangle, way))
    }

    /// True if a place from the middle is a mixture of the middle and the triangle's corners.
    fn is_in_cone(&self, triangle: &[Vector; 3], way: Vector) -> bool {
        let edges = triangle.map(|corner| corner - self.middle);
        let column = |v: Vector| Vector3::new(v.x, v.y, v.z);
        let solved = Matrix3::from_columns(&edges.map(column)).lu().solve(&column(way));
        solved.is_some_and(|weights| is_mixture(&edges, weights.into(), way))
    }
}

/// True if a point is a mixture of a triangle's corners.
fn is_in_triangle(&[a, b, c]: &[Vector; 3], point: Vector) -> bool {
    let (edges, way) = ([b - a, c - a], point - a);
    // The weights of the point that is nearest in the triangle's plane.
    let [bb, bc, cc] = [edges[0].dot(edges[0]), edges[0].dot(edges[1]), edges[1].dot(edges[1])];
    let [along_b, along_c] = edges.map(|edge| edge.dot(way));
    let area = bb * cc - bc * bc;
    let weights = [
        (cc * along_b - bc * along_c) / area,
        (bb * along_c - bc * along_b) / area,
    ];
    is_mixture(&edges, weights, way)
}

/// True if a place from a corner is a mixture of that corner and the ends of some edges from it, with weights near these. False for NaN.
fn is_mixture<const N: usize>(edges: &[Vector; N], weights: [f64; N], way: Vector) -> bool {
    let weights = weights.map(|weight| weight.max(0.0));
    let most = weights.iter().sum::<f64>().max(1.0);
    let parts = edges.iter().zip(weights).map(|(edge, weight)| *edge * (weight / most));
    let mixed = parts.fold(Vector::ZERO, |sum, part| sum + part);
    (mixed - way).length() <= LEFT_OUT_M
}

/// Axes along which points extend, the longest first, with their extents.
struct Frame {
    origin: Vector,
    axes: [Vector; 3],
    lengths: [f64; 3],
}

impl Frame {
    /// Returns the axes of points; `None` if they have no volume: no point is off the plane through three that are far apart.
    fn from_points(points: &[Vector]) -> Option<Self> {
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

    /// Computes the surface of the hull of points after scaling them to be as high as wide.
    fn surface(&self, points: &[Vector]) -> Option<Surface> {
        let [x, y, z] = [0, 1, 2].map(|k| self.axes[k] / self.lengths[k]);
        let drawn_out: Vec<_> = points
            .iter()
            .map(|p| *p - self.origin)
            .map(|p| Vector::new(p.dot(x), p.dot(y), p.dot(z)))
            .collect();
        let found = Surface::from_points(&drawn_out)?;
        let of: BTreeMap<_, _> = drawn_out.iter().map(|p| bits(*p)).zip(points).collect();
        let corners = found.corners.iter().map(|p| of.get(&bits(*p)).copied().copied());
        Some(Surface {
            corners: corners.collect::<Option<_>>()?,
            triangles: found.triangles,
        })
    }
}

/// True if the points span a volume.
pub(crate) fn has_volume(points: &[Vector]) -> bool {
    Frame::from_points(points).is_some()
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
    let hull = ConvexHull::from_points(&vertices).ok()?;
    let corners = hull.corners.iter().map(|c| Point3::new(c.x, c.y, c.z));
    let triangles = hull
        .triangles
        .iter()
        .map(|triangle| triangle.map(|corner| corner as usize));
    Some(TriangleMesh {
        corners: corners.collect(),
        triangles: triangles.collect(),
    })
}
