//! Convex parts of a mesh: one hull, or several that together enclose its surface.
//!
//! The cuts of the mesh are a proposal (VHACD, Mamou & Ghorbel 2009, by the collision library): cells that may overlap, or leave something
//! out. Each triangle is cut by their planes, cell by cell. A piece that is in a cell belongs to the part of that cell, and a piece that is
//! in none to the nearest; all corners of a piece belong to the same part. A part is the hull of its pieces, so that it holds them, and the
//! pieces make up the triangle: the parts enclose the surface, for any proposal. A part without thickness, as of a mesh that is a sheet,
//! gets one (`cells.rs`). Closed convex bodies of which a mesh is made are cells of their own (`separate.rs`). A few parts are enclosed alike, in cells that
//! are joined before (`few.rs`).

mod cells;
mod error;
mod few;
mod separate;
#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests;

pub(crate) use crate::clearance::solid::cells::SHEET_M;
pub use crate::clearance::solid::error::SolidError;

use crate::clearance::convex::{MOST_CORNERS, MOST_VERTICES, has_volume};
use crate::clearance::solid::cells::{Cuts, Part, cells, distinct, enclosing};
use crate::clearance::solid::error::MOST_TRIANGLES;
use nalgebra::Point3;
use parry3d_f64::math::Vector;

/// Cuts of a body that stands still.
const CUTS: Cuts = Cuts {
    most_parts: 64,
    cells: 64,
    hollow: 0.004,
};

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
