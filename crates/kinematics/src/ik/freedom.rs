//! Freedom in the task: the deviations of a frame from its target that are allowed.
//!
//! The deviation of a frame from its target `T_target_frame` is written as six numbers: the origin in target axes
//! (x, y, z \[m\]), the tilt of the frame's z axis as a vector in the target's xy plane (direction of the lean, length = angle \[rad\]), and
//! the yaw, the rotation about z that is left when the tilt is undone by the shortest way (swing–twist decomposition; Dobrowolski
//! 2015). The allowed deviations form a convex set: a box, a disc, and a point or everything.

use crate::model::Jacobian;
use crate::rotation::RigidTransform;
use crate::trig::atan2;
use nalgebra::{Matrix3, Matrix6, RowVector3, Unit, UnitQuaternion, Vector3, Vector6};
use std::f64::consts::PI;

/// Freedom of the frame to turn about its own z axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Yaw {
    /// No rotation.
    Fixed,
    /// Any rotation.
    Free,
}

/// Allowed deviations of a frame from its target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaskFreedom {
    /// Largest deviation of the origin along each axis of the target \[m\]; 0 for none.
    pub position_m: [f64; 3],
    /// Largest angle between the z axes of frame and target \[rad\]; 0 for none, below π.
    pub tilt_rad: f64,
    /// Rotation about the z axis.
    pub yaw: Yaw,
}

/// Number of a freedom that is out of range.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("task freedom {name} must be {expected}; found {found}")]
pub struct TaskFreedomError {
    /// Name of the number.
    pub name: &'static str,
    /// Allowed range.
    pub expected: &'static str,
    /// Value given.
    pub found: f64,
}

impl TaskFreedom {
    /// Returns no freedom: the pose is met exactly.
    #[must_use]
    pub fn none() -> Self {
        Self {
            position_m: [0.0; 3],
            tilt_rad: 0.0,
            yaw: Yaw::Fixed,
        }
    }

    /// Returns the freedom to tilt within a cone of half-angle `tilt_rad` \[rad\] and to turn about the tool's axis.
    #[must_use]
    pub fn cone(tilt_rad: f64) -> Self {
        Self {
            tilt_rad,
            yaw: Yaw::Free,
            ..Self::none()
        }
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// [`TaskFreedomError`] for the first one out of range, NaN included.
    pub fn validate(&self) -> Result<(), TaskFreedomError> {
        let wrong = |name, expected, found| Err(TaskFreedomError { name, expected, found });
        if let Some(&found) = self.position_m.iter().find(|v| !(0.0..=10.0).contains(*v)) {
            return wrong("position_m", "in [0, 10] m", found);
        }
        if !(0.0..PI).contains(&self.tilt_rad) {
            return wrong("tilt_rad", "in [0, π) rad", self.tilt_rad);
        }
        Ok(())
    }
}

/// Deviation of a frame from its target: x, y, z \[m\], tilt about which the frame leans (two components \[rad\]), yaw \[rad\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Deviation(pub Vector6<f64>);

impl Deviation {
    /// Returns the deviation of `frame` from `target`, both `T_base_…`.
    pub fn between(frame: &RigidTransform, target: &RigidTransform) -> Self {
        let origin = target.rotation.tr_mul(&(frame.translation - target.translation));
        let r = target.rotation.tr_mul(&frame.rotation);
        let (tilt, _) = lean(&r);
        Self(Vector6::new(origin.x, origin.y, origin.z, tilt[0], tilt[1], twist(&r)))
    }

    /// Returns the derivative by the joints, from the Jacobian of the frame in base axes.
    pub fn jacobian(frame: &RigidTransform, target: &RigidTransform, jacobian: &Jacobian) -> Matrix6<f64> {
        let r = target.rotation.tr_mul(&frame.rotation);
        let to_target = target.rotation.transpose();
        let linear = to_target * jacobian.fixed_rows::<3>(0);
        let angular = to_target * jacobian.fixed_rows::<3>(3);
        let z = r.column(2).into_owned();
        // ż = ω × z
        let of_axis = -z.cross_matrix() * angular;
        let (_, of_tilt) = lean(&r);
        // ψ̇ = ω · (e_z + z) / (1 + e_z · z)
        let yaw_row = (RowVector3::new(0.0, 0.0, 1.0) + z.transpose()) / (1.0 + z.z).max(1e-9);
        let mut all = Matrix6::zeros();
        all.fixed_view_mut::<3, 6>(0, 0).copy_from(&linear);
        all.fixed_view_mut::<2, 6>(3, 0).copy_from(&(of_tilt * of_axis));
        all.fixed_view_mut::<1, 6>(5, 0).copy_from(&(yaw_row * angular));
        all
    }

    /// Returns the nearest allowed deviation, pulled inside by a relative 1e-9 so that it stays allowed after rounding.
    pub fn allowed(&self, freedom: &TaskFreedom) -> Self {
        let mut v = self.0;
        for (value, most) in v.iter_mut().zip(freedom.position_m) {
            *value = value.clamp(-most, most);
        }
        let angle = f64::sqrt(v[3] * v[3] + v[4] * v[4]);
        if angle > freedom.tilt_rad {
            let scale = freedom.tilt_rad / angle * (1.0 - 1e-9);
            (v[3], v[4]) = (v[3] * scale, v[4] * scale);
        }
        if freedom.yaw == Yaw::Fixed {
            v[5] = 0.0;
        }
        Self(v)
    }

