//! Input that makes no sense or is extreme, and plates that lie near each other.

use super::world::{HOME, RADIUS_M, check, curve, path, plate_at, within};
use platewash_fixtures::kitchen_tool;
use platewash_kinematics::JointVector;
use platewash_planner::OutOfRange;
use platewash_planner::redundancy::{RedundancyError, Task};
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::{Rings, WashCurve, WashPath, WashPattern};

#[test]
fn numbers_that_make_no_sense_are_refused_by_name() {
    let good = path(curve(RADIUS_M), 15.0);
    let refused = |path: &WashPath, y_m: f64, clearance_m: f64, near: &JointVector| {
        let plates = [plate_at(0.36, 0.0).moved_to([0.3, y_m])];
        within(&kitchen_tool(), &[plate_at(0.36, 0.0)], |world| {
            let placed = world.placed.among(world.clearance, &plates);
            match Task::new(&placed, path, clearance_m, near) {
                Err(RedundancyError::Input(OutOfRange { name, .. })) => name,
                other => panic!("{other:?}"),
            }
        })
    };
    let curved = |change: &dyn Fn(&mut WashCurve)| {
        let mut path = good;
        change(&mut path.curve);
        refused(&path, 0.0, 0.01, &HOME)
    };
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, 1e300] {
        assert_eq!(curved(&|curve| curve.radius_m = bad), "curve.radius_m");
        assert_eq!(curved(&|curve| curve.turns = bad), "curve.turns");
        let tilted = WashPath { cone_rad: bad, ..good };
        assert_eq!(refused(&tilted, 0.0, 0.01, &HOME), "cone_rad");
        assert_eq!(refused(&good, 0.0, bad, &HOME), "clearance_m");
    }
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        assert_eq!(curved(&|curve| curve.start_angle_rad = bad), "curve.start_angle_rad");
        assert_eq!(refused(&good, bad, 0.01, &HOME), "centre");
        assert_eq!(refused(&good, 0.0, 0.01, &JointVector::repeat(bad)), "near");
    }
    let long = |curve: &mut WashCurve| (curve.radius_m, curve.turns) = (9.0, 100.0);
    assert_eq!(curved(&long), "length of the curve");
    let rings = Rings {
        count: 4,
        inner_m: 0.02,
        lead_rad: 2.0,
        blend_rad: 1.7,
        laps: 1,
    };
    let ringed = |rings| curved(&|curve| curve.pattern = WashPattern::Rings(rings));
    assert_eq!(
        ringed(Rings {
            laps: u32::MAX,
            ..rings
        }),
        "curve.rings.laps"
    );
    assert_eq!(
        ringed(Rings {
            blend_rad: f64::NAN,
            ..rings
        }),
        "curve.rings.blend_rad"
    );
    within(&kitchen_tool(), &[plate_at(0.36, 0.0)], |world| {
        let other = WashPath { plate: 7, ..good };
        let missing = RedundancyError::Plate { plate: 7, count: 1 };
        assert_eq!(Task::new(&world.placed, &other, 0.01, &HOME).err(), Some(missing));
    });
}

/// Extremes of the allowed ranges end with an answer or a reason.
#[test]
fn ends_for_extreme_values() {
    for (x, y, z) in [
        (0.0, 0.0, 0.03),
        (10.0, -10.0, 10.0),
        (0.0, 0.05, -3.0),
        (0.36, 0.0, 0.9),
    ] {
        let plates = [Plate::level_disc([x, y, z], 0.145, 0.02)];
        within(&kitchen_tool(), &plates, |world| {
            for (radius_m, turns, tilt) in [
                (1e-4, 0.25, 0.0),
                (8.0, 1.5, 15.0),
                (0.12, 40.0, 80.0),
                (0.05, 0.25, 15.0),
            ] {
                let curve = WashCurve {
                    turns,
                    ..curve(radius_m)
                };
                let path = path(curve, tilt);
                match world.washing(&path) {
                    Ok(washing) => check(world, &path, &washing),
                    Err(error) => assert!(error.to_string().contains("plate 1"), "{error}"),
                }
            }
        });
    }
}

/// The sponge may touch other plates while it works on one; how near they lie changes nothing.
#[test]
fn ignores_the_distance_of_other_plates() {
    let first = plate_at(0.36, 0.0);
    let path = path(curve(RADIUS_M), 15.0);
    let alone = within(&kitchen_tool(), &[first], |world| world.washing(&path).unwrap());
    for gap in [-0.02, -1e-6, 0.0005, 0.0035, 0.01] {
        let beside = first.moved_to([first.centre().x, 0.29 + gap]);
        within(&kitchen_tool(), &[first, beside], |world| {
            let washing = world.washing(&path).unwrap();
            check(world, &path, &washing);
            assert_eq!(washing.q, alone.q, "{gap}");
        });
    }
}
