mod bounds;
mod half_spaces;
use crate::clearance::distance::{Separation, bracketed, separation, separation_below};
use crate::clearance::part::Part;
use crate::clearance::*;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use platewash_fixtures::{kitchen_tool, workcell};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{Frame, JointVector, RobotModel};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

fn iso() -> impl Strategy<Value = Isometry3<f64>> {
    (prop::array::uniform3(-1.0..1.0f64), prop::array::uniform3(-3.0..3.0f64))
        .prop_map(|(t, r)| Isometry3::from_parts(Translation3::from(t), UnitQuaternion::from_scaled_axis(r.into())))
}

fn part(shape: &Shape, pose: &Isometry3<f64>) -> Part {
    Part::new(shape, Frame::base().offset(&RigidTransform::from(pose))).unwrap()
}

fn gap(a: &Part, b: &Part) -> Separation {
    bounds(a, b).0
}

/// Returns the stated distance and its lower bound.
fn bounds(a: &Part, b: &Part) -> (Separation, f64) {
    static ARM: std::sync::LazyLock<RobotModel> = std::sync::LazyLock::new(|| RobotModel::irb120().unwrap());
    let poses = ARM.fk(&JointVector::zeros());
    bracketed(&a.place(&poses), &b.place(&poses))
}

fn distance(a: (&Shape, &Isometry3<f64>), b: (&Shape, &Isometry3<f64>)) -> f64 {
    gap(&part(a.0, a.1), &part(b.0, b.1)).distance
}

/// Distance of two segments by brute refinement of the convex problem in (s, t) ∈ [0, 1]².
fn segment_distance(a: [Point3<f64>; 2], b: [Point3<f64>; 2]) -> f64 {
    let at = |s: f64, t: f64| (a[0] + (a[1] - a[0]) * s - (b[0] + (b[1] - b[0]) * t)).norm();
    let best_t = |s: f64| {
        let (u, w) = (b[1] - b[0], a[0] + (a[1] - a[0]) * s - b[0]);
        let t = if u.norm_squared() > 0.0 {
            (w.dot(&u) / u.norm_squared()).clamp(0.0, 1.0)
        } else {
            0.0
        };
        at(s, t)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let (m, n) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if best_t(m) < best_t(n) { high = n } else { low = m }
    }
    best_t((low + high) / 2.0)
}