    /// Returns the pose that deviates by this much from `target`.
    pub fn applied_to(&self, target: &RigidTransform) -> RigidTransform {
        let v = &self.0;
        let angle = f64::sqrt(v[3] * v[3] + v[4] * v[4]);
        // Leaning towards (x, y) is turning about (−y, x).
        let swing = if angle > 0.0 {
            let axis = Unit::new_unchecked(Vector3::new(-v[4] / angle, v[3] / angle, 0.0));
            UnitQuaternion::from_axis_angle(&axis, angle)
        } else {
            UnitQuaternion::identity()
        };
        let turn = swing * UnitQuaternion::from_axis_angle(&Vector3::z_axis(), v[5]);
        target.then(&RigidTransform {
            rotation: *turn.to_rotation_matrix().matrix(),
            translation: v.fixed_rows::<3>(0).into_owned(),
        })
    }
}

/// Returns the tilt vector of the z axis of `r`, and its derivative by that axis (2 × 3).
fn lean(r: &Matrix3<f64>) -> ([f64; 2], nalgebra::Matrix2x3<f64>) {
    let (x, y, c) = (r.m13, r.m23, r.m33);
    let sine = f64::sqrt(x * x + y * y);
    if sine < 1e-9 {
        // τ/sin τ → 1; a tilt of exactly π has no direction and is left as none.
        return ([x, y], nalgebra::Matrix2x3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0));
    }
    let angle = atan2(sine, c);
    let g = angle / sine;
    // dτ = c dr − r dc and dr = (x dx + y dy)/r give dg = (dτ − g dr)/r.
    let (along, down) = ((c - g) / (sine * sine), -1.0);
    let dg = [along * x, along * y, down];
    let rows = nalgebra::Matrix2x3::new(g + x * dg[0], x * dg[1], x * dg[2], y * dg[0], g + y * dg[1], y * dg[2]);
    ([x * g, y * g], rows)
}

/// Returns the yaw that is left when the tilt is undone by the shortest way, in (−π, π].
fn twist(r: &Matrix3<f64>) -> f64 {
    // With the quaternion (w, x, y, z): ψ = 2 atan2(z, w), and z : w = (r21 − r12) : (r11 + r22) for that half-angle doubled.
    atan2(r.m21 - r.m12, r.m11 + r.m22)
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Axes, JointVector, RobotModel};
    use proptest::prelude::*;

    proptest! {
        /// Applying a deviation and reading it back is the identity.
        #[test]
        fn a_deviation_is_read_back(
            p in prop::array::uniform3(-0.5..0.5f64), lean in 0.0..3.0f64, towards in -3.1..3.1f64, yaw in -3.1..3.1f64,
            at in prop::array::uniform6(-1.0..1.0f64),
        ) {
            let robot = RobotModel::irb120().map_err(|e| TestCaseError::fail(e.to_string()))?;
            let target = robot.fk(&JointVector::from(at)).rigid(&robot.last_link_frame());
            let given = Deviation(Vector6::new(p[0], p[1], p[2], lean * towards.cos(), lean * towards.sin(), yaw));
            let back = Deviation::between(&given.applied_to(&target), &target);
            prop_assert!((back.0 - given.0).amax() < 1e-9, "{given:?} {back:?}");
        }

        #[test]
        fn the_derivative_is_that_of_the_deviation(at in prop::array::uniform6(-1.0..1.0f64), to in prop::array::uniform6(-1.0..1.0f64), joint in 0..6usize) {
            let robot = RobotModel::irb120().map_err(|e| TestCaseError::fail(e.to_string()))?;
            let frame = robot.last_link_frame();
            let target = robot.fk(&JointVector::from(to)).rigid(&frame);
            let q = JointVector::from(at);
            let deviation = |q: &JointVector| Deviation::between(&robot.fk(q).rigid(&frame), &target).0;
            let here = deviation(&q);
            prop_assume!(here.fixed_rows::<2>(3).norm() < 2.8 && here[5].abs() < 3.0);
            let bodies = robot.fk(&q);
            let exact = Deviation::jacobian(&bodies.rigid(&frame), &target, &bodies.jacobian(&frame, Axes::Base));
            let h = 1e-6;
            let mut step = JointVector::zeros();
            step[joint] = h;
            let numeric = (deviation(&(q + step)) - deviation(&(q - step))) / (2.0 * h);
            prop_assert!((numeric - exact.column(joint)).amax() < 1e-6, "{numeric} {}", exact.column(joint));
        }

        #[test]
        fn the_nearest_allowed_deviation_is_allowed_and_itself_when_allowed(v in prop::array::uniform6(-1.0..1.0f64)) {
            let freedom = TaskFreedom { position_m: [0.1, 0.0, 0.3], tilt_rad: 0.5, yaw: Yaw::Fixed };
            let allowed = Deviation(v.into()).allowed(&freedom);
            prop_assert!(allowed.0[0].abs() <= 0.1 && allowed.0[1] == 0.0 && allowed.0[2].abs() <= 0.3 && allowed.0[5] == 0.0);
            prop_assert!(allowed.0.fixed_rows::<2>(3).norm() <= 0.5);
            prop_assert_eq!(allowed.allowed(&freedom), allowed);
        }
    }
}
