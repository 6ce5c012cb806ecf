//! Rotation matrices, rotation vectors and folded rigid transforms.

use crate::lanes::Vector;
use crate::trig::{atan2, sin_cos};
use nalgebra::{Matrix3, Rotation3, UnitQuaternion, Vector3};

/// A rigid transform `T_a_b`: rotation as a unit quaternion, translation in metres.
pub type Pose = nalgebra::Isometry3<f64>;

/// A rigid transform as matrix and vector, `p_a = R p_b + t`: the form in which chains are folded, because
/// one product is cheaper than with quaternions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidTransform {
    /// Rotation matrix `R_a_b`.
    pub rotation: Matrix3<f64>,
    /// Origin of `b` in `a` \[m\].
    pub translation: Vector3<f64>,
}

impl RigidTransform {
    /// The identity.
    #[must_use]
    pub fn identity() -> Self {
        Self {
            rotation: Matrix3::identity(),
            translation: Vector3::zeros(),
        }
    }

    /// `T_a_c = T_a_b T_b_c`.
    #[inline]
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            rotation: self.rotation * next.rotation,
            translation: self.rotation * next.translation + self.translation,
        }
    }

    /// The same transform with its last frame turned about that frame's own z axis, by the angle of the given sine and
    /// cosine.
    #[inline]
    #[must_use]
    pub fn turned_about_z(&self, s: f64, c: f64) -> Self {
        let (x, y) = (self.rotation.column(0), self.rotation.column(1));
        Self {
            rotation: Matrix3::from_columns(&[x * c + y * s, y * c - x * s, self.rotation.column(2).into()]),
            translation: self.translation,
        }
    }

    /// The inverse transform.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let rotation = self.rotation.transpose();
        Self {
            rotation,
            translation: -(rotation * self.translation),
        }
    }
}

/// A [`RigidTransform`] column by column, three lanes each; the fourth lane stays 0.
#[derive(Clone, Copy)]
pub(crate) struct Columns<V> {
    /// Axes of the last frame in the first one.
    pub axes: [V; 3],
    /// Its origin \[m\].
    pub origin: V,
}

impl<V: Vector> Columns<V> {
    #[inline(always)]
    pub fn identity() -> Self {
        let axes = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        Self {
            axes: axes.map(V::from_array),
            origin: V::splat(0.0),
        }
    }

    #[inline(always)]
    pub fn load(from: &RigidTransform) -> Self {
        let column = |c: [f64; 3]| V::from_array([c[0], c[1], c[2], 0.0]);
        let [x, y, z]: [[f64; 3]; 3] = from.rotation.into();
        Self {
            axes: [column(x), column(y), column(z)],
            origin: column(from.translation.into()),
        }
    }

    /// [`RigidTransform::then`], bit for bit.
    #[inline(always)]
    pub fn then(&self, next: &RigidTransform) -> Self {
        let column =
            |c: [f64; 3]| self.axes[0] * V::splat(c[0]) + self.axes[1] * V::splat(c[1]) + self.axes[2] * V::splat(c[2]);
        let [x, y, z]: [[f64; 3]; 3] = next.rotation.into();
        Self {
            axes: [column(x), column(y), column(z)],
            origin: column(next.translation.into()) + self.origin,
        }
    }

    /// [`RigidTransform::turned_about_z`], bit for bit.
    #[inline(always)]
    pub fn turned_about_z(&self, s: f64, c: f64) -> Self {
        let ([x, y, z], s, c) = (self.axes, V::splat(s), V::splat(c));
        Self {
            axes: [x * c + y * s, y * c - x * s, z],
            origin: self.origin,
        }
    }

    /// Returns the transform in its usual form.
    #[inline(always)]
    pub fn rigid(&self) -> RigidTransform {
        let ([a, b, c, _], [d, e, f, _]) = (self.axes[0].to_array(), self.axes[1].to_array());
        let ([g, h, i, _], [x, y, z, _]) = (self.axes[2].to_array(), self.origin.to_array());
        RigidTransform {
            rotation: Matrix3::new(a, d, g, b, e, h, c, f, i),
            translation: Vector3::new(x, y, z),
        }
    }
}

impl From<&Pose> for RigidTransform {
    fn from(pose: &Pose) -> Self {
        Self {
            rotation: *pose.rotation.to_rotation_matrix().matrix(),
            translation: pose.translation.vector,
        }
    }
}

impl From<&RigidTransform> for Pose {
    fn from(rigid: &RigidTransform) -> Self {
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rigid.rotation));
        Pose::from_parts(rigid.translation.into(), rotation)
    }
}

/// Rotation matrix of URDF's roll, pitch, yaw \[rad\]: `Rz(yaw) Ry(pitch) Rx(roll)`.
#[must_use]
pub fn from_rpy(rpy: [f64; 3]) -> Matrix3<f64> {
    let [(sr, cr), (sp, cp), (sy, cy)] = rpy.map(sin_cos);
    Matrix3::new(
        cy * cp,
        cy * sp * sr - sy * cr,
        cy * sp * cr + sy * sr,
        sy * cp,
        sy * sp * sr + cy * cr,
        sy * sp * cr - cy * sr,
        -sp,
        cp * sr,
        cp * cr,
    )
}

/// Twice the sine below which the angle comes from a series.
const SMALL: f64 = 0.02;

/// Rotation vector (axis × angle, angle in [0, π]) of a rotation matrix: the logarithm on SO(3).
///
/// Exact to rounding everywhere: the angle comes from `atan2(‖v‖, tr R − 1)` with `v` the skew part, which
/// is accurate near 0; near π, where `v` vanishes, the axis comes from the symmetric part
/// `(R + Rᵀ)/2 = cos θ I + (1 − cos θ) a aᵀ` and only its sign from `v`.
#[inline(always)]
#[must_use]
pub fn rotation_vector(r: &Matrix3<f64>) -> Vector3<f64> {
    // v = 2 sin θ · axis, and tr R − 1 = 2 cos θ.
    let v = Vector3::new(r.m32 - r.m23, r.m13 - r.m31, r.m21 - r.m12);
    let (two_sin, two_cos) = (v.norm_squared().sqrt(), r.trace() - 1.0);
    if two_sin < SMALL && two_cos > 0.0 {
        // θ/(2 sin θ) = asin(x)/(2x) with x = sin θ: the next term is below 1e-17.
        let x2 = 0.25 * two_sin * two_sin;
        return v * (0.5 + x2 * (1.0 / 12.0 + x2 * (3.0 / 80.0 + x2 * (5.0 / 224.0))));
    }
    large_rotation_vector(r, v, two_sin, two_cos)
}

/// [`rotation_vector`] of larger angles; v = 2 sin θ · axis.
#[inline(never)]
fn large_rotation_vector(r: &Matrix3<f64>, v: Vector3<f64>, two_sin: f64, two_cos: f64) -> Vector3<f64> {
    let angle = atan2(two_sin, two_cos);
    if two_cos > -1.9 {
        return v * (angle / two_sin);
    }
    let cosine = 0.5 * two_cos;
    let symmetric = (r + r.transpose()) * 0.5 - Matrix3::identity() * cosine;
    let longest = (0..3)
        .max_by(|&a, &b| symmetric[(a, a)].total_cmp(&symmetric[(b, b)]))
        .unwrap_or(0);
    let axis = symmetric.column(longest).normalize();
    let sign = if axis.dot(&v) < 0.0 { -1.0 } else { 1.0 };
    axis * (sign * angle)
}
