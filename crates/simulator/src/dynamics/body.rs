//! A rigid body: mass, centre of mass, inertia.

use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::geometry::Inertial;
use platewash_kinematics::rotation::Rigid;

/// Mass properties of a rigid body in some frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Centre of mass \[m\].
    pub com_m: Vector3<f64>,
    /// Inertia about the centre of mass, axes of the frame \[kg·m²\]; symmetric.
    pub inertia_kg_m2: Matrix3<f64>,
}

impl RigidBody {
    /// Nothing.
    #[must_use]
    pub fn none() -> Self {
        Self {
            mass_kg: 0.0,
            com_m: Vector3::zeros(),
            inertia_kg_m2: Matrix3::zeros(),
        }
    }

    /// The same body in another frame; `placed` is `T_new_old`.
    #[must_use]
    pub fn in_frame(&self, placed: &Rigid) -> Self {
        let turn = placed.rotation;
        Self {
            mass_kg: self.mass_kg,
            com_m: turn * self.com_m + placed.translation,
            inertia_kg_m2: turn * self.inertia_kg_m2 * turn.transpose(),
        }
    }

    /// Both bodies as one, by the parallel-axis theorem; both in the same frame.
    #[must_use]
    pub fn with(&self, other: &Self) -> Self {
        let mass_kg = self.mass_kg + other.mass_kg;
        if mass_kg <= 0.0 {
            return Self::none();
        }
        let com_m = (self.com_m * self.mass_kg + other.com_m * other.mass_kg) / mass_kg;
        let about = |body: &Self| body.inertia_kg_m2 + steiner(body.mass_kg, &(body.com_m - com_m));
        Self {
            mass_kg,
            com_m,
            inertia_kg_m2: about(self) + about(other),
        }
    }

    /// Inertia about the frame's origin \[kg·m²\]: I + m (c² 1 − c cᵀ).
    #[must_use]
    pub fn inertia_about_origin(&self) -> Matrix3<f64> {
        self.inertia_kg_m2 + steiner(self.mass_kg, &self.com_m)
    }
}

impl From<&Inertial> for RigidBody {
    fn from(inertial: &Inertial) -> Self {
        let placed = Rigid::from(&inertial.pose);
        Self {
            mass_kg: inertial.mass_kg,
            com_m: Vector3::zeros(),
            inertia_kg_m2: symmetric(&inertial.inertia_kg_m2),
        }
        .in_frame(&placed)
    }
}

/// The symmetric matrix of ixx, ixy, ixz, iyy, iyz, izz.
pub(super) fn symmetric(&[xx, xy, xz, yy, yz, zz]: &[f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// What a mass at `d` adds to the inertia about the origin.
pub(super) fn steiner(mass: f64, d: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * mass
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two halves of a rod, each m/2 and l/2 long, are the rod: m l²/12.
    #[test]
    fn two_halves_are_the_whole() {
        let half = |z: f64| {
            let across = 0.5 * 0.5 * 0.5 / 12.0;
            RigidBody {
                mass_kg: 0.5,
                com_m: Vector3::new(1.0, 2.0, z),
                inertia_kg_m2: Matrix3::from_diagonal(&Vector3::new(across, across, 0.0)),
            }
        };
        let whole = half(3.0).with(&half(3.5));
        assert!((whole.com_m - Vector3::new(1.0, 2.0, 3.25)).norm() < 1e-15);
        assert!((whole.inertia_kg_m2.m11 - 1.0 / 12.0).abs() < 1e-15);
        assert!((whole.inertia_about_origin().m33 - 5.0).abs() < 1e-14);
        assert_eq!(whole.with(&RigidBody::none()), whole);
    }
}
