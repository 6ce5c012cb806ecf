//! Convex parts of a mesh: one hull, or several that together enclose its surface.
//!
//! The cuts of the mesh are a proposal (VHACD, Mamou & Ghorbel 2009, by the collision library): cells that may overlap. The piece of each
//! triangle within a cell goes to the part of that cell, which is the hull of all its pieces. Then each triangle is cut by the planes of
//! each part, and the rest that is in none of them is added to the nearest. So the parts enclose the surface for any proposal. A part
//! without thickness, as of a mesh that is a sheet, gets one. A few parts are enclosed alike, in cells that are joined before (`few.rs`).

mod few;
#[cfg(test)]
mod tests;

use crate::clearance::convex::{ConvexHull, MOST_CORNERS, MOST_VERTICES, has_volume};
use nalgebra::Point3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

/// Greatest number of triangles of a mesh that is decomposed.
const MOST_TRIANGLES: usize = 20_000;

/// Settings of the proposal of cuts.
struct Cuts {
    /// Greatest number of parts; some more may be proposed.
    most_parts: u32,
    /// Number of cells along the longest edge of the mesh.
    cells: u32,
    /// Greatest depth of a hollow in a part, as a share of the mesh's hull.
    hollow: f64,
}

/// Cuts of a body that stands still.
const CUTS: Cuts = Cuts {
    most_parts: 64,
    cells: 64,
    hollow: 0.004,
};

/// Half of the thickness added to a part without one \[m\].
const SHEET_M: f64 = 5e-5;

/// Distance beyond a plane at which a piece of a surface counts as behind it, as a part of the mesh's size.
const ROUNDING: f64 = 1e-12;

/// Interpretation of a mesh as a solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolidParts {
    /// The convex hull of the mesh.
    Hull,
    /// Convex parts that together enclose its surface.
    Decomposed,
    /// A few convex parts that together enclose its surface, for a body that moves.
    Few,
}

/// Reason that a mesh is not a valid body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolidError {
    /// The mesh has no triangles.
    #[error("it has no triangles")]
    Empty,
    /// A coordinate is not a number.
    #[error("a corner of triangle {triangle} is not a number")]
    NotFinite {
        /// Index of the triangle, from 0.
        triangle: usize,
    },
    /// The mesh lies in a plane.
    #[error("it is flat; a body needs a volume")]
    Flat,
    /// The mesh has too many corners.
    #[error("it has {found} distinct corners; at most {most} can be judged: simplify the mesh")]
    TooManyCorners {
        /// Number of corners.
        found: usize,
        /// Greatest number.
        most: usize,
    },
    /// The mesh has too many triangles.
    #[error("it has {found} triangles; at most {MOST_TRIANGLES} can be decomposed (its hull may have more)")]
    TooMany {
        /// Number of triangles.
        found: usize,
    },
}

/// Returns the corners of the convex parts of a mesh's triangles \[m\]. Every point of a triangle is in one of their hulls, up to rounding.
/// A mesh need not be closed: its surface counts, and its inside as far as the parts enclose it.
///
/// # Errors
/// [`SolidError`].
pub fn solid_parts(triangles: &[[Point3<f64>; 3]], parts: SolidParts) -> Result<Vec<Vec<Point3<f64>>>, SolidError> {
    if triangles.is_empty() {
        return Err(SolidError::Empty);
    }
    let finite = |triangle: &[Point3<f64>; 3]| triangle.iter().all(|corner| corner.iter().all(|c| c.is_finite()));
    if let Some(triangle) = triangles.iter().position(|triangle| !finite(triangle)) {
        return Err(SolidError::NotFinite { triangle });
    }
    let corners: Vec<[Vector; 3]> = triangles
        .iter()
        .map(|triangle| triangle.map(|p| Vector::new(p.x, p.y, p.z)))
        .collect();
    let points = distinct(corners.iter().flatten().copied());
    let most = match parts {
        SolidParts::Hull | SolidParts::Decomposed => MOST_CORNERS,
        SolidParts::Few => MOST_VERTICES,
    };
    if points.len() > most {
        let found = points.len();
        return Err(SolidError::TooManyCorners { found, most });
    }
    if !has_volume(&points) {
        return Err(SolidError::Flat);
    }
    let found = match parts {
        SolidParts::Hull => vec![Part::around(points).corners],
        SolidParts::Decomposed => {
            let found = triangles.len();
            if found > MOST_TRIANGLES {
                return Err(SolidError::TooMany { found });
            }
            decomposed(&corners, &points, &cells(&corners, &CUTS))
        }
        SolidParts::Few => few::parts(&corners, points),
    };
    let point = |v: Vector| Point3::new(v.x, v.y, v.z);
    Ok(found
        .into_iter()
        .map(|part| part.into_iter().map(point).collect())
        .collect())
}

/// Convex part: its corners, and the planes that it is behind.
struct Part {
    corners: Vec<Vector>,
    /// Outward unit normals and their distances from the origin; empty for an unreliable hull.
    planes: Vec<(Vector, f64)>,
}

