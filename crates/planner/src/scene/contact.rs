//! A point at which the tip stands.

use nalgebra::Vector3;

/// A point at which the tip stands, and what it stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The point \[m\], base frame.
    pub point: Vector3<f64>,
    /// The normal of the face there, out of it, base frame.
    pub normal: Vector3<f64>,
}

impl Contact {
    /// A point over level ground \[m\].
    #[must_use]
    pub fn level(point: Vector3<f64>) -> Self {
        let normal = Vector3::z();
        Self { point, normal }
    }

    /// The point so far along the normal \[m\].
    #[must_use]
    pub fn raised(&self, height_m: f64) -> Self {
        let point = self.point + self.normal * height_m;
        Self { point, ..*self }
    }
}
