//! Plates of many parts, against the same parts as separate obstacles that are examined one by one.

use platewash_bodies::clearance::part_pair::PartPairs;
use platewash_bodies::clearance::{ClearanceModel, ITERATIVE_ERROR_M, is_clear};
use platewash_fixtures::{kitchen_tool, workcell};
use platewash_kinematics::{JointVector, Pose, RobotModel};
use platewash_workcell::plate::{Foot, Plate, PlateTerms};
use platewash_workcell::surface::{SHIPPED_PROFILES, Surface};
use platewash_workcell::words::plate_name;
use platewash_workcell::{Obstacle, ObstacleShape, Workcell};
use proptest::prelude::*;

fn plates(kind: usize, z: f64) -> [Plate; 2] {
    [[0.42, 0.12], [0.1, -0.4]].map(|[x, y]| Plate {
        surface: Surface::shipped(SHIPPED_PROFILES[kind]).unwrap(),
        thickness_m: 0.0045,
        foot: Some(Foot {
            radius_m: 0.05,
            height_m: 0.006,
        }),
        pose: Pose::translation(x, y, z),
        terms: PlateTerms::default(),
    })
}

/// Returns the world of a plate whose parts are obstacles.
fn in_pieces(world: &Workcell, plate: &Plate) -> Workcell {
    let pieces = plate
        .bodies()
        .into_iter()
        .enumerate()
        .map(|(i, (shape, pose))| Obstacle::new(&format!("piece {i}"), ObstacleShape::Convex(shape), pose));
    Workcell {
        obstacles: pieces.collect(),
        ..world.clone()
    }
}

/// Returns the least distance of one body to a plate, part by part.
fn least(pieces: &ClearanceModel, name: &str, q: &JointVector) -> f64 {
    let all = pieces.all(q);
    let of = all.iter().filter(|pair| pair.a == name && pair.b.starts_with("piece"));
    of.map(|pair| pair.distance_m).fold(f64::INFINITY, f64::min)
}

fn near() -> impl Strategy<Value = JointVector> {
    // Over the plates, low: the tool close to them or in them.
    let lows = [-1.4, 0.3, 0.0, -0.6, 0.4, -1.0];
    let highs = [0.5, 1.3, 0.8, 0.6, 1.5, 1.0];
    prop::array::uniform6(0.0..1.0f64)
        .prop_map(move |u| JointVector::from_fn(|i, _| lows[i] + (highs[i] - lows[i]) * u[i]))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn the_distance_of_many_parts_is_the_least_of_theirs(q in near(), kind in 0..4usize, z in 0.03..0.2f64, required in 0.0..0.05f64) {
        let robot = RobotModel::irb120().unwrap();
        let world = workcell(&robot, kitchen_tool());
        let plates = plates(kind, z);
        let model = ClearanceModel::new(&robot, &world, &plates).unwrap();
        let all = model.all(&q);
        let pieces = plates.map(|plate| ClearanceModel::new(&robot, &in_pieces(&world, &plate), &[]).unwrap());
        let poses = robot.fk(&q);
        let mut keeps = [true; 2];
        for (pair, found) in all.iter().enumerate() {
            let plate = (0..2).find(|i| found.b == plate_name(*i));
            let Some(plate) = plate else {
                let clear = is_clear(found.distance_m, required);
                keeps = keeps.map(|k| k && clear);
                continue;
            };
            let expected = least(&pieces[plate], &found.a, &q);
            let overlap = expected <= 0.0 && found.distance_m <= 0.0;
            prop_assert!(overlap || (expected - found.distance_m).abs() <= 2.0 * ITERATIVE_ERROR_M, "{found:?}: {expected}");
            keeps[0] &= is_clear(expected, required);
            keeps[1] &= found.a == "sponge" || is_clear(expected, required);
            // From the outside in, no shape is farther than what it holds.
            let pairs = model.parts_of(pair);
            let of_parts = pairs.parts().map(|pair| pair.measure(&pair.mover(&poses)).distance_m).fold(f64::INFINITY, f64::min);
            prop_assert!(overlap || (of_parts - found.distance_m).abs() <= 2.0 * ITERATIVE_ERROR_M);
            holds(&pairs, &poses)?;
        }
        // Where it is not a matter of rounding.
        if all.iter().all(|pair| (pair.distance_m - required).abs() > 1e-4 && pair.distance_m.abs() > 1e-4) {
            prop_assert_eq!(model.keeps_clearance(&q, required), keeps[0]);
            let keeps_washing = |required| model.levels_kept(&q, Some(0), &[required]) == 1;
            prop_assert_eq!(keeps_washing(required), keeps[1]);
            let levels = [required, required + 8e-3, required + 0.1];
            let kept = levels.iter().take_while(|level| keeps_washing(**level)).count();
            prop_assert_eq!(model.levels_kept(&q, Some(0), &levels), kept);
            let near: Vec<_> = all.iter().filter(|pair| !is_clear(pair.distance_m, required)).collect();
            let too_near = model.too_near(&q, &[], required);
            prop_assert_eq!(too_near.len(), near.len());
            prop_assert_eq!(model.nearest_washing(&q, 0, required).is_none(), keeps[1]);
        }
        let smallest = model.smallest(&q, &[]).unwrap().distance_m;
        let expected = all.iter().map(|pair| pair.distance_m).fold(f64::INFINITY, f64::min);
        prop_assert!((smallest - expected).abs() <= 2.0 * ITERATIVE_ERROR_M || smallest <= 0.0 && expected <= 0.0);
    }
}

