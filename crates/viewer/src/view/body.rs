//! Shapes and where they are.

use super::numbers::Numbers;
use nalgebra::Point3;
use platewash_kinematics::Pose as Rigid;
use platewash_kinematics::geometry::{self, Triangle, VisualShape};
use platewash_workcell::clearance::hull_triangles;
use platewash_workcell::workcell::ObstacleShape;
use serde::Serialize;

/// `T_a_b`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Pose {
    /// Where b's origin lies in a \[m\].
    pub position_m: [f64; 3],
    /// b's axes in a, a unit quaternion (w, x, y, z).
    pub quaternion_wxyz: [f64; 4],
}

impl From<&Rigid> for Pose {
    fn from(pose: &Rigid) -> Self {
        let q = pose.rotation.quaternion();
        Self {
            position_m: pose.translation.vector.into(),
            quaternion_wxyz: [q.w, q.i, q.j, q.k],
        }
    }
}

/// A shape in its own frame; cylinders and capsules lie along z.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A surface of triangles.
    Mesh {
        /// \[count, 3 corners, 3 coordinates\] \[m\].
        triangles: Numbers,
    },
    /// All of z ≤ 0.
    HalfSpace {},
    /// A convex solid.
    #[serde(untagged)]
    Solid(geometry::Shape),
}

impl From<&geometry::Shape> for Shape {
    fn from(shape: &geometry::Shape) -> Self {
        Self::Solid(shape.clone())
    }
}

impl From<&ObstacleShape> for Shape {
    fn from(shape: &ObstacleShape) -> Self {
        match shape {
            ObstacleShape::HalfSpace => Self::HalfSpace {},
            ObstacleShape::Convex(shape) => shape.into(),
            ObstacleShape::Parts(hulls) => Self::Mesh {
                triangles: hulls_corners(hulls),
            },
        }
    }
}

impl From<&VisualShape> for Shape {
    fn from(shape: &VisualShape) -> Self {
        match shape {
            VisualShape::Solid(shape) => shape.into(),
            VisualShape::Mesh(triangles) => Self::Mesh {
                triangles: corners(triangles),
            },
        }
    }
}

fn corners(triangles: &[Triangle]) -> Numbers {
    let coordinates = triangles
        .iter()
        .flatten()
        .flat_map(|corner| corner.coords.iter().copied());
    Numbers::f32_shaped(vec![triangles.len(), 3, 3], coordinates)
}

/// The surfaces of some hulls; one without volume has none.
fn hulls_corners(hulls: &[Vec<Point3<f64>>]) -> Numbers {
    let surfaces = hulls.iter().filter_map(|points| hull_triangles(points));
    let triangles: Vec<[Point3<f64>; 3]> = surfaces
        .flat_map(|hull| {
            let corner = move |k: usize| hull.corners[k];
            hull.triangles
                .clone()
                .into_iter()
                .map(move |triangle| triangle.map(&corner))
        })
        .collect();
    let coordinates = triangles
        .iter()
        .flatten()
        .flat_map(|corner| corner.coords.iter().map(|c| *c as f32));
    Numbers::f32_shaped(vec![triangles.len(), 3, 3], coordinates)
}

/// A shape somewhere.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
    /// Where it is.
    pub pose: Pose,
    /// Red, green, blue and alpha, from 0 to 1, where they are stated.
    pub rgba: Option<[f64; 4]>,
}

impl Body {
    /// A body of no stated colour.
    pub(super) fn plain(name: &str, shape: Shape, pose: &Rigid) -> Self {
        Self {
            name: name.to_owned(),
            shape,
            pose: pose.into(),
            rgba: None,
        }
    }
}
