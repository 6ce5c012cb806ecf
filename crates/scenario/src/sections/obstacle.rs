//! The `[[obstacle]]` sections: obstacles around the arm.

use crate::error::Problem;
use crate::keys::key::Domain::{Number, Plates, Text, Triple, Word};
use crate::keys::key::{Key, key};
use crate::sections::body_shape::{SectionShape, StatedShape, only_of_mesh, with_shape_keys};
use serde::{Deserialize, Serialize};

/// The keys of `[[obstacle]]`.
pub(crate) const OBSTACLE_KEYS: &[Key] = with_shape_keys!(
    "obstacle",
    [key(
        "obstacle.name",
        "",
        Text,
        "Its name, in messages: no other body has it.",
    ),],
    &["box", "cylinder", "capsule", "sphere", "half_space", "mesh"],
    "A box with its size_m, a sphere with its radius_m, a cylinder or a capsule along its own z with radius_m and length_m, all below \
     its own z = 0, or a mesh out of a file.",
    [100.0, 100.0],
    [key(
        "obstacle.mesh_parts",
        "",
        Word(&["hull", "decomposed"]),
        "What counts of a mesh: its convex hull, or convex parts that together enclose its surface; they hold more than the mesh, too, \
         as the page shows. Without it, the hull.",
    ),],
    [
        key(
            "obstacle.at_m",
            "m",
            Triple(-100.0, 100.0),
            "Where its own origin is: the centre of a box, cylinder, capsule or sphere, a point of a half-space's plane, the origin of a mesh. Every \
             obstacle has one.",
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
    ]
);

/// `[[obstacle]]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ObstacleSection {
    /// Its name.
    pub name: String,
    /// Its shape.
    #[serde(flatten)]
    pub body: StatedShape,
    /// Parts of a mesh that count as the obstacle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub mesh_parts: Option<MeshPartsName>,
    /// Position of its origin in the world frame \[m\]; every obstacle has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_m: Option<[f64; 3]>,
    /// Orientation: roll, pitch and yaw about the world's fixed axes x, y, z \[deg\].
    pub rpy_deg: [f64; 3],
    /// Distance by which the obstacle is grown on all sides \[m\].
    pub margin_m: f64,
    /// The plates that it holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub holds_plates: Option<HeldPlates>,
}

/// Parts of a mesh that count as the obstacle.
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
    Every(AllPlates),
    /// Some, by their index.
    These(Vec<usize>),
}

/// The word for every plate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AllPlates {
    /// `"all"`.
    All,
}

impl ObstacleSection {
    /// Its shape with the sizes that belong to it, no more and no fewer.
    pub(crate) fn stated(&self, at: &str) -> Result<SectionShape<'_>, Problem> {
        let stated = self.body.stated(at)?;
        if self.mesh_parts.is_some() {
            only_of_mesh(at, "mesh_parts", self.body.shape)?;
        }
        Ok(stated)
    }

    /// Indices of the plates that it holds, among the given number of plates.
    pub(crate) fn held(&self, plates: usize) -> Vec<usize> {
        match &self.holds_plates {
            None => Vec::new(),
            Some(HeldPlates::Every(AllPlates::All)) => (0..plates).collect(),
            Some(HeldPlates::These(plates)) => plates.clone(),
        }
    }
}
