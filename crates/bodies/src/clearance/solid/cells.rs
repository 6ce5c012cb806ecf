//! Cells of a mesh that are nearly convex, and the parts that enclose its triangles: about one for each cell.

use crate::clearance::convex::{ConvexHull, bits, bounds, guarded, has_volume, middle};
use crate::clearance::solid::error::SolidError;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

/// Settings of the proposal of cuts.
pub(super) struct Cuts {
    /// Greatest number of parts; some more may be proposed.
    pub(super) most_parts: u32,
    /// Number of cells along the longest edge of the mesh.
    pub(super) cells: u32,
    /// Greatest depth of a hollow in a part, as a share of the mesh's hull.
    pub(super) hollow: f64,
}

/// Half of the thickness added to a part without one \[m\].
pub(crate) const SHEET_M: f64 = 5e-5;

/// Distance beyond a plane at which a piece of a surface counts as behind it, as a part of the mesh's size.
const ROUNDING: f64 = 1e-12;

/// Convex part: its corners, and the planes that it is behind, or nearly so.
pub(super) struct Part {
    pub(super) corners: Vec<Vector>,
    /// Outward unit normals and their distances from the origin; empty for an unreliable hull.
    pub(super) planes: Vec<(Vector, f64)>,
}

impl Part {
    pub(super) fn around(points: Vec<Vector>) -> Self {
        match ConvexHull::from_points(&points) {
            Ok(hull) => Self {
                planes: hull.planes(),
                corners: hull.corners,
            },
            Err(_) => Self {
                corners: points,
                planes: Vec::new(),
            },
        }
    }

    /// Cuts a polygon into a piece behind all planes, empty if there is none, and the other pieces. The pieces make up the polygon.
    fn cut(&self, polygon: Vec<Vector>, rounding: f64) -> (Vec<Vector>, Vec<Vec<Vector>>) {
        if self.planes.is_empty() {
            return (Vec::new(), vec![polygon]);
        }
        let (mut within, mut without) = (polygon.clone(), Vec::new());
        for (normal, at) in &self.planes {
            let height = |p: &Vector| normal.dot(*p) - at;
            if within.iter().all(|p| height(p) <= rounding) {
                continue;
            }
            let (behind, beyond) = split(&within, height);
            if behind.len() < 3 {
                // What is behind is an edge or a corner of what is beyond.
                return (Vec::new(), vec![polygon]);
            }
            without.push(beyond);
            within = behind;
        }
        (within, without)
    }

    fn middle(&self) -> Vector {
        middle(&self.corners)
    }
}

/// Splits a convex polygon into the pieces behind a plane and beyond it, both with the points in the plane, and with points of which
/// neither is certain (NaN).
fn split(polygon: &[Vector], height: impl Fn(&Vector) -> f64) -> (Vec<Vector>, Vec<Vector>) {
    let (mut behind, mut beyond) = (Vec::new(), Vec::new());
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (height(p), height(q));
        let (is_beyond, is_behind) = (here > 0.0, here < 0.0);
        if !is_beyond {
            behind.push(*p);
        }
        if !is_behind {
            beyond.push(*p);
        }
        if (is_behind && there > 0.0) || (is_beyond && there < 0.0) {
            let between = *p + (*q - *p) * (here / (here - there));
            behind.push(between);
            beyond.push(between);
        }
    }
    (behind, beyond)
}

/// Returns the corners of parts that enclose the triangles, about one for each cell.
pub(super) fn enclosing(triangles: &[[Vector; 3]], cells: &[Part]) -> Vec<Vec<Vector>> {
    let size = triangles.iter().flatten().map(|p| p.length()).fold(0.0, f64::max);
    let middles: Vec<Vector> = cells.iter().map(Part::middle).collect();
    let nearest = |piece: &[Vector]| {
        let away = |k: usize| (middles[k] - middle(piece)).length();
        let nearest = (0..cells.len()).min_by(|&a, &b| away(a).total_cmp(&away(b)));
        nearest.unwrap_or(0)
    };
    let mut parts: Vec<Vec<Vector>> = vec![Vec::new(); cells.len().max(1)];
    for triangle in triangles {
        let mut left = vec![triangle.to_vec()];
        for (cell, part) in cells.iter().zip(&mut parts) {
            let pieces = std::mem::take(&mut left).into_iter();
            for (within, without) in pieces.map(|piece| cell.cut(piece, ROUNDING * size)) {
                part.extend(within);
                left.extend(without);
            }
        }
        for piece in left {
            parts[nearest(&piece)].extend(piece);
        }
    }
    let filled = parts.into_iter().filter(|part| !part.is_empty());
    filled.map(|part| solid(distinct(part.into_iter()))).collect()
}

/// Returns the corners of a body that holds some points and whose hull can be computed: their own hull, or, where the collision library fails,
/// that of the points with a thickness, and last the box about them.
fn solid(points: Vec<Vector>) -> Vec<Vector> {
    let hull = |points: Vec<Vector>| {
        Some(Part::around(points).corners).filter(|corners| ConvexHull::from_points(corners).is_ok())
    };
    let found = hull(thick(points.clone())).or_else(|| hull(thickened(&points)));
    found.unwrap_or_else(|| box_about(&points))
}

/// Returns the corners of a box that holds some points, with a margin on all sides.
fn box_about(points: &[Vector]) -> Vec<Vector> {
    let [least, most] = bounds(points);
    let sides = [least - Vector::splat(SHEET_M), most + Vector::splat(SHEET_M)];
    let corner = |k: usize| Vector::new(sides[k & 1].x, sides[k >> 1 & 1].y, sides[k >> 2].z);
    (0..8).map(corner).collect()
}

/// Proposes parts of a mesh that are nearly convex.
///
/// # Errors
/// [`SolidError::NotDecomposed`] where the collision library fails.
pub(super) fn cells(triangles: &[[Vector; 3]], cuts: &Cuts) -> Result<Vec<Part>, SolidError> {
    let corners: Vec<Vector> = triangles.iter().flatten().copied().collect();
    let indices: Vec<[u32; 3]> = (0..triangles.len() as u32)
        .map(|k| [3 * k, 3 * k + 1, 3 * k + 2])
        .collect();
    let wanted = VHACDParameters {
        concavity: cuts.hollow,
        resolution: cuts.cells,
        max_convex_hulls: cuts.most_parts,
        ..VHACDParameters::default()
    };
    let hulls = guarded(|| VHACD::decompose(&wanted, &corners, &indices, false).compute_convex_hulls(1));
    let hulls = hulls.ok_or(SolidError::NotDecomposed)?.into_iter();
    Ok(hulls.map(|(points, _)| Part::around(points)).collect())
}

/// Returns the points of a part with a volume unchanged; gives a part in a plane a thickness.
fn thick(points: Vec<Vector>) -> Vec<Vector> {
    if has_volume(&points) {
        return points;
    }
    thickened(&points)
}

/// Returns points on all sides of some points.
fn thickened(points: &[Vector]) -> Vec<Vector> {
    let steps = [Vector::X, Vector::Y, Vector::Z].map(|axis| axis * SHEET_M);
    let about = |p: &Vector| {
        let p = *p;
        steps.into_iter().flat_map(move |step| [p + step, p - step])
    };
    points.iter().flat_map(about).collect()
}

pub(super) fn distinct(points: impl Iterator<Item = Vector>) -> Vec<Vector> {
    let mut seen = std::collections::BTreeSet::new();
    // Adding zero turns −0 into 0.
    points
        .map(|p| p + Vector::ZERO)
        .filter(|p| seen.insert(bits(*p)))
        .collect()
}
