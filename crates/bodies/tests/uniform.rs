//! Volume, centre and inertia of shapes, against sums over their points.

use nalgebra::{Matrix3, Point3, Vector3};
use platewash_bodies::uniform::UniformBody;
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::{Pose, trig};
use proptest::prelude::*;
use std::f64::consts::PI;

/// Test that a point at ρ and z lies in a shape of some radius and half length.
type InsideTest = fn(f64, f64, f64, f64) -> bool;

/// Returns the hull of a prism along z over a regular polygon.
fn prism(sides: usize, radius: f64, half: f64) -> Shape {
    let corner = |k: usize| {
        let (s, c) = trig::sin_cos(2.0 * PI * (k % sides) as f64 / sides as f64);
        Point3::new(radius * c, radius * s, if k < sides { -half } else { half })
    };
    let points = (0..2 * sides).map(corner).collect();
    Shape::Hull { points }
}

fn are_close(a: &UniformBody, b: &UniformBody, part: f64) -> bool {
    let size = b.inertia_m5.norm();
    (a.volume_m3 - b.volume_m3).abs() <= part * b.volume_m3
        && (a.centre_m - b.centre_m).norm() <= part * b.volume_m3.cbrt()
        && (a.inertia_m5 - b.inertia_m5).norm() <= part * size
}

proptest! {
    /// The hull of a box's corners equals the box, at any position and rotation.
    #[test]
    fn a_hull_of_corners_is_its_box(half in prop::array::uniform3(0.01..0.3f64), at in prop::array::uniform3(-1.0..1.0f64), turn in prop::array::uniform3(-3.0..3.0f64)) {
        let pose = Pose::new(Vector3::from(at), Vector3::from(turn));
        let sign = |k: usize, bit: usize| if k >> bit & 1 == 0 { -1.0 } else { 1.0 };
        let corner = |k: usize| pose * Point3::new(sign(k, 0) * half[0], sign(k, 1) * half[1], sign(k, 2) * half[2]);
        let points = (0..8).map(corner).collect();
        let hull = UniformBody::from_shape(&Shape::Hull { points }).unwrap();
        let expected = UniformBody::from_shape(&Shape::Box { half_m: half }).unwrap().placed(&pose);
        prop_assert!(are_close(&hull, &expected, 1e-9), "{hull:?} {expected:?}");
    }

    /// Sums over a fine grid of points.
    #[test]
    fn shapes_are_the_sums_over_their_points(r in 0.02..0.1f64, h in 0.01..0.2f64, which in 0..3usize) {
        let (shape, inside): (_, InsideTest) = match which {
            0 => (Shape::Cylinder { radius_m: r, half_length_m: h }, |rho, z, r, h| rho < r && z.abs() < h),
            1 => (Shape::Capsule { radius_m: r, half_length_m: h }, |rho, z, r, h| rho.hypot((z.abs() - h).max(0.0)) < r),
            _ => (Shape::Sphere { radius_m: r }, |rho, z, r, _| rho.hypot(z) < r),
        };
        // Rings about z: midpoints of ρ and z.
        let (n, top) = (400, if which == 0 { h } else { h + r });
        let (mut volume, mut along, mut across) = (0.0, 0.0, 0.0);
        for i in 0..n {
            let rho = r * (i as f64 + 0.5) / n as f64;
            for k in 0..n {
                let z = top * (2.0 * (k as f64 + 0.5) / n as f64 - 1.0);
                if inside(rho, z, r, h) {
                    let ring = 2.0 * PI * rho * (r / n as f64) * (2.0 * top / n as f64);
                    volume += ring;
                    along += ring * rho * rho;
                    across += ring * (0.5 * rho * rho + z * z);
                }
            }
        }
        let inertia_m5 = Matrix3::from_diagonal(&Vector3::new(across, across, along));
            let expected = UniformBody { volume_m3: volume, centre_m: Vector3::zeros(), inertia_m5 };
        let found = UniformBody::from_shape(&shape).unwrap();
        prop_assert!(are_close(&found, &expected, 0.01), "{found:?} {expected:?}");
    }
}

#[test]
fn a_prism_of_many_sides_is_a_cylinder() {
    let cylinder = Shape::Cylinder {
        radius_m: 0.02,
        half_length_m: 0.07,
    };
    let [hull, round] = [prism(400, 0.02, 0.07), cylinder].map(|shape| UniformBody::from_shape(&shape).unwrap());
    assert!(are_close(&hull, &round, 1e-3), "{hull:?} {round:?}");
}

#[test]
fn rejects_bodies_without_volume() {
    let flat = (0..9)
        .map(|k| Point3::new(f64::from(k % 3), f64::from(k / 3), 0.0))
        .collect();
    let shapes = [
        Shape::Hull { points: flat },
        Shape::Hull { points: Vec::new() },
        Shape::Box {
            half_m: [1.0, 0.0, 1.0],
        },
        Shape::Sphere { radius_m: f64::NAN },
        Shape::Sphere {
            radius_m: f64::INFINITY,
        },
    ];
    for shape in shapes {
        assert_eq!(UniformBody::from_shape(&shape), None, "{shape:?}");
    }
}
