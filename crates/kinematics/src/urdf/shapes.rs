//! Geometry elements: boxes, cylinders, capsules and spheres of positive size, and meshes, which are files.
//!
//! URDF has no capsule; tools write one as a cylinder followed by the two spheres that close its ends.
//!
//! Collision elements of a link are read as shapes.
//!
//! Visuals of links have no effect on results. A visual that cannot be read is left out, by name, and the arm loads all the same.

use crate::geometry::{Primitive, Shape, Visual, VisualFinding, VisualShape};
use crate::model::Link;
use crate::urdf::error::UrdfError;
use crate::urdf::mesh::MeshSource;
use crate::urdf::tree::{length, pose};
use nalgebra::Point3;
use std::collections::BTreeMap;
use urdf_rs::Geometry;

/// Contents of a geometry element.
pub(crate) enum GeometryElement<'a> {
    /// Solid.
    Solid(Shape),
    /// Mesh: its file and its scale.
    Mesh(&'a str, [f64; 3]),
}

/// Reads the geometry element of a link.
///
/// # Errors
/// [`UrdfError`] for a solid without size.
pub(crate) fn stated<'a>(geometry: &'a Geometry, link: &str) -> Result<GeometryElement<'a>, UrdfError> {
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
        Geometry::Mesh { filename, scale } => {
            return Ok(GeometryElement::Mesh(filename, scale.map_or([1.0; 3], |s| s.0)));
        }
    };
    Ok(GeometryElement::Solid(shape))
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

/// Greatest deviation of a sphere's centre or radius from the cylinder's end \[m\].
const TOLERANCE_M: f64 = 1e-9;

/// Replaces each run of cylinder, sphere, sphere that forms a capsule by that capsule.
pub(crate) fn merge(primitives: Vec<Primitive>) -> Vec<Primitive> {
    let mut merged = Vec::with_capacity(primitives.len());
    let mut rest = primitives.as_slice();
    while let Some(first) = rest.first() {
        match rest.get(1..3).and_then(|ends| capsule(first, ends)) {
            Some(capsule) => {
                merged.push(capsule);
                rest = &rest[3..];
            }
            None => {
                merged.push(first.clone());
                rest = &rest[1..];
            }
        }
    }
    merged
}

fn capsule(cylinder: &Primitive, ends: &[Primitive]) -> Option<Primitive> {
    let Shape::Cylinder {
        radius_m,
        half_length_m,
    } = cylinder.shape
    else {
        return None;
    };
    let closes = |sphere: &Primitive, z: f64| {
        let end = cylinder.pose * Point3::new(0.0, 0.0, z);
        matches!(sphere.shape, Shape::Sphere { radius_m: r } if (r - radius_m).abs() <= TOLERANCE_M)
            && (sphere.pose.translation.vector - end.coords).norm() <= TOLERANCE_M
    };
    let [a, b] = ends else { return None };
    let both = |low: &Primitive, high: &Primitive| closes(low, -half_length_m) && closes(high, half_length_m);
    (both(a, b) || both(b, a)).then_some(Primitive {
        pose: cylinder.pose,
        shape: Shape::Capsule {
            radius_m,
            half_length_m,
        },
    })
}

/// True if the visuals of a link stand for the collision shapes that it does not have.
pub(crate) fn takes_visuals(link: &urdf_rs::Link, meshes: &MeshSource) -> bool {
    meshes.takes_visual_shapes() && link.collision.is_empty() && !link.visual.is_empty()
}

/// Returns all collision shapes of a link, in its frame.
pub(crate) fn primitives(link: &urdf_rs::Link, meshes: &MeshSource) -> Result<Vec<Primitive>, UrdfError> {
    let at = format!("link '{}'", link.name);
    let elements: Vec<_> = if takes_visuals(link, meshes) {
        link.visual.iter().map(|v| (&v.origin, &v.geometry)).collect()
    } else {
        link.collision.iter().map(|c| (&c.origin, &c.geometry)).collect()
    };
    let mut all = Vec::with_capacity(elements.len());
    for (origin, geometry) in elements {
        let pose = pose(origin, &at)?;
        let shapes = match stated(geometry, &link.name)? {
            GeometryElement::Solid(shape) => vec![shape],
            GeometryElement::Mesh(file, scale) => meshes.shapes(&link.name, file, scale)?,
        };
        all.extend(shapes.into_iter().map(|shape| Primitive { pose, shape }));
    }
    Ok(merge(all))
}

/// Refuses a link to split that is none, or has no mesh.
pub(crate) fn check_split_links(links: &[Link], meshes: &MeshSource) -> Result<(), UrdfError> {
    let is_hull = |primitive: &Primitive| matches!(primitive.shape, Shape::Hull { .. });
    for name in meshes.split_links() {
        let why = match links.iter().find(|link| link.name == *name) {
            Some(link) if link.collision.iter().any(is_hull) => continue,
            Some(_) => "none of its collision shapes is a mesh".to_owned(),
            None => {
                let with_meshes = links.iter().filter(|link| link.collision.iter().any(is_hull));
                let names: Vec<_> = with_meshes.map(|link| link.name.as_str()).collect();
                let there = if names.is_empty() { "none" } else { &names.join(", ") };
                format!("the description has no such link; links with meshes: {there}")
            }
        };
        let link = name.clone();
        return Err(UrdfError::Split { link, why });
    }
    Ok(())
}