proptest! {
    #[test]
    fn capsules_are_right_to_rounding(a in iso(), b in iso(), ha in 0.0..0.3f64, hb in 0.0..0.3f64) {
        let ends = |p: &Isometry3<f64>, h: f64| [p * Point3::new(0.0, 0.0, -h), p * Point3::new(0.0, 0.0, h)];
        let (ra, rb) = (0.05, 0.08);
        let (sa, sb) = (
            Shape::Capsule { radius_m: ra, half_length_m: ha },
            Shape::Capsule { radius_m: rb, half_length_m: hb },
        );
        let expected = segment_distance(ends(&a, ha), ends(&b, hb)) - ra - rb;
        prop_assert!((distance((&sa, &a), (&sb, &b)) - expected).abs() < 1e-9);
    }

    /// Point to cylinder and to box have closed forms; the capsule goes through the iterative routine.
    #[test]
    fn solids_are_right_to_the_stated_error(a in iso(), b in iso(), h in 0.001..0.2f64) {
        let local = b.inverse() * Point3::from(a.translation.vector);
        let outside = |d: f64| d.max(0.0);
        let (r, half) = (0.145, 0.01);
        let cylinder = Shape::Cylinder { radius_m: r, half_length_m: half };
        let to_cylinder = outside(local.xy().coords.norm() - r).hypot(outside(local.z.abs() - half));
        let cuboid = Shape::Box { half_m: [0.1, 0.2, 0.05] };
        let to_box = Vector3::new(outside(local.x.abs() - 0.1), outside(local.y.abs() - 0.2), outside(local.z.abs() - 0.05)).norm();
        let hull = Shape::Hull { points: [-1.0, 1.0].iter().flat_map(|x| [-1.0, 1.0].iter().flat_map(move |y| [-1.0, 1.0]
            .iter().map(move |z| Point3::new(0.1 * x, 0.2 * y, 0.05 * z)))).collect() };
        let ball = Shape::Sphere { radius_m: 0.03 };
        for (solid, expected) in [(&cylinder, to_cylinder), (&cuboid, to_box), (&hull, to_box)] {
            let found = distance((&ball, &a), (solid, &b));
            if expected > 1e-6 {
                prop_assert!((found - (expected - 0.03)).abs() < ITERATIVE_ERROR_M, "{found} {expected}");
            } else {
                prop_assert!(found <= -0.03 + ITERATIVE_ERROR_M);
            }
        }
        // A capsule is never farther than its middle, never nearer than that less its half length, and as
        // near as its nearest sampled point.
        let capsule = Shape::Capsule { radius_m: 0.03, half_length_m: h };
        let found = distance((&capsule, &a), (&cylinder, &b));
        let sampled = (0..=2000).map(|k| {
            let z = h * (f64::from(k) / 1000.0 - 1.0);
            let p = b.inverse() * (a * Point3::new(0.0, 0.0, z));
            outside(p.xy().coords.norm() - r).hypot(outside(p.z.abs() - half))
        }).fold(f64::INFINITY, f64::min) - 0.03;
        if sampled > -0.03 + 1e-4 {
            prop_assert!(found <= sampled + ITERATIVE_ERROR_M && found >= sampled - h / 1000.0 - ITERATIVE_ERROR_M, "{found} {sampled}");
        } else {
            prop_assert!(found <= 0.0);
        }
        // Farther than asked for is infinite, or else as far as it is.
        let poses = RobotModel::irb120().unwrap().fk(&JointVector::zeros());
        for shape in [&cylinder, &cuboid, &hull] {
            let (part, other) = (part(&capsule, &a), part(shape, &b));
            let (moving, standing) = (part.place(&poses), other.place(&poses));
            let whole = separation(&moving, &standing).distance;
            for most in [1e-3, 0.1, 0.5] {
                let found = separation_below(&moving, &standing, most).distance;
                prop_assert!(found == whole || (found == f64::INFINITY && whole > most - ITERATIVE_ERROR_M), "{found} {whole}");
            }
        }
        // Solid against solid: symmetric.
        let there = distance((&cylinder, &a), (&cuboid, &b));
        let back = distance((&cuboid, &b), (&cylinder, &a));
        prop_assert!((there - back).abs() < ITERATIVE_ERROR_M);
    }

    /// The half-space trap: a box, a cylinder, a hull and a capsule over the floor, at any attitude, nearly upright and
    /// nearly lying ones included.
    #[test]
    fn heights_over_the_floor_are_closed_forms(pose in iso(), tiny in -17.0..0.0f64, lying in any::<bool>(), near in any::<bool>()) {
        let base = Vector3::new(if lying { FRAC_PI_2 } else { 0.0 }, 0.0, 0.0);
        let leaning = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -0.4, 0.1) * 10.0_f64.powf(tiny));
        let upright = Isometry3::from_parts(pose.translation, leaning * UnitQuaternion::from_scaled_axis(base));
        let high = Isometry3::translation(0.0, 0.0, 2.0) * if near { upright } else { pose };
        let axis = high.rotation * Vector3::z();
        let z = high.translation.z;
        let tilted = axis.xy().norm();
        let rotation = high.rotation.to_rotation_matrix();
        let row = rotation.matrix().row(2).abs();
        let cases = [
            (Shape::Sphere { radius_m: 0.1 }, z - 0.1),
            (Shape::Capsule { radius_m: 0.1, half_length_m: 0.3 }, z - 0.3 * axis.z.abs() - 0.1),
            (Shape::Cylinder { radius_m: 0.1, half_length_m: 0.3 }, z - 0.3 * axis.z.abs() - 0.1 * tilted),
            (Shape::Box { half_m: [0.1, 0.2, 0.3] }, z - row[0] * 0.1 - row[1] * 0.2 - row[2] * 0.3),
        ];
        for (shape, expected) in cases {
            let found = gap(&part(&shape, &high), &Part::half_space(Frame::base()));
            prop_assert!((found.distance - expected).abs() < 1e-12, "{shape:?}: {} {expected}", found.distance);
            prop_assert!(found.distance > 0.0);
        }
    }
}

