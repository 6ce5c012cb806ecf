//! Bounds of distances between solids, against alternating projections: a method that shares nothing with the code under test.

use crate::clearance::tests::*;

/// The point of a solid nearest to another point, in closed form.
fn projected(shape: &Shape, pose: &Isometry3<f64>, point: &Point3<f64>) -> Point3<f64> {
    let p = pose.inverse_transform_point(point);
    let nearest = match shape {
        Shape::Box { half_m: [x, y, z] } => Point3::new(p.x.clamp(-x, *x), p.y.clamp(-y, *y), p.z.clamp(-z, *z)),
        Shape::Cylinder {
            radius_m,
            half_length_m,
        } => {
            let out = p.xy().coords.norm();
            let share = if out > *radius_m { radius_m / out } else { 1.0 };
            Point3::new(p.x * share, p.y * share, p.z.clamp(-half_length_m, *half_length_m))
        }
        _ => unreachable!("no projection"),
    };
    pose * nearest
}

/// Returns the distance between a point of one solid and one of the other, which approaches the least distance from above (von Neumann;
/// Cheney & Goldstein, Proc. AMS 10, 1959), and true once it has settled.
fn alternating(a: (&Shape, &Isometry3<f64>), b: (&Shape, &Isometry3<f64>)) -> (f64, bool) {
    let mut here = Point3::from(a.1.translation.vector);
    let mut last = f64::INFINITY;
    for _ in 0..3000 {
        let there = projected(b.0, b.1, &here);
        here = projected(a.0, a.1, &there);
        let found = (here - there).norm();
        if last - found < 1e-13 {
            return (found, true);
        }
        last = found;
    }
    (last, false)
}

fn claims(a: (&Shape, &Isometry3<f64>), b: (&Shape, &Isometry3<f64>)) -> (f64, f64) {
    let (found, at_least) = bounds(&part(a.0, a.1), &part(b.0, b.1));
    (found.distance, at_least)
}

fn cylinder(radius_m: f64, half_length_m: f64) -> Shape {
    Shape::Cylinder {
        radius_m,
        half_length_m,
    }
}

/// Checks that the lower bound is no more than the distance, the stated distance no less, and both as near as promised.
#[track_caller]
fn hold(a: (&Shape, &Isometry3<f64>), b: (&Shape, &Isometry3<f64>)) {
    let (stated, at_least) = claims(a, b);
    let (nearby, settled) = alternating(a, b);
    assert!(
        at_least <= nearby + 1e-9,
        "{at_least} claimed, {nearby} found: {a:?} {b:?}"
    );
    if nearby > 1e-3 {
        assert!(
            stated - at_least <= ITERATIVE_ERROR_M + 1e-12,
            "{at_least} {stated}: {a:?} {b:?}"
        );
        assert!(!settled || stated >= nearby - 1e-9, "{stated} {nearby}: {a:?} {b:?}");
    }
}

proptest! {
    /// Handles and sponges of any thickness, down to a tenth of a millimetre, over boxes and cylinders.
    #[test]
    fn the_lower_bound_never_exceeds_the_distance(
        a in iso(), b in iso(), size in prop::array::uniform3(0.01..0.2f64), thin in -4.0..-1.0f64, long in 0.5..20.0f64, boxed in any::<bool>(),
    ) {
        let [x, y, z] = size;
        let there = if boxed { Shape::Box { half_m: size } } else { cylinder(x.max(y), z) };
        let radius = 10f64.powf(thin);
        let tool = cylinder(radius, (long * radius).min(0.1));
        hold((&there, &a), (&tool, &b));
        hold((&tool, &b), (&there, &a));
    }
}
