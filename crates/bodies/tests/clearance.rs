//! All pairs of bodies at one configuration: which are checked, the nearest, and bodies that are refused.

use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
use platewash_bodies::clearance::*;
use platewash_fixtures::{kitchen_plate, kitchen_tool, workcell};
use platewash_kinematics::geometry::Shape;
use platewash_kinematics::rotation::RigidTransform;
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::tool::{StraightTool, Tool};
use platewash_workcell::{Obstacle, ReducedClearance};
use proptest::prelude::*;
use std::f64::consts::FRAC_PI_2;

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
    let down = platewash_workcell::tool::tool_down(Vector3::new(0.35, 0.2, 0.029));
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

/// The foot of the arm and the sponge: GJK says 26.132691 mm here, 20.5 µm too much; coal, with a tolerance of 1e-12, says
/// 26.112177 mm.
#[test]
fn the_lower_bound_holds_where_a_routine_stops_early() {
    let q = JointVector::new(
        1.593_112_175_223_078,
        1.478_442_351_519_066,
        1.382_639_459_392_275_5,
        -2.156_235_624_290_608,
        0.885_721_003_752_353_7,
        3.406_765_432_488_944_7,
    );
    let (model, least) = (model(), 0.026_112_176_97);
    let pair = model
        .pair_names()
        .iter()
        .position(|pair| *pair == ("base_link", "sponge"))
        .unwrap();
    let poses = RobotModel::irb120().unwrap().fk(&q);
    let measured: Vec<_> = model
        .parts_of(pair)
        .parts()
        .map(|parts| parts.measure(&parts.mover(&poses)))
        .collect();
    let at_least = measured.iter().map(|m| m.at_least_m).fold(f64::INFINITY, f64::min);
    assert!(
        at_least <= least + 1e-9 && at_least > least - ITERATIVE_ERROR_M - 1e-8,
        "{at_least}"
    );
    let stated = model.all(&q)[pair].distance_m;
    assert!((stated - least).abs() < ITERATIVE_ERROR_M, "{stated}");
}

/// The body that joint 1 turns keeps its height over a floor and under a ceiling, but not beside a wall.
#[test]
fn joint_1_keeps_heights_over_level_planes_alone() {
    let robot = RobotModel::irb120().unwrap();
    let tilts = [0.0, std::f64::consts::PI, FRAC_PI_2, 1e-3];
    let kept = tilts.map(|tilt| {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(tilt, 0.0, 0.0));
        let plane = Obstacle {
            pose: Isometry3::from_parts(Translation3::new(0.0, 0.0, 2.0 * tilt), turn),
            ..Obstacle::floor()
        };
        let left_out = exclusions(&robot, &kitchen_tool(), &[plane]).unwrap();
        left_out
            .iter()
            .any(|e| e.pair == ["link_1", "floor"].map(str::to_owned))
    });
    assert_eq!(kept, [true, true, false, false]);
}
