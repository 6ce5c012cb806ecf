//! Convex parts of a mesh: one hull, or several that together enclose its surface.
//!
//! The cuts of the mesh are a proposal (VHACD, Mamou & Ghorbel 2009, by the collision library): cells that may overlap, or leave something
//! out. Each triangle is cut by their planes, cell by cell. A piece that is in a cell belongs to the part of that cell, and a piece that is
//! in none to the nearest; all corners of a piece belong to the same part. A part is the hull of its pieces, so that it holds them, and the
//! pieces make up the triangle: the parts enclose the surface, for any proposal. A part without thickness, as of a mesh that is a sheet,
//! gets one. Closed convex bodies of which a mesh is made are cells of their own (`separate.rs`). A few parts are enclosed alike, in cells that
//! are joined before (`few.rs`).

mod few;
mod separate;
#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;

use crate::clearance::convex::{ConvexHull, MOST_CORNERS, MOST_VERTICES, bits, bounds, guarded, has_volume, middle};
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
pub(crate) const SHEET_M: f64 = 5e-5;

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
    /// The collision library fails to decompose the mesh.
    #[error(
        "it cannot be cut into convex parts: the collision library fails; simplify the mesh, cut it into several, or let its hull stand for it"
    )]
    NotDecomposed,
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
            enclosing(&corners, &proposed(&corners)?)
        }
        SolidParts::Few => few::parts(&corners, points)?,
    };
    let point = |v: Vector| Point3::new(v.x, v.y, v.z);
    Ok(found
        .into_iter()
        .map(|part| part.into_iter().map(point).collect())
        .collect())
}

/// Convex part: its corners, and the planes that it is behind, or nearly so.
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
fn enclosing(triangles: &[[Vector; 3]], cells: &[Part]) -> Vec<Vec<Vector>> {
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
    let hull =
        |points: Vec<Vector>| Some(Part::around(points).corners).filter(|corners| ConvexHull::of(corners).is_ok());
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

/// Proposes cells of a body that stands still: its closed convex bodies, and parts of the rest that are nearly convex.
///
/// # Errors
/// [`SolidError::NotDecomposed`] where the collision library fails.
fn proposed(triangles: &[[Vector; 3]]) -> Result<Vec<Part>, SolidError> {
    let (bodies, rest) = separate::bodies(triangles);
    let around = |body: Vec<[Vector; 3]>| Part::around(distinct(body.into_iter().flatten()));
    let mut all: Vec<Part> = bodies.into_iter().map(around).collect();
    if !rest.is_empty() {
        all.extend(cells(&rest, &CUTS)?);
    }
    Ok(all)
}

/// Proposes parts of a mesh that are nearly convex.
///
/// # Errors
/// [`SolidError::NotDecomposed`] where the collision library fails.
fn cells(triangles: &[[Vector; 3]], cuts: &Cuts) -> Result<Vec<Part>, SolidError> {
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

fn distinct(points: impl Iterator<Item = Vector>) -> Vec<Vector> {
    let mut seen = std::collections::BTreeSet::new();
    // Adding zero turns −0 into 0.
    points
        .map(|p| p + Vector::ZERO)
        .filter(|p| seen.insert(bits(*p)))
        .collect()
}