/// Greatest number of visuals that are read, all links together.
pub const MAX_VISUALS: usize = 1000;

/// Greatest number of triangles of visual meshes that are read, all links together.
pub const MAX_TRIANGLES: usize = 100_000;

/// Reason that a visual is left out.
#[derive(Debug, thiserror::Error)]
enum VisualError {
    /// The element is invalid, or its mesh cannot be read.
    #[error(transparent)]
    Stated(#[from] UrdfError),
    /// There are too many visuals.
    #[error("it comes after {MAX_VISUALS} others, the most that are read")]
    TooMany,
}

/// State for reading the visuals of a description one link after the other.
pub(crate) struct VisualReader<'a> {
    meshes: &'a MeshSource,
    colours: BTreeMap<&'a str, [f64; 4]>,
    visuals_left: usize,
    triangles_left: usize,
    /// Visuals left out so far.
    pub findings: Vec<VisualFinding>,
}

impl<'a> VisualReader<'a> {
    pub fn new(robot: &'a urdf_rs::Robot, meshes: &'a MeshSource) -> Self {
        Self {
            meshes,
            colours: colours(robot),
            visuals_left: MAX_VISUALS,
            triangles_left: MAX_TRIANGLES,
            findings: Vec::new(),
        }
    }

    /// Returns the visuals of a link, without those that cannot be read.
    pub fn visuals(&mut self, link: &urdf_rs::Link) -> Vec<Visual> {
        let mut visuals = Vec::new();
        for (index, element) in link.visual.iter().enumerate() {
            match self.read(link, element) {
                Ok(visual) => visuals.push(visual),
                Err(why) => self.findings.push(finding(link, index, &why)),
            }
        }
        visuals
    }

    fn read(&mut self, link: &urdf_rs::Link, element: &urdf_rs::Visual) -> Result<Visual, VisualError> {
        self.visuals_left = self.visuals_left.checked_sub(1).ok_or(VisualError::TooMany)?;
        Ok(Visual {
            name: element.name.clone(),
            pose: pose(&element.origin, &format!("link '{}'", link.name))?,
            shape: self.shape(link, &element.geometry)?,
            rgba: element.material.as_ref().and_then(|material| self.colour(material)),
        })
    }

    fn shape(&mut self, link: &urdf_rs::Link, geometry: &urdf_rs::Geometry) -> Result<VisualShape, UrdfError> {
        Ok(match stated(geometry, &link.name)? {
            GeometryElement::Solid(shape) => VisualShape::Solid(shape),
            GeometryElement::Mesh(file, scale) => {
                let triangles = self.meshes.triangles(&link.name, file, scale, self.triangles_left)?;
                self.triangles_left -= triangles.len();
                VisualShape::Mesh(triangles.into())
            }
        })
    }

    /// Returns the colour of a material: its own, or that of its name.
    fn colour(&self, material: &urdf_rs::Material) -> Option<[f64; 4]> {
        rgba(material).or_else(|| self.colours.get(material.name.as_str()).copied())
    }
}

/// Returns the note that the visual of an index is left out.
fn finding(link: &urdf_rs::Link, index: usize, why: &VisualError) -> VisualFinding {
    let named = link.visual.get(index).and_then(|visual| visual.name.as_ref());
    let why = why.to_string();
    VisualFinding {
        link: link.name.clone(),
        visual: named.map_or_else(|| format!("visual {}", index + 1), |name| format!("visual '{name}'")),
        // The link is named already.
        why: why
            .strip_prefix(&format!("link '{}': ", link.name))
            .unwrap_or(&why)
            .to_owned(),
    }
}

/// Returns the colours by name: those stated for the whole description, then those stated in a link, the first of each name.
fn colours(robot: &urdf_rs::Robot) -> BTreeMap<&str, [f64; 4]> {
    let in_links = robot.links.iter().flat_map(|link| &link.visual);
    let in_links = in_links.filter_map(|visual| visual.material.as_ref());
    let mut all = BTreeMap::new();
    for material in robot.materials.iter().chain(in_links) {
        if let (false, Some(rgba)) = (material.name.is_empty(), rgba(material)) {
            all.entry(material.name.as_str()).or_insert(rgba);
        }
    }
    all
}

/// Returns the colour stated in a material, each share between 0 and 1; `None` if one is not a number.
fn rgba(material: &urdf_rs::Material) -> Option<[f64; 4]> {
    let shares = material.color.as_ref()?.rgba.0;
    let finite = shares.iter().all(|share| share.is_finite());
    finite.then(|| shares.map(|share| share.clamp(0.0, 1.0)))
}
