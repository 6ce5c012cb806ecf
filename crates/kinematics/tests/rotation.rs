//! Rotations, their logarithm, and rigid transforms.

use nalgebra::{Matrix3, Rotation3, Vector3};
use platewash_kinematics::rotation::*;
use proptest::prelude::*;
use std::f64::consts::PI;

fn exp(v: Vector3<f64>) -> Matrix3<f64> {
    *Rotation3::from_scaled_axis(v).matrix()
}

proptest! {
    #[test]
    fn logarithm_inverts_the_exponential(x in -1.0..1.0f64, y in -1.0..1.0f64, z in -1.0..1.0f64, angle in 0.0..PI) {
        let v = Vector3::new(x, y, z);
        prop_assume!(v.norm() > 1e-3);
        let v = v.normalize() * angle;
        prop_assert!((rotation_vector(&exp(v)) - v).norm() < 1e-13, "{v:?}");
    }

    #[test]
    fn inverse_undoes(r in -3.0..3.0f64, p in -3.0..3.0f64, y in -3.0..3.0f64, t in -2.0..2.0f64) {
        let a = RigidTransform { rotation: from_rpy([r, p, y]), translation: Vector3::new(t, -t, 0.3) };
        let one = a.then(&a.inverse());
        prop_assert!((one.rotation - Matrix3::identity()).norm() < 1e-14);
        prop_assert!(one.translation.norm() < 1e-14);
    }
}

#[test]
fn logarithm_at_zero_tiny_and_near_pi() {
    assert_eq!(rotation_vector(&Matrix3::identity()), Vector3::zeros());
    let axes = [
        Vector3::x(),
        Vector3::y(),
        -Vector3::z(),
        Vector3::new(1.0, -2.0, 0.5).normalize(),
        Vector3::new(-1e-9, 1.0, 1e-9).normalize(),
    ];
    for axis in axes {
        for angle in [1e-12, 1e-8, 1e-4, 1.0, 3.0, PI - 1e-4, PI - 1e-8] {
            let v = axis * angle;
            assert!(
                (rotation_vector(&exp(v)) - v).norm() < 1e-14 + 1e-14 * angle,
                "{axis:?} {angle}"
            );
        }
        // At π exactly both signs of the axis are right.
        let found = rotation_vector(&exp(axis * PI));
        assert!((found.norm() - PI).abs() < 1e-14);
        assert!((found.normalize().dot(&axis).abs() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn rpy_turns_about_fixed_axes_in_the_order_x_y_z() {
    let by_hand = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.3)
        * Rotation3::from_axis_angle(&Vector3::y_axis(), -0.7)
        * Rotation3::from_axis_angle(&Vector3::x_axis(), 1.9);
    assert!((from_rpy([1.9, -0.7, 0.3]) - by_hand.matrix()).norm() < 1e-15);
}
