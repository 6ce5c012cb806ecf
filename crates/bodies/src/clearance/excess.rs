//! Distance by which the convex parts of a mesh reach beyond it.

use crate::clearance::convex::{ConvexHull, bounds};
use nalgebra::Point3;
use parry3d_f64::math::Vector;
use parry3d_f64::query::{PointQuery, PointQueryWithLocation};
use parry3d_f64::shape::{TriMesh, TriMeshFlags};
use platewash_workcell::ranked::Ranked;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

/// Greatest gap between the bound and a distance that was found, unless [`MOST_CUTS`] come first \[m\].
const WITHIN_M: f64 = 5e-4;

/// Greatest number of triangles that are cut.
const MOST_CUTS: usize = 30_000;

/// Number of cells along the longest edge of a mesh in which a hollow within it is looked for.
const CELLS: f64 = 24.0;

/// Upper bound on the distance by which convex parts reach beyond the mesh that the parts enclose \[m\]. The inside of a closed mesh is not
/// beyond it; for an open one the surface alone counts. A hollow that no face of a part crosses, as one that is closed all around within a
/// hull, is found if it is as wide as a twelfth of the mesh.
///
/// Over a triangle of a face, the distance from the mesh is at most that of the middle and the distance from there to the farthest corner,
/// as it is 1-Lipschitz; and at most that of the farthest corner from any triangle of the mesh, as the distance from a convex set is a convex
/// function. The triangle with the greatest bound is cut into four until the bound is tight.
#[must_use]
pub fn excess_m(triangles: &[[Point3<f64>; 3]], parts: &[Vec<Point3<f64>>]) -> f64 {
    let vector = |p: &Point3<f64>| Vector::new(p.x, p.y, p.z);
    let Some(mesh) = Mesh::from_triangles(triangles, vector) else {
        return f64::INFINITY;
    };
    let mut found_m: f64 = 0.0;
    // Distance found in a hollow, and its bound.
    let mut hollow_m: [f64; 2] = [0.0; 2];
    let mut open = BinaryHeap::new();
    for part in parts {
        let corners: Vec<_> = part.iter().map(vector).collect();
        let hull = match ConvexHull::from_points(&corners) {
            Ok(hull) if hull.is_sound => hull,
            // No point of a hull is farther from a corner, which is of the mesh, than the corners are from each other.
            _ => {
                let [least, most] = bounds(&corners);
                return (most - least).length();
            }
        };
        let [found, bound] = mesh.hollow_m(&hull);
        hollow_m = [hollow_m[0].max(found), hollow_m[1].max(bound)];
        let faces = hull.triangles.iter();
        open.extend(faces.map(|face| mesh.cell(face.map(|k| hull.corners[k as usize]), &mut found_m)));
    }
    for _ in 0..MOST_CUTS {
        match open.peek() {
            Some(cell) if cell.rank > found_m + WITHIN_M => {}
            _ => break,
        }
        let quarters = open.pop().map(|cell| quarters(cell.value)).into_iter().flatten();
        open.extend(quarters.map(|corners| mesh.cell(corners, &mut found_m)));
    }
    let bound_m = open.peek().map_or(0.0, |cell| cell.rank);
    let [found, hollow_bound_m] = hollow_m;
    if found > bound_m { hollow_bound_m } else { bound_m }
}

/// Mesh from which distances are measured.
struct Mesh {
    surface: TriMesh,
    is_closed: bool,
}

