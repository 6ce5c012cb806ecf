//! Triangles of Collada files (`.dae`), placed by the nodes of their scene, in metres.
//!
//! `<unit>` counts, as in RViz and Gazebo. `<up_axis>` does not: RViz, MoveIt and Gazebo take the axes of a robot's mesh as those of its
//! link, and descriptions rely on it. Colours, lights, cameras and lines are not read. Parts that no scene shows are none of the file's;
//! everything that could leave a shown part out, or put it elsewhere, is refused.

mod document;
mod surface;

use crate::trig::sin_cos;
use crate::urdf::collada::document::Element;
use crate::urdf::collada::surface::{mesh, too_many};
use nalgebra::{Matrix3, Matrix4, Point3, Vector3};
use std::collections::BTreeMap;

/// Deepest nesting of nodes, those that stand for others included: a node in itself is deeper.
const MAX_DEPTH: usize = 64;

/// Greatest number of elements of nodes that are looked at, each as often as it is shown.
const MAX_STEPS: usize = 100_000;

/// Reads the corners of the triangles, three each, in metres.
///
/// # Errors
/// The reason, for a file that is damaged, uses what is not handled, or shows more than `most` triangles.
pub(crate) fn corners(bytes: &[u8], most: usize) -> Result<Vec<Point3<f64>>, String> {
    let root = root(bytes)?;
    let unit_m = unit_m(&root)?.unwrap_or(1.0);
    let mut scene = Scene {
        most,
        named: BTreeMap::new(),
        meshes: BTreeMap::new(),
        steps: 0,
        shown: Vec::new(),
    };
    root.each(&mut |element| {
        if let Some(id) = element.attribute("id") {
            scene.named.entry((&element.name, id)).or_default().push(element);
        }
    });
    let unit = Matrix4::new_scaling(unit_m);
    let shown = root.child("scene");
    if let Some(shown) = shown.and_then(|scene| scene.child("instance_visual_scene")) {
        scene.node(scene.target(shown, "visual_scene")?, &unit, 0)?;
    } else if root.child("library_visual_scenes").is_some() {
        return Err("its <scene> does not say which visual scene is shown".to_owned());
    } else {
        let mut libraries = root.all("library_geometries");
        libraries.try_for_each(|library| {
            library
                .all("geometry")
                .try_for_each(|geometry| scene.show(geometry, &unit))
        })?;
    }
    Ok(scene.shown)
}

/// Returns the unit that a file states \[m\].
///
/// # Errors
/// The reason, for a file that is damaged, or a unit that is no length.
pub(crate) fn stated_unit_m(bytes: &[u8]) -> Result<Option<f64>, String> {
    unit_m(&root(bytes)?)
}

fn root(bytes: &[u8]) -> Result<Element, String> {
    let text = String::from_utf8_lossy(bytes);
    let root = Element::parse(text.trim_start_matches('\u{feff}'))?;
    match root.name.as_str() {
        "COLLADA" => Ok(root),
        other => Err(format!("it begins with <{other}>, not <COLLADA>")),
    }
}

fn unit_m(root: &Element) -> Result<Option<f64>, String> {
    let unit = root.child("asset").and_then(|asset| asset.child("unit"));
    let Some(stated) = unit.and_then(|unit| unit.attribute("meter")) else {
        return Ok(None);
    };
    let unit_m = stated.trim().parse::<f64>().unwrap_or(f64::NAN);
    match unit_m > 0.0 && unit_m.is_finite() {
        true => Ok(Some(unit_m)),
        false => Err(format!("its unit of '{stated}' m is no length")),
    }
}

/// Elements of a file by kind and name, and what its scene shows.
struct Scene<'a> {
    most: usize,
    named: BTreeMap<(&'a str, &'a str), Vec<&'a Element>>,
    /// Corners of the meshes that were read, by the place of their element.
    meshes: BTreeMap<*const Element, Vec<Point3<f64>>>,
    steps: usize,
    shown: Vec<Point3<f64>>,
}

