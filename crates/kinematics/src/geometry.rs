//! Geometry of a link, as data: collision shapes, visuals and mass properties. No collision library is used here.

use crate::rotation::Pose;
use nalgebra::{Point3, Vector3};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use ts_rs::TS;

/// Convex shape in its own frame; lengths in metres.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[ts(rename = "Solid")]
pub enum Shape {
    /// Box centred at the origin.
    Box {
        /// Half of each edge \[m\].
        half_m: [f64; 3],
    },
    /// Cylinder along z, centred at the origin (URDF's convention).
    Cylinder {
        /// Radius \[m\].
        radius_m: f64,
        /// Half of the length along z \[m\].
        half_length_m: f64,
    },
    /// Sphere centred at the origin.
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
    /// Convex hull of points; collision meshes are treated as this.
    Hull {
        /// The mesh's vertices \[m\].
        #[ts(as = "Vec<[f64; 3]>")]
        points: Vec<Point3<f64>>,
    },
}

/// Shape placed in a link frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// Pose of the shape, `T_link_shape`.
    pub pose: Pose,
    /// The shape.
    pub shape: Shape,
}

/// Visual of a link. Neither clearances nor hashes depend on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Visual {
    /// Name in the description, if it has one.
    pub name: Option<String>,
    /// Pose of the visual, `T_link_visual`.
    pub pose: Pose,
    /// Shape that is displayed.
    pub shape: VisualShape,
    /// Red, green, blue and alpha, from 0 to 1, if the description states them.
    pub rgba: Option<[f64; 4]>,
}

/// Shape of a [`Visual`].
#[derive(Debug, Clone, PartialEq)]
pub enum VisualShape {
    /// Convex solid.
    Solid(Shape),
    /// Surface of a mesh, shared by all users.
    Mesh(Arc<[Triangle]>),
}

/// Corners of a triangle, counter-clockwise seen from outside \[m\].
pub type Triangle = [Point3<f32>; 3];

/// Visual that is left out because it cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{visual} of link '{link}' is not shown: {why}")]
pub struct VisualFinding {
    /// Name of the link.
    pub link: String,
    /// Name of the visual, or its index among those of the link.
    pub visual: String,
    /// Reason, in words.
    pub why: String,
}

/// Mass properties of a link, as the description states them (SI; inertia about the centre of mass).
#[derive(Debug, Clone, PartialEq)]
pub struct Inertial {
    /// Pose of the centre of mass and the axes of the inertia, `T_link_com`.
    pub pose: Pose,
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Inertia about the centre of mass: ixx, ixy, ixz, iyy, iyz, izz \[kg·m²\].
    pub inertia_kg_m2: [f64; 6],
}

impl Shape {
    /// Longest side of the box around the shape, along its axes \[m\].
    #[must_use]
    pub fn extent_m(&self) -> f64 {
        let sides = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| self.support(&axis) + self.support(&-axis));
        sides.into_iter().fold(0.0, f64::max)
    }

    /// Support function: extent of the shape from its origin along a unit direction, in its own frame \[m\].
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
