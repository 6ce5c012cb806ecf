//! The `[[obstacle]]` sections: what stands around the arm.

use crate::body_shape::{BodyShape, convex};
use crate::error::{Problem, conflict};
use crate::key::Domain::{Number, NumberAbove, Path, Plates, Scale, Text, Triple, TripleAbove, Word};
use crate::key::{Key, key};
use crate::paths;
use platewash_kinematics::geometry::Shape;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The keys of `[[obstacle]]`.
pub(crate) const OBSTACLE_KEYS: &[Key] = &[
    key(
        "obstacle.name",
        "",
        Text,
        "Its name, in messages: no other body has it.",
    ),
    key(
        "obstacle.shape",
        "",
        Word(&["box", "cylinder", "capsule", "sphere", "half_space", "mesh"]),
        "A box with its size_m, a sphere with its radius_m, a cylinder or a capsule along its own z with radius_m and length_m, all below \
         its own z = 0, or a mesh out of a file.",
    ),
    key("obstacle.size_m", "m", TripleAbove(0.0, 100.0), "Edges of a box."),
    key(
        "obstacle.radius_m",
        "m",
        NumberAbove(0.0, 100.0),
        "Radius of a cylinder, a capsule or a sphere.",
    ),
    key(
        "obstacle.length_m",
        "m",
        NumberAbove(0.0, 100.0),
        "Length of a cylinder; of a capsule, that between the centres of its round ends.",
    ),
    key(
        "obstacle.mesh",
        "",
        Path,
        "STL or OBJ file of a mesh, in metres unless mesh_scale says otherwise; relative to the scenario's folder, or `package://` in \
         robot.package_path.",
    ),
    key(
        "obstacle.mesh_scale",
        "",
        Scale(-1e6, 1e6),
        "What the coordinates of a mesh are multiplied by: [0.001, 0.001, 0.001] where they are millimetres. Without it, 1.",
    ),
    key(
        "obstacle.mesh_parts",
        "",
        Word(&["hull", "decomposed"]),
        "What counts of a mesh: its convex hull, or convex parts that together enclose its surface. Without it, the hull.",
    ),
    key(
        "obstacle.at_m",
        "m",
        Triple(-100.0, 100.0),
        "Where its own origin is: the centre of a box, cylinder, capsule or sphere, a point of a half-space's plane, the origin of a mesh.",
    ),
    key(
        "obstacle.rpy_deg",
        "deg",
        Triple(-720.0, 720.0),
        "How it is turned there: roll, pitch and yaw about the fixed axes x, y, z.",
    ),
    key(
        "obstacle.margin_m",
        "m",
        Number(0.0, 1.0),
        "How far arm and tool keep from it, beyond wash.clearance_m: it is grown by that, and distances are those to what has grown.",
    ),
    key(
        "obstacle.holds_plates",
        "",
        Plates,
        "The plates that it holds: these it may touch and reach into, as a rack does. Without it, none.",
    ),
];

/// `[[obstacle]]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ObstacleSection {
    /// Its name.
    pub name: String,
    /// Its shape.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub shape: Option<ObstacleShapeName>,
    /// Edges of a box \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub size_m: Option<[f64; 3]>,
    /// Radius of a cylinder, a capsule or a sphere \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub radius_m: Option<f64>,
    /// Length of a cylinder, and of the straight part of a capsule \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length_m: Option<f64>,
    /// File of a mesh.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "paths::lossy")]
    pub mesh: Option<PathBuf>,
    /// What its coordinates are multiplied by.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_scale: Option<[f64; 3]>,
    /// What counts of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_parts: Option<MeshPartsName>,
    /// Where its origin is \[m\].
    pub at_m: [f64; 3],
    /// How it is turned there: roll, pitch and yaw about fixed axes \[deg\].
    pub rpy_deg: [f64; 3],
    /// How far it is grown \[m\].
    pub margin_m: f64,
    /// The plates that it holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub holds_plates: Option<HeldPlates>,
}

/// Shapes of obstacles by name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ObstacleShapeName {
    /// A box.
    Box,
    /// A cylinder.
    Cylinder,
    /// A capsule.
    Capsule,
    /// A ball.
    Sphere,
    /// All below its own z = 0.
    HalfSpace,
    /// What a file holds.
    Mesh,
}

/// What counts of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MeshPartsName {
    /// Its convex hull.
    #[default]
    Hull,
    /// Convex parts that enclose its surface.
    Decomposed,
}

/// Plates that an obstacle holds.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum HeldPlates {
    /// Every one.
    Every(EveryPlate),
    /// Some, by their index.
    These(Vec<usize>),
}

/// The word for every plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EveryPlate {
    /// `"all"`.
    All,
}

/// What an obstacle is, as far as the file says it.
pub(crate) enum Stated<'a> {
    HalfSpace,
    Convex(Shape),
    Mesh {
        file: &'a PathBuf,
        scale: [f64; 3],
        parts: MeshPartsName,
    },
}

impl ObstacleSection {
    /// Its shape with the sizes that belong to it, no more and no fewer.
    pub(crate) fn stated(&self, at: &str) -> Result<Stated<'_>, Problem> {
        let wrong = |key: &str, detail: &str| conflict(format!("{at}.{key}"), detail);
        let Some(shape) = self.shape else {
            wrong("shape", "is missing; every obstacle has one")?;
            return Ok(Stated::HalfSpace);
        };
        let of_mesh = [
            ("mesh", self.mesh.is_some()),
            ("mesh_scale", self.mesh_scale.is_some()),
            ("mesh_parts", self.mesh_parts.is_some()),
        ];
        if shape != ObstacleShapeName::Mesh
            && let Some((key, _)) = of_mesh.iter().find(|(_, stated)| *stated)
        {
            wrong(key, "is for shape = \"mesh\" alone")?;
        }
        let of_solid = [
            ("size_m", self.size_m.is_some()),
            ("radius_m", self.radius_m.is_some()),
            ("length_m", self.length_m.is_some()),
        ];
        let solid = |shape| convex(at, Some(shape), self.size_m, self.radius_m, self.length_m).map(Stated::Convex);
        match shape {
            ObstacleShapeName::Box => solid(BodyShape::Box),
            ObstacleShapeName::Cylinder => solid(BodyShape::Cylinder),
            ObstacleShapeName::Capsule => solid(BodyShape::Capsule),
            ObstacleShapeName::Sphere => solid(BodyShape::Sphere),
            ObstacleShapeName::HalfSpace | ObstacleShapeName::Mesh => {
                if let Some((key, _)) = of_solid.iter().find(|(_, stated)| *stated) {
                    wrong(key, "is no size of a half-space or a mesh")?;
                }
                if shape == ObstacleShapeName::HalfSpace {
                    return Ok(Stated::HalfSpace);
                }
                let Some(file) = &self.mesh else {
                    wrong("mesh", "is missing; it names the file")?;
                    return Ok(Stated::HalfSpace);
                };
                Ok(Stated::Mesh {
                    file,
                    scale: self.mesh_scale.unwrap_or([1.0; 3]),
                    parts: self.mesh_parts.unwrap_or_default(),
                })
            }
        }
    }

    /// The plates that it holds, of so many.
    pub(crate) fn held(&self, plates: usize) -> Vec<usize> {
        match &self.holds_plates {
            None => Vec::new(),
            Some(HeldPlates::Every(EveryPlate::All)) => (0..plates).collect(),
            Some(HeldPlates::These(plates)) => plates.clone(),
        }
    }
}
