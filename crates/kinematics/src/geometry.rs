//! Geometry of a link, as data: what can touch, what is looked at, what has mass. No collision library is involved here.

use crate::Pose;
use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A convex shape in its own frame; lengths in metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A box centred at the origin.
    Box {
        /// Half of each edge \[m\].
        half_m: [f64; 3],
    },
    /// A cylinder along z, centred at the origin (URDF's convention).
    Cylinder {
        /// Radius \[m\].
        radius_m: f64,
        /// Half of the length along z \[m\].
        half_length_m: f64,
    },
    /// A sphere centred at the origin.
    Sphere {
        /// Radius \[m\].
        radius_m: f64,
    },
    /// All points within `radius_m` of the segment from −`half_length_m` to +`half_length_m` on z.
    Capsule {
        /// Radius \[m\].
        radius_m: f64,
        /// Half of the segment's length \[m\].
        half_length_m: f64,
    },
    /// The convex hull of points: what a collision mesh is taken for.
    Hull {
        /// The mesh's vertices \[m\].
        points: Vec<Point3<f64>>,
    },
}

/// A shape placed in a link frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// `T_link_shape`.
    pub pose: Pose,
    /// The shape.
    pub shape: Shape,
}

/// What a link looks like, or a part of it. It decides nothing: neither clearances nor hashes depend on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Visual {
    /// Name in the description, where it has one.
    pub name: Option<String>,
    /// `T_link_visual`.
    pub pose: Pose,
    /// What is seen.
    pub shape: VisualShape,
    /// Red, green, blue and alpha, from 0 to 1, where the description states them.
    pub rgba: Option<[f64; 4]>,
}

/// The shape of a [`Visual`].
#[derive(Debug, Clone, PartialEq)]
pub enum VisualShape {
    /// A convex solid.
    Solid(Shape),
    /// The surface of a mesh, shared by all who look at it.
    Mesh(Arc<[Triangle]>),
}

/// Three corners of a triangle, counter-clockwise seen from outside \[m\].
pub type Triangle = [Point3<f32>; 3];

/// A visual that is left out, as it cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{visual} of link '{link}' is not shown: {why}")]
pub struct VisualFinding {
    /// Name of the link.
    pub link: String,
    /// Which of its visuals, by its name or its place among them.
    pub visual: String,
    /// Why, in words.
    pub why: String,
}

/// Mass properties of a link, as the description states them (SI; inertia about the centre of mass).
#[derive(Debug, Clone, PartialEq)]
pub struct Inertial {
    /// `T_link_com`: the centre of mass and the axes in which the inertia is given.
    pub pose: Pose,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Inertia about the centre of mass: ixx, ixy, ixz, iyy, iyz, izz \[kg·m²\].
    pub inertia_kg_m2: [f64; 6],
}

impl Shape {
    /// How far the shape extends from its origin along a unit direction, in its own frame \[m\] (its support
    /// function).
    #[must_use]
    pub fn support(&self, direction: &Vector3<f64>) -> f64 {
        let across = direction.xy().norm();
        match self {
            Self::Box { half_m } => direction.abs().dot(&Vector3::from(*half_m)),
            Self::Cylinder {
                radius_m,
                half_length_m,
            } => direction.z.abs() * half_length_m + across * radius_m,
            Self::Sphere { radius_m } => *radius_m,
            Self::Capsule {
                radius_m,
                half_length_m,
            } => direction.z.abs() * half_length_m + radius_m,
            Self::Hull { points } => points
                .iter()
                .map(|p| p.coords.dot(direction))
                .fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    #[test]
    fn supports_by_hand() {
        let diagonal = Vector3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
        let cases = [
            (
                Shape::Box {
                    half_m: [1.0, 2.0, 3.0],
                },
                4.0 * FRAC_1_SQRT_2,
            ),
            (
                Shape::Cylinder {
                    radius_m: 1.0,
                    half_length_m: 3.0,
                },
                4.0 * FRAC_1_SQRT_2,
            ),
            (Shape::Sphere { radius_m: 1.0 }, 1.0),
            (
                Shape::Capsule {
                    radius_m: 1.0,
                    half_length_m: 3.0,
                },
                3.0 * FRAC_1_SQRT_2 + 1.0,
            ),
            (
                Shape::Hull {
                    points: vec![Point3::origin(), Point3::new(2.0, 5.0, 2.0)],
                },
                4.0 * FRAC_1_SQRT_2,
            ),
        ];
        for (shape, expected) in cases {
            assert!((shape.support(&diagonal) - expected).abs() < 1e-15, "{shape:?}");
        }
    }
}
