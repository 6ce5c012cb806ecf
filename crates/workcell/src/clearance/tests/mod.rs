mod bounds;
mod half_spaces;
mod many_parts;

use crate::clearance::distance::{Separation, bracketed, separation, separation_below};
use crate::clearance::part::Part;
use crate::clearance::*;
use crate::fixtures::{kitchen_plate, kitchen_tool, workcell};
use crate::tool::{StraightTool, Tool};
use crate::workcell::ReducedClearance;
use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
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

/// A pair that must keep less than all others, and the pairs that cannot.
#[test]
fn a_reduced_clearance_counts_for_its_pair_alone() {
    let robot = RobotModel::irb120().unwrap();
    let plates = [kitchen_plate([0.3, 0.1])];
    let q = JointVector::from([0.0, 0.0, 0.0, 0.0, FRAC_PI_2, 0.0]);
    let model = |pairs: &[[&str; 2]], by_m: f64| {
        let mut world = workcell(&robot, kitchen_tool());
        let reduced = |pair: &[&str; 2]| ReducedClearance {
            pair: pair.map(str::to_owned),
            by_m,
            at_stop: false,
        };
        world.reduced_clearances = pairs.iter().map(reduced).collect();
        ClearanceModel::new(&robot, &world, &plates)
    };
    let plain = model(&[], 0.0).unwrap();
    let near = plain.smallest(&q, &[]).unwrap();
    let (pair, own_m) = ([&*near.a, &*near.b], near.distance_m);
    let next_m = plain.too_near(&q, &[], 1.0)[1].distance_m;
    assert!(next_m > own_m + 2e-3, "{own_m} {next_m}");
    let reduced = model(&[[pair[1], pair[0]]], 2e-3).unwrap();
    for (required_m, kept) in [(own_m + 1.9e-3, true), (own_m + 2.1e-3, false)] {
        assert_eq!(reduced.keeps_clearance(&q, required_m), kept);
        assert_eq!(reduced.too_near(&q, &[], required_m).is_empty(), kept);
        assert_eq!(reduced.nearest_washing(&q, 0, required_m).is_none(), kept);
        assert!(!plain.keeps_clearance(&q, required_m));
    }
    assert_eq!(reduced.smallest(&q, &[]).unwrap().reduced_by_m, 2e-3);
    // Most of the requirement may be waived, contact never.
    assert!(!reduced.keeps_clearance(&q, next_m + 1e-3));
    assert_eq!(reduced.nearest(&q, &[]).unwrap().distance_m, next_m);
    for (pairs, words) in [
        (
            vec![["handle", "floor"]],
            "one of them is not a body of the arm or its tool",
        ),
        (
            vec![["link_3", "plate 1"]],
            "one of them is not a body of the arm or its tool",
        ),
        (
            vec![["link_3", "elbow"]],
            "one of them is not a body of the arm or its tool",
        ),
        (vec![["link_3", "link_4"]], "the pair is not checked"),
        (vec![pair, [pair[1], pair[0]]], "it is stated twice"),
    ] {
        let said = model(&pairs, 2e-3).unwrap_err().to_string();
        assert!(said.contains(words), "{said}");
    }
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

    #[test]
    fn the_nearest_pair_has_the_least_distance(q in prop::array::uniform6(-1.5..1.5f64)) {
        let model = model();
        let q = JointVector::from(q);
        let least = model.all(&q).into_iter().min_by(|x, y| x.distance_m.total_cmp(&y.distance_m)).unwrap();
        let found = model.smallest(&q, &[]).unwrap();
        prop_assert!((found.distance_m - least.distance_m).abs() < 1e-12, "{found:?} {least:?}");
        // Every pair nearer than a margin is found, and no other.
        let near = model.too_near(&q, &[], 0.08);
        let expected = model.all(&q).into_iter().filter(|p| p.distance_m < 0.08).count();
        prop_assert_eq!(near.len(), expected);
        prop_assert!(near.first().is_none_or(|p| (p.distance_m - found.distance_m).abs() < 1e-12));
    }
}

