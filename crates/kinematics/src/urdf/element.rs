//! Geometry elements: boxes, cylinders, capsules and spheres, all of some size, and meshes, which are files.

use super::error::UrdfError;
use super::numbers::length;
use crate::geometry::Shape;
use urdf_rs::Geometry;

/// What a geometry element states.
pub(super) enum Stated<'a> {
    /// A solid.
    Solid(Shape),
    /// A mesh: its file and its scale.
    Mesh(&'a str, [f64; 3]),
}

/// Reads the geometry element of a link.
///
/// # Errors
/// [`UrdfError`] for a solid without size.
pub(super) fn stated<'a>(geometry: &'a Geometry, link: &str) -> Result<Stated<'a>, UrdfError> {
    let shape = match geometry {
        Geometry::Box { size } => {
            positive(link, "box", &size.0)?;
            let half_m = size.0.map(|edge| edge / 2.0);
            Shape::Box { half_m }
        }
        Geometry::Cylinder { radius, length } => {
            positive(link, "cylinder", &[*radius, *length])?;
            let half_length_m = length / 2.0;
            Shape::Cylinder {
                radius_m: *radius,
                half_length_m,
            }
        }
        Geometry::Capsule { radius, length } => {
            positive(link, "capsule", &[*radius, *length])?;
            let half_length_m = length / 2.0;
            Shape::Capsule {
                radius_m: *radius,
                half_length_m,
            }
        }
        Geometry::Sphere { radius } => {
            positive(link, "sphere", &[*radius])?;
            Shape::Sphere { radius_m: *radius }
        }
        Geometry::Mesh { filename, scale } => return Ok(Stated::Mesh(filename, scale.map_or([1.0; 3], |s| s.0))),
    };
    Ok(Stated::Solid(shape))
}

fn positive(link: &str, shape: &'static str, sizes: &[f64]) -> Result<(), UrdfError> {
    length(&format!("link '{link}'"), shape, sizes)?;
    if sizes.iter().all(|s| *s > 0.0) {
        return Ok(());
    }
    Err(UrdfError::ShapeSize {
        link: link.to_owned(),
        shape,
        found: format!("{sizes:?}"),
    })
}
