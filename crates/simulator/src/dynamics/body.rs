//! A rigid body, a link or the tool: mass, centre of mass, inertia, and the check that it can exist.

use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::geometry::Inertial;
use platewash_kinematics::rotation::RigidTransform;
use platewash_workcell::tool::ToolMass;

/// Mass properties of a rigid body in some frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RigidBody {
    /// Mass \[kg\].
    pub mass_kg: f64,
    /// Centre of mass \[m\].
    pub com_m: Vector3<f64>,
    /// Inertia about the centre of mass, axes of the frame \[kg·m²\]; symmetric.
    pub inertia_kg_m2: Matrix3<f64>,
}

impl RigidBody {
    /// The same body in another frame; `placed` is `T_new_old`.
    #[must_use]
    pub fn in_frame(&self, placed: &RigidTransform) -> Self {
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
            return Self::default();
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
        let placed = RigidTransform::from(&inertial.pose);
        Self {
            mass_kg: inertial.mass_kg,
            com_m: Vector3::zeros(),
            inertia_kg_m2: symmetric(&inertial.inertia_kg_m2),
        }
        .in_frame(&placed)
    }
}

/// The symmetric matrix of ixx, ixy, ixz, iyy, iyz, izz.
pub(crate) fn symmetric(&[xx, xy, xz, yy, yz, zz]: &[f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// Contribution of a mass at `d` to the inertia about the origin.
pub(crate) fn steiner(mass: f64, d: &Vector3<f64>) -> Matrix3<f64> {
    (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * mass
}

/// Error of figures rounded to six digits, as a part of the inertia's trace.
const ROUNDING: f64 = 2e-6;

/// Reason that no body has such mass properties.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MassPropertiesError {
    /// Not finite.
    #[error("mass, centre of mass and inertia must be finite")]
    NotFinite,
    /// Mass that is zero or less.
    #[error("mass must be above 0 kg; found {0}")]
    Mass(f64),
    /// A negative principal moment, or one above the sum of the other two.
    #[error(
        "inertia must be positive semidefinite with no principal moment above the sum of the other two (triangle inequality); \
         found ixx {}, ixy {}, ixz {}, iyy {}, iyz {}, izz {} kg·m²",
        .0.m11, .0.m12, .0.m13, .0.m22, .0.m23, .0.m33
    )]
    Inertia(Matrix3<f64>),
}

/// Checks that some distribution of positive mass has these properties.
///
/// It does if and only if Σ = ½ tr(I) 1 − I is positive semidefinite, I about the centre of mass: Σ holds the second moments
/// of the mass, and its eigenvalues are the halves of what the triangle inequality asks to be positive (P. Wensing, S. Kim,
/// J.-J. Slotine, *Linear matrix inequalities for physically consistent inertial parameter identification*, IEEE RA-L 3,
/// 2018).
pub(crate) fn check(body: &RigidBody) -> Result<(), MassPropertiesError> {
    let inertia = body.inertia_kg_m2;
    let finite = body.mass_kg.is_finite() && body.com_m.iter().chain(inertia.iter()).all(|v| v.is_finite());
    if !finite {
        return Err(MassPropertiesError::NotFinite);
    }
    if body.mass_kg <= 0.0 {
        return Err(MassPropertiesError::Mass(body.mass_kg));
    }
    let trace = inertia.trace();
    if inertia == Matrix3::zeros() {
        return Ok(()); // a point
    }
    if trace > 0.0 && trace.is_finite() && is_semidefinite(&(Matrix3::identity() * (0.5 + ROUNDING) - inertia / trace))
    {
        return Ok(());
    }
    Err(MassPropertiesError::Inertia(inertia))
}

/// Checks that no principal minor is negative (Sylvester's criterion for semidefinite matrices).
fn is_semidefinite(s: &Matrix3<f64>) -> bool {
    let minor = |i: usize, j: usize| s[(i, i)] * s[(j, j)] - s[(i, j)] * s[(j, i)];
    let diagonal = (0..3).all(|i| s[(i, i)] >= 0.0);
    diagonal && minor(0, 1) >= 0.0 && minor(0, 2) >= 0.0 && minor(1, 2) >= 0.0 && s.determinant() >= 0.0
}

impl From<&ToolMass> for RigidBody {
    fn from(mass: &ToolMass) -> Self {
        Self {
            mass_kg: mass.mass_kg,
            com_m: Vector3::from(mass.com_m),
            inertia_kg_m2: symmetric(&mass.inertia_kg_m2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use proptest::prelude::*;

    /// Two halves of a rod, each m/2 and l/2 long, are the rod: m l²/12.
    #[test]
    fn two_halves_give_the_body_of_the_whole() {
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
        assert_eq!(whole.with(&RigidBody::default()), whole);
    }

    fn body(inertia_kg_m2: Matrix3<f64>) -> RigidBody {
        RigidBody {
            mass_kg: 1.0,
            com_m: Vector3::zeros(),
            inertia_kg_m2,
        }
    }

    proptest! {
        /// Masses at random points make a body, for any number of points.
        #[test]
        fn point_masses_give_the_body(points in prop::collection::vec((0.01..2.0f64, prop::array::uniform3(-1.0..1.0f64)), 1..9)) {
            let point = |(mass_kg, at): &(f64, [f64; 3])| RigidBody {
                mass_kg: *mass_kg,
                com_m: Vector3::from(*at),
                inertia_kg_m2: Matrix3::zeros(),
            };
            let whole = points.iter().map(point).fold(RigidBody::default(), |all, one| all.with(&one));
            prop_assert_eq!(check(&whole), Ok(()));
        }

        /// The criterion is that of the principal moments.
        #[test]
        fn the_triangle_inequality_decides_about_inertias(a in 0.0..1.0f64, b in 0.0..1.0f64, c in 0.0..1.0f64, turn in prop::array::uniform3(-3.0..3.0f64)) {
            let least = (a + b - c).min(b + c - a).min(c + a - b) / (a + b + c);
            prop_assume!(least.abs() > 1e-4);
            let turn = nalgebra::Rotation3::new(Vector3::from(turn));
            let turned = turn.matrix() * Matrix3::from_diagonal(&Vector3::new(a, b, c)) * turn.matrix().transpose();
            prop_assert_eq!(check(&body(turned)).is_ok(), least > 0.0);
        }
    }

    #[test]
    fn names_impossible_mass_properties() {
        let fine = Matrix3::identity();
        assert_eq!(check(&body(fine)), Ok(()));
        assert_eq!(check(&body(Matrix3::zeros())), Ok(()));
        assert_eq!(
            check(&RigidBody {
                mass_kg: 0.0,
                ..body(fine)
            }),
            Err(MassPropertiesError::Mass(0.0))
        );
        assert_eq!(
            check(&RigidBody {
                mass_kg: f64::NAN,
                ..body(fine)
            }),
            Err(MassPropertiesError::NotFinite)
        );
        assert_eq!(check(&body(fine * f64::INFINITY)), Err(MassPropertiesError::NotFinite));
        assert!(matches!(check(&body(-fine)), Err(MassPropertiesError::Inertia(_))));
        assert!(
            matches!(check(&body(fine * f64::MAX)), Err(MassPropertiesError::Inertia(_))),
            "the trace overflows"
        );
    }
}