fn model() -> ClearanceModel {
    let robot = RobotModel::irb120().unwrap();
    let plates = [[0.3, -0.2], [0.3, 0.2]].map(kitchen_plate);
    ClearanceModel::new(&robot, &workcell(&robot, kitchen_tool()), &plates).unwrap()
}

fn bare(robot: &RobotModel) -> ClearanceModel {
    let tool = Tool::from(StraightTool::default());
    ClearanceModel::new(robot, &workcell(robot, tool), &[]).unwrap()
}

#[test]
fn the_irb_120_checks_the_eight_self_pairs() {
    let bare = bare(&RobotModel::irb120().unwrap());
    let pairs = bare.pair_names();
    let own: Vec<_> = pairs
        .iter()
        .filter(|(_, b)| *b != "floor")
        .map(|(a, b)| format!("{a}-{b}"))
        .collect();
    let expected = [(0, 3), (0, 4), (0, 5), (0, 6), (1, 3), (1, 4), (1, 5), (1, 6)].map(|(a, b)| {
        format!(
            "{}-link_{b}",
            if a == 0 {
                "base_link".to_owned()
            } else {
                format!("link_{a}")
            }
        )
    });
    assert_eq!(own, expected);
    let floor: Vec<_> = pairs.iter().filter(|(_, b)| *b == "floor").map(|(a, _)| *a).collect();
    assert_eq!(
        floor,
        ["link_2", "link_3", "link_4", "link_5", "link_6"],
        "link_1 keeps its height"
    );
}

#[test]
fn without_a_list_neighbours_and_pairs_that_always_touch_are_left_out() {
    let robot = RobotModel::from_urdf(
        platewash_kinematics::irb120::IRB120_URDF,
        &platewash_kinematics::urdf::MeshSource::none(),
    );
    let model = bare(&robot.unwrap());
    let pairs = model.pair_names();
    assert!(!pairs.contains(&("link_4", "link_6")), "these shapes always overlap");
    assert!(!pairs.contains(&("link_2", "link_3")), "neighbours");
    assert!(pairs.contains(&("base_link", "link_4")));
}

/// By hand: at q = 0 with a 150 mm tool the tool lies along +x at z = 0.63 m.
#[test]
fn known_distances_at_the_home_position() {
    let all = model().all(&JointVector::zeros());
    let of = |a: &str, b: &str| all.iter().find(|p| p.a == a && p.b == b).unwrap().distance_m;
    assert!((of("handle", "floor") - (0.63 - 0.02)).abs() < 1e-12);
    assert!((of("sponge", "floor") - (0.63 - 0.025)).abs() < 1e-12);
    assert!((of("link_6", "floor") - (0.63 - 0.0255)).abs() < 1e-12);
    let to_plate = model()
        .all(&JointVector::zeros())
        .into_iter()
        .filter(|p| p.b.starts_with("plate"))
        .count();
    assert_eq!(
        to_plate,
        2 * (6 + 2),
        "six moving links, handle and sponge against each plate"
    );
}

#[test]
fn ignores_contact_of_the_sponge_with_its_plate() {
    let model = model();
    // Tool straight down over plate 2 with the sponge on its surface: found by the place of contact alone.
    let robot = RobotModel::irb120().unwrap();
    let tip = robot.tool_mount(None).unwrap().offset(&RigidTransform {
        translation: Vector3::new(0.0, 0.0, 0.15),
        ..RigidTransform::identity()
    });
    let solver = platewash_kinematics::ik::IkSolver::new(&robot, tip, Default::default()).unwrap();
    let down = crate::tool::tool_down(Vector3::new(0.35, 0.2, 0.029));
    let q = solver
        .solve(&down, &JointVector::new(0.5, 0.3, 0.2, 0.0, 1.0, 0.0))
        .unwrap()
        .q;
    let touching = model.smallest(&q, &[]).unwrap();
    assert_eq!((touching.a.as_str(), touching.b.as_str()), ("sponge", "plate 2"));
    assert!(touching.distance_m <= 0.0);
    assert!(model.smallest(&q, &[1]).unwrap().distance_m > 0.0);
    assert!(model.smallest(&q, &[0]).unwrap().distance_m <= 0.0);
}

