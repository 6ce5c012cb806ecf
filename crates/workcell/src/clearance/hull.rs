//! The facets of a convex hull, to look at.

use super::convex::ConvexHull;
use nalgebra::Point3;
use parry3d_f64::math::Vector;

/// A body by its triangles.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Triangulated {
    /// Corners \[m\].
    pub corners: Vec<Point3<f64>>,
    /// Triangles by their corners' indices, counter-clockwise as seen from outside.
    pub triangles: Vec<[usize; 3]>,
}

/// The convex hull of points \[m\]; `None` where it has no volume or is too large to judge.
#[must_use]
pub fn hull_triangles(points: &[Point3<f64>]) -> Option<Triangulated> {
    let vertices: Vec<_> = points.iter().map(|p| Vector::new(p.x, p.y, p.z)).collect();
    let (corners, triangles) = ConvexHull::of(&vertices).ok()?.solid.to_trimesh();
    let corners = corners.into_iter().map(|c| Point3::new(c.x, c.y, c.z));
    let triangles = triangles
        .into_iter()
        .map(|triangle| triangle.map(|corner| corner as usize));
    Some(Triangulated {
        corners: corners.collect(),
        triangles: triangles.collect(),
    })
}