impl<'a> Scene<'a> {
    /// Returns the element that an instance stands for.
    fn target(&self, instance: &Element, kind: &str) -> Result<&'a Element, String> {
        let url = instance.required("url")?;
        let found = url.strip_prefix('#').and_then(|id| self.named.get(&(kind, id)));
        match found.map(Vec::as_slice) {
            Some([one]) => Ok(one),
            Some(_) => Err(format!("more than one <{kind}> is called '{url}'")),
            None => Err(format!("<{}>: '{url}' is no <{kind}> of this file", instance.name)),
        }
    }

    /// Shows a node or a whole scene, with the nodes in it.
    fn node(&mut self, node: &'a Element, parent: &Matrix4<f64>, depth: usize) -> Result<(), String> {
        if depth > MAX_DEPTH {
            return Err(format!(
                "its nodes are more than {MAX_DEPTH} deep, or one stands in itself"
            ));
        }
        let mut pose = *parent;
        for element in &node.children {
            self.steps += 1;
            if self.steps > MAX_STEPS {
                return Err(format!("its scene has more than {MAX_STEPS} elements"));
            }
            match element.name.as_str() {
                "matrix" | "translate" | "rotate" | "scale" => pose *= transform(element)?,
                "node" => self.node(element, &pose, depth + 1)?,
                "instance_node" => self.node(self.target(element, "node")?, &pose, depth + 1)?,
                "instance_geometry" => self.show(self.target(element, "geometry")?, &pose)?,
                "instance_controller" | "lookat" | "skew" => {
                    return Err(format!("<{}> in a node is not handled", element.name));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// Shows a geometry at a pose. A mirrored one keeps its outside.
    fn show(&mut self, geometry: &'a Element, pose: &Matrix4<f64>) -> Result<(), String> {
        let key = std::ptr::from_ref(geometry);
        if !self.meshes.contains_key(&key) {
            let mesh = mesh(geometry, self.most);
            let name = geometry.attribute("id").unwrap_or_default();
            let mesh = mesh.map_err(|detail| format!("geometry '{name}': {detail}"))?;
            self.meshes.insert(key, mesh);
        }
        let mesh = &self.meshes[&key];
        if (self.shown.len() + mesh.len()) / 3 > self.most {
            return Err(too_many(self.most));
        }
        let turned = pose.fixed_view::<3, 3>(0, 0).determinant();
        if !(turned.is_finite() && turned != 0.0) {
            return Err("the transforms of a node make its part flat".to_owned());
        }
        let order = if turned < 0.0 { [0, 2, 1] } else { [0, 1, 2] };
        let placed = mesh
            .chunks_exact(3)
            .flat_map(|t| order.map(|k| pose.transform_point(&t[k])));
        self.shown.extend(placed);
        Ok(())
    }
}

/// Reads the transform of a node.
fn transform(element: &Element) -> Result<Matrix4<f64>, String> {
    let values = element.numbers::<f64>()?;
    match (element.name.as_str(), values.as_slice()) {
        ("translate", &[x, y, z]) => Ok(Matrix4::new_translation(&Vector3::new(x, y, z))),
        ("scale", &[x, y, z]) => Ok(Matrix4::new_nonuniform_scaling(&Vector3::new(x, y, z))),
        ("rotate", &[x, y, z, degrees]) => {
            let axis = Vector3::new(x, y, z).try_normalize(0.0);
            let axis = axis.ok_or("a <rotate> has no axis")?;
            let (sin, cos) = sin_cos(degrees.to_radians());
            // Rodrigues' formula.
            let turn = Matrix3::identity() * cos + axis.cross_matrix() * sin + axis * axis.transpose() * (1.0 - cos);
            Ok(turn.to_homogeneous())
        }
        ("matrix", [.., 0.0, 0.0, 0.0, 1.0]) if values.len() == 16 => Ok(Matrix4::from_row_slice(&values)),
        (name, _) => Err(format!("the numbers of a <{name}> are no transform")),
    }
}
