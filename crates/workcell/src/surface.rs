//! The face of a plate that is washed: a surface of revolution, by its meridian.
//!
//! In its plate's frame the axis is z and the pole, where the axis meets the face, is the origin. A point is stated by its
//! distance ρ from the axis \[m\] and its azimuth φ from x \[rad\].

use crate::trig::sin_cos;
use nalgebra::{Point3, Unit, Vector3};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A surface of revolution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(tag = "meridian", rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum Surface {
    /// A flat disc.
    Disc {
        /// Radius of the rim \[m\].
        radius_m: f64,
    },
}

impl Surface {
    /// Radius of the rim \[m\]: the greatest ρ.
    #[must_use]
    pub fn rim_m(&self) -> f64 {
        match *self {
            Self::Disc { radius_m } => radius_m,
        }
    }

    /// Height of the face over its pole at ρ \[m\].
    #[must_use]
    pub fn height_m(&self, _rho_m: f64) -> f64 {
        match self {
            Self::Disc { .. } => 0.0,
        }
    }

    /// The point at ρ \[m\] and φ \[rad\], plate frame.
    #[must_use]
    pub fn point(&self, rho_m: f64, phi_rad: f64) -> Point3<f64> {
        let (s, c) = sin_cos(phi_rad);
        Point3::new(rho_m * c, rho_m * s, self.height_m(rho_m))
    }

    /// The normal at ρ \[m\] and φ \[rad\], away from the plate's body, plate frame.
    #[must_use]
    pub fn normal(&self, _rho_m: f64, _phi_rad: f64) -> Unit<Vector3<f64>> {
        match self {
            Self::Disc { .. } => Vector3::z_axis(),
        }
    }

    /// Between what the principal curvatures lie \[1/m\], above 0 where the face is hollow.
    #[must_use]
    pub fn curvature_bounds(&self) -> [f64; 2] {
        match self {
            Self::Disc { .. } => [0.0; 2],
        }
    }

    /// Area of the face \[m²\].
    #[must_use]
    pub fn area_m2(&self) -> f64 {
        match self {
            Self::Disc { radius_m } => PI * radius_m * radius_m,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disc_is_flat_and_as_large_as_it_is() {
        let disc = Surface::Disc { radius_m: 0.2 };
        let rim = disc.point(disc.rim_m(), 0.5 * PI);
        assert!((rim - Point3::new(0.0, 0.2, 0.0)).norm() < 1e-15);
        assert_eq!(disc.normal(0.1, 1.0), Vector3::z_axis());
        assert_eq!((disc.height_m(0.2), disc.curvature_bounds()), (0.0, [0.0; 2]));
        assert!((disc.area_m2() - 0.04 * PI).abs() < 1e-15);
    }
}
