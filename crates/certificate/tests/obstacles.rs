//! Obstacles of every kind around a plan: what is proved of pairs is never more than what is found at any moment, whether they were dismissed many at
//! once or looked at one by one.

use crate::maker::{good, irb120, resealed};
use nalgebra::{Point3, UnitQuaternion, Vector3};
use platewash_bodies::clearance::{ClearanceModel, exclusions};
use platewash_certificate::{Requirement, Status, prove};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use platewash_motion::plan::Plan;
use platewash_workcell::job::Overlap;
use platewash_workcell::{Obstacle, ObstacleShape};
use proptest::prelude::*;

/// The good plan among some more obstacles.
fn among(obstacles: Vec<Obstacle>) -> Plan {
    let mut plan = good();
    let world = &mut plan.job.workcell;
    world.obstacles.extend(obstacles);
    world.exclusions = exclusions(&irb120(), &world.tool, &world.obstacles).unwrap();
    resealed(plan)
}

fn corners([x, y, z]: [f64; 3], from: f64) -> Vec<Point3<f64>> {
    let sign = |k: usize, bit: usize| if k >> bit & 1 == 1 { 1.0 } else { -1.0 };
    (0..8)
        .map(|k| Point3::new(from + sign(k, 0) * x, sign(k, 1) * y, sign(k, 2) * z))
        .collect()
}

fn obstacle() -> impl Strategy<Value = Obstacle> {
    let size = || 0.02..0.1f64;
    let round = |(radius_m, half_length_m): (f64, f64)| (radius_m, half_length_m);
    let shape = prop_oneof![
        prop::array::uniform3(size()).prop_map(|half_m| ObstacleShape::Convex(Shape::Box { half_m })),
        (size(), size()).prop_map(round).prop_map(|(radius_m, half_length_m)| {
            ObstacleShape::Convex(Shape::Cylinder {
                radius_m,
                half_length_m,
            })
        }),
        (size(), size()).prop_map(round).prop_map(|(radius_m, half_length_m)| {
            ObstacleShape::Convex(Shape::Capsule {
                radius_m,
                half_length_m,
            })
        }),
        size().prop_map(|radius_m| ObstacleShape::Convex(Shape::Sphere { radius_m })),
        prop::array::uniform3(size()).prop_map(|half_m| {
            let points = corners(half_m, 0.0);
            ObstacleShape::Convex(Shape::Hull { points })
        }),
        prop::array::uniform3(size())
            .prop_map(|half_m| ObstacleShape::Parts(vec![corners(half_m, -0.1), corners(half_m, 0.15)])),
        Just(ObstacleShape::HalfSpace),
    ];
    let turn = prop::array::uniform3(-3.0..3.0f64);
    (shape, 0.0..6.3f64, 0.3..0.9f64, 0.05..0.7f64, turn, 0.0..0.02f64).prop_map(
        |(shape, azimuth, out, up, turn, margin_m)| {
            let at = Vector3::new(out * azimuth.cos(), out * azimuth.sin(), up);
            let plane = shape == ObstacleShape::HalfSpace;
            // A wall that faces the arm, a body at any attitude.
            let inwards = UnitQuaternion::rotation_between(&Vector3::z(), &-at).unwrap_or_default();
            let free = UnitQuaternion::from_scaled_axis(turn.into());
            let pose = Pose::from_parts(at.into(), if plane { inwards } else { free });
            let obstacle = Obstacle::new("", shape, pose);
            Obstacle { margin_m, ..obstacle }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..ProptestConfig::default() })]
    #[test]
    fn no_sample_of_a_pair_is_nearer_than_the_proved_clearance(obstacles in prop::collection::vec(obstacle(), 1..12)) {
        let named = obstacles.into_iter().enumerate();
        let named = named.map(|(k, obstacle)| Obstacle { name: format!("body {k}"), ..obstacle });
        let plan = among(named.collect());
        let robot = irb120();
        let certificate = prove(&plan, &robot).unwrap();
        let model = ClearanceModel::new(&robot, &plan.job.workcell, &plan.job.plates).unwrap();
        let motion = plan.knots.motion().unwrap();
        let pairs = model.pair_names();
        let mut least = vec![f64::INFINITY; pairs.len()];
        for t in plan.knots.t_s.iter().step_by(5) {
            let found = model.all(&motion.at(*t).unwrap().q);
            for (least, found) in least.iter_mut().zip(found) {
                *least = least.min(found.distance_m);
            }
        }
        let mut seen = 0;
        for ((a, b), least) in pairs.iter().zip(least).filter(|((_, b), _)| b.starts_with("body")) {
            let line = certificate.clearance.iter().find(|line| line.pair == [*a, *b]).unwrap();
            let at_least = line.at_least_m.unwrap_or(f64::NEG_INFINITY);
            prop_assert!(at_least <= least + 1e-8, "{line:?}, found {least}");
            prop_assert!(least >= 0.01 || line.status != Status::Proved, "{line:?}, found {least}");
            // Far obstacles need no exact distance.
            prop_assert!(least < 0.2 || at_least > 0.03, "{line:?}, found {least}");
            seen += 1;
        }
        prop_assert!(seen >= 7);
    }
}

/// Whatever is waived of plates that overlap: what stands in one is refused.
#[test]
fn an_obstacle_in_a_plate_breaks_plates_apart() {
    let plate = good().job.plates[0].pose.translation.vector;
    let shape = ObstacleShape::Convex(Shape::Sphere { radius_m: 0.01 });
    let stone = Obstacle::new("stone", shape, Pose::translation(plate.x, plate.y, plate.z - 0.01));
    for overlap in [Overlap::Fail, Overlap::Report] {
        let mut plan = among(vec![stone.clone()]);
        plan.job.requirements.overlap = overlap;
        let certificate = prove(&resealed(plan), &irb120()).unwrap();
        let check = certificate.check(Requirement::PlatesApart).unwrap();
        assert_eq!(check.status, Status::Violated);
        let said = format!("{:?}", check.discrepancies);
        assert!(said.contains("stone") && said.contains("plate 1"), "{said}");
    }
    let mut held = stone;
    held.holds_plates = vec![0];
    let certificate = prove(&among(vec![held]), &irb120()).unwrap();
    assert_eq!(
        certificate.check(Requirement::PlatesApart).unwrap().status,
        Status::Proved
    );
}
