//! Shapes of links and where they are.

use super::numbers::Numbers;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::{self, VisualShape};
use platewash_workcell::pose;
use serde::Serialize;
use ts_rs::TS;

/// A shape of a link in its own frame; cylinders and capsules lie along z.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A surface of triangles.
    Mesh {
        /// \[count, 3 corners, 3 coordinates\] \[m\].
        triangles: Numbers,
    },
    /// A convex solid.
    #[serde(untagged)]
    Solid(geometry::Shape),
}

impl From<&VisualShape> for Shape {
    fn from(shape: &VisualShape) -> Self {
        match shape {
            VisualShape::Solid(shape) => Self::Solid(shape.clone()),
            VisualShape::Mesh(triangles) => {
                let corners = triangles.iter().flatten().flat_map(|corner| corner.coords.iter());
                let triangles = Numbers::f32([triangles.len(), 3, 3], corners.copied());
                Self::Mesh { triangles }
            }
        }
    }
}

/// A shape in the frame of a link.
#[derive(Debug, Clone, PartialEq, Serialize, TS)]
pub struct Body {
    /// Its shape.
    pub shape: Shape,
    /// Pose of the body.
    #[serde(serialize_with = "pose::serialize")]
    #[ts(as = "platewash_workcell::pose::PoseFields")]
    pub pose: Pose,
    /// Red, green, blue and alpha, from 0 to 1, where they are stated.
    pub rgba: Option<[f64; 4]>,
}
