//! What links look like. It decides nothing, so that a visual which cannot be read is left out, by name, and the arm loads all the same.

use super::element::{Stated, stated};
use super::error::UrdfError;
use super::mesh::MeshSource;
use super::numbers::pose;
use crate::geometry::{Visual, VisualFinding, VisualShape};
use std::collections::BTreeMap;

/// Most visuals that are read, all links together.
pub const MAX_VISUALS: usize = 1000;

/// Most triangles of visual meshes that are read, all links together.
pub const MAX_TRIANGLES: usize = 100_000;

/// Why a visual is left out.
#[derive(Debug, thiserror::Error)]
enum VisualError {
    /// It is stated wrongly, or its mesh cannot be read.
    #[error(transparent)]
    Stated(#[from] UrdfError),
    /// There are more than anybody can look at.
    #[error("it comes after {MAX_VISUALS} others, the most that are read")]
    TooMany,
}

/// What is needed to read the visuals of a description one link after the other.
pub(super) struct Looks<'a> {
    meshes: &'a MeshSource,
    colours: BTreeMap<&'a str, [f64; 4]>,
    visuals_left: usize,
    triangles_left: usize,
    /// What was left out so far.
    pub findings: Vec<VisualFinding>,
}

impl<'a> Looks<'a> {
    pub fn new(robot: &'a urdf_rs::Robot, meshes: &'a MeshSource) -> Self {
        Self {
            meshes,
            colours: colours(robot),
            visuals_left: MAX_VISUALS,
            triangles_left: MAX_TRIANGLES,
            findings: Vec::new(),
        }
    }

    /// The visuals of a link, but for those that cannot be read.
    pub fn of(&mut self, link: &urdf_rs::Link) -> Vec<Visual> {
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
            Stated::Solid(shape) => VisualShape::Solid(shape),
            Stated::Mesh(file, scale) => {
                let triangles = self.meshes.triangles(&link.name, file, scale, self.triangles_left)?;
                self.triangles_left -= triangles.len();
                VisualShape::Mesh(triangles.into())
            }
        })
    }

    /// The colour of a material: its own, or that of its name.
    fn colour(&self, material: &urdf_rs::Material) -> Option<[f64; 4]> {
        rgba(material).or_else(|| self.colours.get(material.name.as_str()).copied())
    }
}

/// The note that the visual of an index is left out.
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

/// Colours by name: those stated for the whole description, then those stated in a link, the first of each name.
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

/// The colour that a material states itself, each share between 0 and 1; none where one is no number.
fn rgba(material: &urdf_rs::Material) -> Option<[f64; 4]> {
    let shares = material.color.as_ref()?.rgba.0;
    let finite = shares.iter().all(|share| share.is_finite());
    finite.then(|| shares.map(|share| share.clamp(0.0, 1.0)))
}
