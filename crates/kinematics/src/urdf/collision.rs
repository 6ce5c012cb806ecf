//! Collision elements of a link as shapes.

use super::capsule;
use super::element::{Stated, stated};
use super::error::UrdfError;
use super::mesh::MeshSource;
use super::numbers::pose;
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
    match stated(geometry, link)? {
        Stated::Solid(shape) => Ok(shape),
        Stated::Mesh(file, scale) => Ok(Shape::Hull {
            points: meshes.vertices(link, file, scale)?,
        }),
    }
}