impl Mesh {
    fn from_triangles(triangles: &[[Point3<f64>; 3]], vector: impl Fn(&Point3<f64>) -> Vector) -> Option<Self> {
        let mut numbers = BTreeMap::new();
        let mut points = Vec::new();
        let mut number = |corner: &Point3<f64>| {
            // Adding zero turns −0 into 0.
            let key = corner.coords.map(|c| (c + 0.0).to_bits());
            *numbers.entry([key.x, key.y, key.z]).or_insert_with(|| {
                points.push(vector(corner));
                points.len() as u32 - 1
            })
        };
        // Triangles that are there twice count once.
        let mut seen = BTreeSet::new();
        let mut once = |face: &[u32; 3]| {
            let mut turned = *face;
            let least = (0..3).min_by_key(|k| turned[*k]).unwrap_or(0);
            turned.rotate_left(least);
            seen.insert(turned)
        };
        let mut faces: Vec<[u32; 3]> = triangles
            .iter()
            .map(|corners| corners.each_ref().map(&mut number))
            .filter(|face| once(face))
            .collect();
        let volume: f64 = faces
            .iter()
            .map(|face| face.map(|k| points[k as usize]))
            .map(|[a, b, c]| a.dot(b.cross(c)))
            .sum();
        if volume < 0.0 {
            faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        let is_closed = is_closed(&faces);
        let surface = TriMesh::with_flags(points, faces, TriMeshFlags::ORIENTED).ok()?;
        Some(Self { surface, is_closed })
    }

    /// Greatest distance from a closed mesh of the middles of cells that lie in a convex part and not in the mesh, and the bound on those of the
    /// points of these cells \[m\]; 0 where there are none.
    fn hollow_m(&self, hull: &ConvexHull) -> [f64; 2] {
        let planes = hull.planes();
        if !self.is_closed || planes.is_empty() {
            return [0.0; 2];
        }
        let [least, most] = bounds(self.surface.vertices());
        let edge_m = (most - least).max_element() / CELLS;
        let [least, most] = bounds(&hull.corners);
        let counts = ((most - least) / edge_m).ceil();
        let along = |count: f64| 0..count as usize;
        let mut found_m: f64 = 0.0;
        for i in along(counts.x) {
            for j in along(counts.y) {
                for k in along(counts.z) {
                    let place = Vector::new(i as f64, j as f64, k as f64);
                    let middle = least + (place + Vector::splat(0.5)) * edge_m;
                    if planes.iter().all(|(normal, at)| normal.dot(middle) <= *at) {
                        found_m = found_m.max(self.beyond_m(middle).0);
                    }
                }
            }
        }
        [found_m, found_m + 0.5 * edge_m * 3f64.sqrt()]
    }

    /// Distance of a point from the mesh, 0 inside a closed one \[m\]; and the nearest triangle.
    fn beyond_m(&self, point: Vector) -> (f64, u32) {
        let (nearest, (triangle, _)) = self.surface.project_local_point_and_get_location(point, false);
        match self.is_closed && nearest.is_inside {
            true => (0.0, triangle),
            false => ((nearest.point - point).length(), triangle),
        }
    }

    /// Returns a triangle of a face with the bound on its distance from the mesh \[m\], and raises the distance that was found.
    fn cell(&self, corners: [Vector; 3], found_m: &mut f64) -> Ranked<[Vector; 3]> {
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let (beyond_m, triangle) = self.beyond_m(middle);
        *found_m = found_m.max(beyond_m);
        let triangle = self.surface.triangle(triangle);
        let of_corner = |corner: &Vector| triangle.distance_to_local_point(*corner, true);
        let of_corners_m = corners.iter().map(of_corner).fold(0.0, f64::max);
        let radius_m = corners
            .iter()
            .map(|corner| (*corner - middle).length())
            .fold(0.0, f64::max);
        Ranked {
            rank: (beyond_m + radius_m).min(of_corners_m),
            order: 0,
            value: corners,
        }
    }
}

/// True if each edge belongs to one triangle on each side.
fn is_closed(faces: &[[u32; 3]]) -> bool {
    let edges = faces.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let mut seen = BTreeSet::new();
    edges.clone().all(|edge| seen.insert(edge)) && edges.into_iter().all(|(a, b)| seen.contains(&(b, a)))
}

/// Returns the four triangles into which the middles of its edges cut a triangle.
fn quarters([a, b, c]: [Vector; 3]) -> [[Vector; 3]; 4] {
    let [ab, bc, ca] = [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clearance::{SolidParts, solid_parts};

    /// A box of half sides \[m\], its triangles outwards.
    fn cuboid(half: [f64; 3]) -> Vec<[Point3<f64>; 3]> {
        let corner = |k: usize| {
            Point3::from(std::array::from_fn(|axis| {
                if k >> axis & 1 == 1 { half[axis] } else { -half[axis] }
            }))
        };
        let sides = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
        triangles.map(|triangle| triangle.map(corner)).collect()
    }

    #[test]
    fn a_convex_mesh_is_its_hull() {
        let mesh = cuboid([0.1, 0.2, 0.05]);
        let hull = solid_parts(&mesh, SolidParts::Hull).unwrap();
        assert!(excess_m(&mesh, &hull) <= 1.001 * WITHIN_M);
        let flipped: Vec<_> = mesh.iter().map(|&[a, b, c]| [a, c, b]).collect();
        assert!(excess_m(&flipped, &hull) <= 1.001 * WITHIN_M);
    }

    #[test]
    fn the_hull_of_an_open_box_reaches_as_far_as_the_box_is_wide() {
        // Without its lid: the middle of the lid is 0.1 m from the nearest walls, and 0.3 m over the bottom.
        let mesh = &cuboid([0.1, 0.2, 0.15])[..10];
        let hull = solid_parts(mesh, SolidParts::Hull).unwrap();
        let found = excess_m(mesh, &hull);
        assert!((0.1..0.1 + 2.0 * WITHIN_M).contains(&found), "{found}");
    }

    /// No face of its hull is far from a box with walls all around: the hollow within is.
    #[test]
    fn a_closed_hollow_is_filled_by_its_hull() {
        let inner = cuboid([0.08, 0.18, 0.13]).into_iter().map(|[a, b, c]| [a, c, b]);
        let mesh: Vec<_> = cuboid([0.1, 0.2, 0.15]).into_iter().chain(inner).collect();
        let hull = solid_parts(&mesh, SolidParts::Hull).unwrap();
        let found = excess_m(&mesh, &hull);
        let cell_m = 0.4 / CELLS;
        assert!((0.08..0.08 + cell_m).contains(&found), "{found}");
        let solid = cuboid([0.1, 0.2, 0.15]);
        assert!(excess_m(&solid, &hull) <= 1.001 * WITHIN_M);
    }

    #[test]
    fn the_gap_of_two_boxes_is_filled_by_their_hull() {
        let half = [0.02, 0.1, 0.1];
        let beside = |by: f64| {
            cuboid(half)
                .into_iter()
                .map(move |t| t.map(|p| p + nalgebra::Vector3::new(by, 0.0, 0.0)))
        };
        let mesh: Vec<_> = beside(-0.05).chain(beside(0.05)).collect();
        let hull = solid_parts(&mesh, SolidParts::Hull).unwrap();
        // Half of the gap of 60 mm.
        let found = excess_m(&mesh, &hull);
        assert!((0.03..0.03 + 2.0 * WITHIN_M).contains(&found), "{found}");
        let parts = [beside(-0.05), beside(0.05)].map(|boxed| {
            solid_parts(&boxed.collect::<Vec<_>>(), SolidParts::Hull)
                .unwrap()
                .remove(0)
        });
        assert!(excess_m(&mesh, &parts) <= 1.001 * WITHIN_M);
    }
}
