//! Collision elements of a link as shapes.

use super::capsule;
use super::error::UrdfError;
use super::mesh::MeshSource;
use super::numbers::{length, pose};
use crate::geometry::{Primitive, Shape};
use urdf_rs::Geometry;

/// All collision shapes of a link, in its frame.
pub(super) fn primitives(link: &urdf_rs::Link, meshes: &MeshSource) -> Result<Vec<Primitive>, UrdfError> {
    let at = format!("link '{}'", link.name);
    let convert = |element: &urdf_rs::Collision| {
        Ok(Primitive {
            pose: pose(&element.origin, &at)?,
            shape: shape(&element.geometry, &link.name, meshes)?,
        })
    };
    let all = link
        .collision
        .iter()
        .map(convert)
        .collect::<Result<Vec<_>, UrdfError>>()?;
    Ok(capsule::merge(all))
}

fn shape(geometry: &Geometry, link: &str, meshes: &MeshSource) -> Result<Shape, UrdfError> {
    match geometry {
        Geometry::Box { size } => {
            positive(link, "box", &size.0)?;
            let half_m = size.0.map(|edge| edge / 2.0);
            Ok(Shape::Box { half_m })
        }
        Geometry::Cylinder { radius, length } => {
            positive(link, "cylinder", &[*radius, *length])?;
            let half_length_m = length / 2.0;
            Ok(Shape::Cylinder {
                radius_m: *radius,
                half_length_m,
            })
        }
        Geometry::Capsule { radius, length } => {
            positive(link, "capsule", &[*radius, *length])?;
            let half_length_m = length / 2.0;
            Ok(Shape::Capsule {
                radius_m: *radius,
                half_length_m,
            })
        }
        Geometry::Sphere { radius } => {
            positive(link, "sphere", &[*radius])?;
            Ok(Shape::Sphere { radius_m: *radius })
        }
        Geometry::Mesh { filename, scale } => {
            let scale = scale.map_or([1.0; 3], |s| s.0);
            Ok(Shape::Hull {
                points: meshes.load(link, filename, scale)?,
            })
        }
    }
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