#[test]
fn nan_is_never_a_distance_of_zero() {
    let q = JointVector::repeat(f64::NAN);
    assert!(model().all(&q).iter().all(|p| p.distance_m.is_nan()));
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

#[test]
fn a_flat_hull_is_refused_by_the_name_of_its_body() {
    let robot = RobotModel::irb120().unwrap();
    let flat = Shape::Hull {
        points: vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(2.0, 0.0, 0.0)],
    };
    let mut cell = workcell(&robot, kitchen_tool());
    cell.tool.bodies[0].name = "hand\nle".to_owned();
    cell.tool.bodies[0].shape = flat;
    let refused = ClearanceModel::new(&robot, &cell, &[]).unwrap_err().to_string();
    assert_eq!(
        refused,
        r"body 'hand\nle': its hull is flat; a convex hull needs a volume"
    );
}

/// Points on a ball, evenly spread: all are corners of their hull.
fn ball(count: usize) -> Shape {
    let turn = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let point = |k: usize| {
        let z = 1.0 - (2 * k + 1) as f64 / count as f64;
        let (sine, cosine) = platewash_kinematics::trig::sin_cos(turn * k as f64);
        0.05 * (1.0 - z * z).sqrt() * Point3::new(cosine, sine, 0.0) + 0.05 * Vector3::z() * z
    };
    Shape::Hull {
        points: (0..count).map(point).collect(),
    }
}

#[test]
fn a_hull_of_too_many_corners_is_refused_by_name() {
    let robot = RobotModel::irb120().unwrap();
    let mut cell = workcell(&robot, kitchen_tool());
    cell.tool.bodies[0].shape = ball(10_001);
    let refused = ClearanceModel::new(&robot, &cell, &[]).unwrap_err();
    let words =
        "body 'handle': its convex hull has 10001 corners; at most 10000 can be judged: simplify its collision mesh";
    assert_eq!(refused.to_string(), words);
    cell.tool.bodies[0].shape = ball(50_001);
    let refused = ClearanceModel::new(&robot, &cell, &[]).unwrap_err();
    let words = "body 'handle': its collision mesh has 50001 vertices; at most 50000 can be judged: simplify it";
    assert_eq!(refused.to_string(), words);
    // Vertices within the hull are no corners.
    let Shape::Hull { mut points } = ball(2000) else {
        unreachable!()
    };
    points.extend((0..9000).map(|k| Point3::new(1e-6 * f64::from(k), 0.0, 0.0)));
    cell.tool.bodies[0].shape = Shape::Hull { points };
    assert!(ClearanceModel::new(&robot, &cell, &[]).is_ok());
}

proptest! {
    /// The two nearest points are as far apart as the smallest distance, and half-way between them is its place.
    #[test]
    fn nearest_points_are_those_of_the_smallest_distance(q in prop::array::uniform6(-1.5..1.5f64), plate in 0..2usize) {
        let robot = RobotModel::irb120().unwrap();
        let plates = [kitchen_plate([0.3, 0.1]), kitchen_plate([-0.1, 0.35])];
        let model = ClearanceModel::new(&robot, &workcell(&robot, kitchen_tool()), &plates).unwrap();
        let q = JointVector::from(q);
        for working in [&[][..], &[plate]] {
            let (smallest, nearest) = (model.smallest(&q, working).unwrap(), model.nearest(&q, working).unwrap());
            prop_assert_eq!(nearest.distance_m, smallest.distance_m);
            let names = model.body_names();
            prop_assert_eq!(nearest.bodies.map(|body| names[body]), [smallest.a.as_str(), smallest.b.as_str()]);
            let [a, b] = nearest.points_m.map(Vector3::from);
            prop_assert!(((a + b) / 2.0 - Vector3::from(smallest.place_m)).norm() < 1e-12);
            if smallest.distance_m > 0.0 {
                prop_assert!(((b - a).norm() - smallest.distance_m).abs() < 1e-9, "{} {}", (b - a).norm(), smallest.distance_m);
            }
        }
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
