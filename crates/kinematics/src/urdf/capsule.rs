//! URDF knows no capsule; tools write one as a cylinder followed by the two spheres that close its ends.

use crate::geometry::{Primitive, Shape};
use nalgebra::Point3;

/// How far a sphere's centre or radius may be off the cylinder's end \[m\].
const TOLERANCE_M: f64 = 1e-9;

/// Replaces each run of cylinder, sphere, sphere that forms a capsule by that capsule.
pub(super) fn merge(primitives: Vec<Primitive>) -> Vec<Primitive> {
    let mut merged = Vec::with_capacity(primitives.len());
    let mut rest = primitives.as_slice();
    while let Some(first) = rest.first() {
        match rest.get(1..3).and_then(|ends| capsule(first, ends)) {
            Some(capsule) => {
                merged.push(capsule);
                rest = &rest[3..];
            }
            None => {
                merged.push(first.clone());
                rest = &rest[1..];
            }
        }
    }
    merged
}

fn capsule(cylinder: &Primitive, ends: &[Primitive]) -> Option<Primitive> {
    let Shape::Cylinder {
        radius_m,
        half_length_m,
    } = cylinder.shape
    else {
        return None;
    };
    let closes = |sphere: &Primitive, z: f64| {
        let end = cylinder.pose * Point3::new(0.0, 0.0, z);
        matches!(sphere.shape, Shape::Sphere { radius_m: r } if (r - radius_m).abs() <= TOLERANCE_M)
            && (sphere.pose.translation.vector - end.coords).norm() <= TOLERANCE_M
    };
    let [a, b] = ends else { return None };
    let both = |low: &Primitive, high: &Primitive| closes(low, -half_length_m) && closes(high, half_length_m);
    (both(a, b) || both(b, a)).then_some(Primitive {
        pose: cylinder.pose,
        shape: Shape::Capsule {
            radius_m,
            half_length_m,
        },
    })
}
