//! Whether a body can exist.

use super::body::RigidBody;
use nalgebra::Matrix3;

/// What figures rounded to six digits may miss, as a part of the inertia's trace.
const ROUNDING: f64 = 2e-6;

/// Why no body has such mass properties.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Unphysical {
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
pub(super) fn check(body: &RigidBody) -> Result<(), Unphysical> {
    let inertia = body.inertia_kg_m2;
    let finite = body.mass_kg.is_finite() && body.com_m.iter().chain(inertia.iter()).all(|v| v.is_finite());
    if !finite {
        return Err(Unphysical::NotFinite);
    }
    if body.mass_kg <= 0.0 {
        return Err(Unphysical::Mass(body.mass_kg));
    }
    let trace = inertia.trace();
    if inertia == Matrix3::zeros() {
        return Ok(()); // a point
    }
    if trace > 0.0 && trace.is_finite() && is_semidefinite(&(Matrix3::identity() * (0.5 + ROUNDING) - inertia / trace))
    {
        return Ok(());
    }
    Err(Unphysical::Inertia(inertia))
}

/// Whether no principal minor is negative (Sylvester's criterion for semidefinite matrices).
fn is_semidefinite(s: &Matrix3<f64>) -> bool {
    let minor = |i: usize, j: usize| s[(i, i)] * s[(j, j)] - s[(i, j)] * s[(j, i)];
    let diagonal = (0..3).all(|i| s[(i, i)] >= 0.0);
    diagonal && minor(0, 1) >= 0.0 && minor(0, 2) >= 0.0 && minor(1, 2) >= 0.0 && s.determinant() >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use proptest::prelude::*;

    fn body(inertia_kg_m2: Matrix3<f64>) -> RigidBody {
        RigidBody {
            mass_kg: 1.0,
            com_m: Vector3::zeros(),
            inertia_kg_m2,
        }
    }

    proptest! {
        /// Masses at random points make a body, whatever their number.
        #[test]
        fn points_of_mass_are_a_body(points in prop::collection::vec((0.01..2.0f64, prop::array::uniform3(-1.0..1.0f64)), 1..9)) {
            let point = |(mass_kg, at): &(f64, [f64; 3])| RigidBody {
                mass_kg: *mass_kg,
                com_m: Vector3::from(*at),
                inertia_kg_m2: Matrix3::zeros(),
            };
            let whole = points.iter().map(point).fold(RigidBody::none(), |all, one| all.with(&one));
            prop_assert_eq!(check(&whole), Ok(()));
        }

        /// The criterion is that of the principal moments.
        #[test]
        fn the_triangle_inequality_decides(a in 0.0..1.0f64, b in 0.0..1.0f64, c in 0.0..1.0f64, turn in prop::array::uniform3(-3.0..3.0f64)) {
            let least = (a + b - c).min(b + c - a).min(c + a - b) / (a + b + c);
            prop_assume!(least.abs() > 1e-4);
            let turn = nalgebra::Rotation3::new(Vector3::from(turn));
            let turned = turn.matrix() * Matrix3::from_diagonal(&Vector3::new(a, b, c)) * turn.matrix().transpose();
            prop_assert_eq!(check(&body(turned)).is_ok(), least > 0.0);
        }
    }

    #[test]
    fn what_cannot_exist_is_named() {
        let fine = Matrix3::identity();
        assert_eq!(check(&body(fine)), Ok(()));
        assert_eq!(check(&body(Matrix3::zeros())), Ok(()));
        assert_eq!(
            check(&RigidBody {
                mass_kg: 0.0,
                ..body(fine)
            }),
            Err(Unphysical::Mass(0.0))
        );
        assert_eq!(
            check(&RigidBody {
                mass_kg: f64::NAN,
                ..body(fine)
            }),
            Err(Unphysical::NotFinite)
        );
        assert_eq!(check(&body(fine * f64::INFINITY)), Err(Unphysical::NotFinite));
        assert!(matches!(check(&body(-fine)), Err(Unphysical::Inertia(_))));
        assert!(
            matches!(check(&body(fine * f64::MAX)), Err(Unphysical::Inertia(_))),
            "the trace overflows"
        );
    }
}