impl Part {
    fn around(points: Vec<Vector>) -> Self {
        match ConvexHull::of(&points) {
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

    /// Cuts a polygon into the piece within the part and the pieces outside.
    fn cut(&self, polygon: &[Vector], rounding: f64) -> (Vec<Vector>, Vec<Vec<Vector>>) {
        let (mut within, mut without) = (polygon.to_vec(), Vec::new());
        if self.planes.is_empty() {
            return (Vec::new(), vec![within]);
        }
        for (normal, at) in &self.planes {
            let height = |p: &Vector| normal.dot(*p) - at;
            if within.iter().all(|p| height(p) <= rounding) {
                continue;
            }
            let (behind, beyond) = split(&within, height);
            without.push(beyond);
            within = behind;
            if within.is_empty() {
                break;
            }
        }
        (within, without)
    }

    fn middle(&self) -> Vector {
        self.corners.iter().fold(Vector::ZERO, |sum, p| sum + *p) / self.corners.len().max(1) as f64
    }
}

/// Splits a convex polygon into the pieces behind a plane and beyond it, both with the points in the plane.
fn split(polygon: &[Vector], height: impl Fn(&Vector) -> f64) -> (Vec<Vector>, Vec<Vector>) {
    let (mut behind, mut beyond) = (Vec::new(), Vec::new());
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (here, there) = (height(p), height(q));
        if here <= 0.0 {
            behind.push(*p);
        }
        if here >= 0.0 {
            beyond.push(*p);
        }
        if (here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0) {
            let between = *p + (*q - *p) * (here / (here - there));
            behind.push(between);
            beyond.push(between);
        }
    }
    (behind, beyond)
}

fn decomposed(triangles: &[[Vector; 3]], points: &[Vector], cells: &[Part]) -> Vec<Vec<Vector>> {
    let size = points.iter().map(|p| p.length()).fold(0.0, f64::max);
    let rounding = ROUNDING * size;
    let mut found: Vec<Vec<Vector>> = cells
        .iter()
        .map(|cell| {
            let within = triangles.iter().flat_map(|triangle| cell.cut(triangle, rounding).0);
            distinct(within)
        })
        .filter(|part| !part.is_empty())
        .collect();
    if found.is_empty() {
        found.push(points.to_vec());
    }
    let mut parts: Vec<Part> = found.into_iter().map(|part| Part::around(thick(part))).collect();
    // A rest in none of the parts is added, and everything else stays enclosed: parts only grow.
    let mut missing: Vec<Vec<Vector>> = vec![Vec::new(); parts.len()];
    for triangle in triangles {
        for piece in uncovered(triangle, &parts, rounding) {
            let middle = piece.iter().fold(Vector::ZERO, |sum, p| sum + *p) / piece.len() as f64;
            let nearest = (0..parts.len()).min_by(|&a, &b| {
                let far = |k: usize| (parts[k].middle() - middle).length();
                far(a).total_cmp(&far(b))
            });
            missing[nearest.unwrap_or(0)].extend(piece);
        }
    }
    parts
        .drain(..)
        .zip(missing)
        .map(|(part, more)| {
            if more.is_empty() {
                return part.corners;
            }
            Part::around(distinct(part.corners.into_iter().chain(more))).corners
        })
        .collect()
}

/// Returns the pieces of a triangle that are in none of the parts.
fn uncovered(triangle: &[Vector; 3], parts: &[Part], rounding: f64) -> Vec<Vec<Vector>> {
    let mut left = vec![triangle.to_vec()];
    for part in parts {
        left = left.iter().flat_map(|piece| part.cut(piece, rounding).1).collect();
        if left.is_empty() {
            break;
        }
    }
    left
}

/// Proposes parts of a mesh that are nearly convex.
fn cells(triangles: &[[Vector; 3]], cuts: &Cuts) -> Vec<Part> {
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
    let found = VHACD::decompose(&wanted, &corners, &indices, false);
    let hulls = found.compute_convex_hulls(1).into_iter();
    hulls.map(|(points, _)| Part::around(points)).collect()
}

/// Returns the points of a part with a volume unchanged; gives a part in a plane a thickness.
fn thick(points: Vec<Vector>) -> Vec<Vector> {
    if has_volume(&points) {
        return points;
    }
    let steps = [Vector::X, Vector::Y, Vector::Z].map(|axis| axis * SHEET_M);
    let about = |p: &Vector| {
        let p = *p;
        steps.into_iter().flat_map(move |step| [p + step, p - step])
    };
    points.iter().flat_map(about).collect()
}

fn distinct(points: impl Iterator<Item = Vector>) -> Vec<Vector> {
    let mut seen = std::collections::BTreeSet::new();
    // Adding zero turns −0 into 0.
    points
        .map(|p| p + Vector::ZERO)
        .filter(|p| seen.insert([p.x, p.y, p.z].map(f64::to_bits)))
        .collect()
}
