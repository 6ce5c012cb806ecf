//! A point at which the tip stands.

use nalgebra::Vector3;

/// A point at which the tip stands, and what it stands on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// The point \[m\], base frame.
    pub point: Vector3<f64>,
    /// The normal of the face there, out of it, base frame.
    pub normal: Vector3<f64>,
    /// From where the tilt of the tool counts, base frame: along it the tool is upright. On a flat face the normal.
    pub axis: Vector3<f64>,
}

impl Contact {
    /// A point whose tool stands on the normal.
    #[must_use]
    pub fn on_normal(point: Vector3<f64>, normal: Vector3<f64>) -> Self {
        let axis = normal;
        Self { point, normal, axis }
    }

    /// A point over level ground \[m\].
    #[must_use]
    pub fn level(point: Vector3<f64>) -> Self {
        Self::on_normal(point, Vector3::z())
    }

    /// The point so far along the normal \[m\].
    #[must_use]
    pub fn raised(&self, height_m: f64) -> Self {
        let point = self.point + self.normal * height_m;
        Self { point, ..*self }
    }

    /// The point with the tool on the normal.
    #[must_use]
    pub fn upright(&self) -> Self {
        Self::on_normal(self.point, self.normal)
    }
}