/// No pair claims more than the distance of any pair of parts that it holds, and every pair is held by an outermost one.
fn holds(pairs: &PartPairs<'_>, poses: &platewash_kinematics::BodyPoses) -> Result<(), TestCaseError> {
    let mut open: Vec<_> = pairs.outermost().map(|pair| (pair, Vec::new())).collect();
    let mut seen = open.len();
    while let Some((pair, around)) = open.pop() {
        let parts = pairs.get(pair).unwrap();
        let measured = parts.measure(&parts.mover(poses));
        let within = pairs.within(pair);
        if within.is_empty() {
            for outer in &around {
                // What overlaps has no more than a bound of its depth.
                prop_assert!(
                    *outer <= measured.distance_m.max(0.0) + ITERATIVE_ERROR_M,
                    "{outer} {measured:?}"
                );
            }
        }
        seen += within.len();
        let around = [around, vec![measured.at_least_m]].concat();
        open.extend(within.map(|inner| (inner, around.clone())));
    }
    prop_assert!(pairs.get(seen).is_none() && pairs.get(seen - 1).is_some());
    Ok(())
}

#[test]
fn moved_plates_equal_plates_made_there() {
    let robot = RobotModel::irb120().unwrap();
    let world = workcell(&robot, kitchen_tool());
    let first = ClearanceModel::new(&robot, &world, &plates(0, 0.03)).unwrap();
    let moved = plates(0, 0.05).map(|plate| plate.moved_to([0.25, 0.3]));
    let q = JointVector::new(0.4, 0.5, 0.2, 0.1, 0.9, 0.0);
    let made = ClearanceModel::new(&robot, &world, &moved).unwrap();
    assert_eq!(first.among(&moved).all(&q), made.all(&q));
    // Of another shape, too: of another thickness, without a foot, flat.
    let mut others = plates(2, 0.03);
    others[0].foot = None;
    others[1].surface = Surface::Disc { radius_m: 0.1 };
    let made = ClearanceModel::new(&robot, &world, &others).unwrap();
    assert_eq!(first.among(&others).all(&q), made.all(&q));
}

#[test]
fn nan_is_never_clear_of_many_parts() {
    let robot = RobotModel::irb120().unwrap();
    let world = workcell(&robot, kitchen_tool());
    let model = ClearanceModel::new(&robot, &world, &plates(1, 0.03)).unwrap();
    let q = JointVector::new(f64::NAN, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert!(!model.keeps_clearance(&q, 0.0) && model.levels_kept(&q, Some(0), &[0.0]) == 0);
    assert!(model.nearest_washing(&q, 0, 0.01).is_some());
}
