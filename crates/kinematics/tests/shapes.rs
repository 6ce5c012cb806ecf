//! Shapes: how far they reach in a direction.

use nalgebra::{Point3, Vector3};
use platewash_kinematics::geometry::Shape;
use std::f64::consts::FRAC_1_SQRT_2;

#[test]
fn support_points_agree_with_hand_calculation() {
    let diagonal = Vector3::new(FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2);
    let cases = [
        (
            Shape::Box {
                half_m: [1.0, 2.0, 3.0],
            },
            4.0 * FRAC_1_SQRT_2,
        ),
        (
            Shape::Cylinder {
                radius_m: 1.0,
                half_length_m: 3.0,
            },
            4.0 * FRAC_1_SQRT_2,
        ),
        (Shape::Sphere { radius_m: 1.0 }, 1.0),
        (
            Shape::Capsule {
                radius_m: 1.0,
                half_length_m: 3.0,
            },
            3.0 * FRAC_1_SQRT_2 + 1.0,
        ),
        (
            Shape::Hull {
                points: vec![Point3::origin(), Point3::new(2.0, 5.0, 2.0)],
            },
            4.0 * FRAC_1_SQRT_2,
        ),
    ];
    for (shape, expected) in cases {
        assert!((shape.support(&diagonal) - expected).abs() < 1e-15, "{shape:?}");
    }
}