/// A hull is enclosed by its support functions, however wide and low it is and in any order of its points: no distance is overstated
/// because of points that the collision library leaves out.
#[test]
fn wide_and_low_hulls_are_no_smaller_than_their_points() {
    let wide: Vec<_> = [[1e3, 1e3], [1e3, -1e3], [-1e3, 1e3], [-1e3, -1e3]]
        .map(|[x, y]| Point3::new(x, y, -0.02))
        .into_iter()
        .chain([Point3::new(0.3, 0.0, 1.5)])
        .collect();
    let corners = |z: f64| [[1.0, 0.5], [1.0, -0.5], [-1.0, 0.5], [-1.0, -0.5]].map(|[x, y]| Point3::new(x, y, z));
    let slab = |first: f64| corners(first).into_iter().chain(corners(-first)).collect::<Vec<_>>();
    let many = wide
        .iter()
        .take(4)
        .cycle()
        .take(4 * 2000)
        .chain(&wide[4..])
        .copied()
        .collect();
    // A ball 0.1 m in radius beside each: inside the pyramid, and 0.2 m over the slab.
    for (points, at, overlaps) in [
        (wide.clone(), [0.3, 0.0, 1.0], true),
        (many, [0.3, 0.0, 1.0], true),
        (slab(6.5e-4), [0.2, 0.1, 0.200_65 + 0.1], false),
        (slab(-6.5e-4), [0.2, 0.1, 0.200_65 + 0.1], false),
    ] {
        let ball = part(
            &Shape::Sphere { radius_m: 0.1 },
            &Isometry3::translation(at[0], at[1], at[2]),
        );
        let hull = part(&Shape::Hull { points }, &Isometry3::identity());
        let (found, at_least) = bounds(&ball, &hull);
        let truth = if overlaps { 0.0 } else { 0.2 };
        assert!(at_least <= truth + 1e-9, "{at_least} {found:?}");
        assert!(
            overlaps || (found.distance - truth).abs() < ITERATIVE_ERROR_M,
            "{found:?}"
        );
    }
}

#[test]
fn rejects_points_without_volume() {
    let flat = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| Point3::new(x, y, 0.3 * x - 0.2 * y));
    let line = [0.0, 1.0, 2.0, 3.0].map(|x| Point3::new(x, x, x));
    for points in [flat.to_vec(), line.to_vec(), vec![Point3::origin(); 5], Vec::new()] {
        assert!(Part::new(&Shape::Hull { points }, Frame::base()).is_err());
    }
}

/// By hand: the middle of the foot of an upright handle over the floor, and the point of the floor below it.
#[test]
fn nearest_points_lie_on_the_bodies() {
    let ball = Shape::Sphere { radius_m: 0.1 };
    let cube = Shape::Box { half_m: [0.2; 3] };
    let at = |x: f64| Isometry3::translation(x, 0.0, 0.0);
    let found = gap(&part(&ball, &at(-1.0)), &part(&cube, &at(1.0))).points();
    let expected = [[-0.9, 0.0, 0.0], [0.8, 0.0, 0.0]];
    for (found, expected) in found.iter().zip(&expected) {
        assert!(
            (Vector3::from(*found) - Vector3::from(*expected)).norm() < 1e-9,
            "{found:?}"
        );
    }
    let over_floor = gap(
        &Part::half_space(Frame::base()),
        &part(&ball, &Isometry3::translation(0.3, 0.2, 0.5)),
    )
    .points();
    assert_eq!(over_floor, [[0.3, 0.2, 0.0], [0.3, 0.2, 0.4]]);
}
