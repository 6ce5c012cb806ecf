//! Collision geometry of a link, as data: no collision library is involved here.

use crate::Pose;
use nalgebra::Point3;

/// A convex shape in its own frame; lengths in metres.
#[derive(Debug, Clone, PartialEq)]
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
