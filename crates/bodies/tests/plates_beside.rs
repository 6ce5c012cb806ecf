//! Plates beside, over, below and back to back with each other, and their tilt in words.

use nalgebra::{UnitQuaternion, Vector3};
use platewash_fixtures::{kitchen, kitchen_plate};
use platewash_kinematics::{Pose, trig};
use platewash_workcell::plate::Plate;
use proptest::prelude::*;

fn raised(plate: Plate, by_m: f64) -> Plate {
    plate.seen_from(&Pose::translation(0.0, 0.0, by_m))
}

/// By hand: the plates of the kitchen are 20 mm thick.
#[test]
fn plates_lie_beside_over_and_across_each_other() {
    let here = kitchen_plate([0.3, 0.0]);
    let beside = kitchen_plate([0.3, 0.4]);
    assert!(here.is_parallel(&beside) && (here.aside_m(&beside) - 0.4).abs() < 1e-15);
    assert!(here.may_touch_beside(&beside) && beside.may_touch_beside(&here));
    let over = raised(here, 0.0201);
    assert!(
        over.is_over(&here) && !here.is_over(&over) && !over.may_touch_beside(&here) && !here.may_touch_beside(&over)
    );
    let within = raised(here, 0.0199);
    assert!(!within.is_over(&here) && within.may_touch_beside(&here) && !here.may_touch_beside(&within));
    let turned = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5);
    let tilted = beside.seen_from(&Pose::from_parts(Vector3::zeros().into(), turned));
    assert!(!here.is_parallel(&tilted) && !here.may_touch_beside(&tilted) && !tilted.may_touch_beside(&here));
}

#[test]
fn both_faces_of_a_disc_are_back_to_back() {
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -1.2, 0.4));
    let plate = kitchen_plate([0.3, 0.1]).seen_from(&Pose::from_parts(Vector3::new(0.1, 0.2, 0.3).into(), turn));
    let [front, back] = plate.faces().unwrap();
    assert!(front.is_back_of(&back) && back.is_back_of(&front) && !front.is_back_of(&front));
    assert!((back.centre() - plate.world(&Vector3::new(0.0, 0.0, -0.02))).norm() < 1e-15);
    let thinner = Plate {
        thickness_m: 0.009,
        ..back
    };
    assert!(!front.is_back_of(&thinner) && !front.may_touch_beside(&back));
}

proptest! {
    /// A rigid motion of both plates does not change their relation, except where rounding decides it.
    #[test]
    fn a_common_motion_of_both_plates_changes_nothing(
        axis in prop::array::uniform3(-1.0..1.0f64), angle in -3.0..3.0f64, place in prop::array::uniform3(-1.0..1.0f64),
        at in prop::array::uniform2(-0.5..0.5f64), higher in -0.05..0.05f64, tilted in any::<bool>(),
    ) {
        prop_assume!(Vector3::from(axis).norm() > 0.1 && (higher.abs() - 0.02).abs() > 1e-6 && higher.abs() > 1e-6);
        let turn = |angle: f64| UnitQuaternion::from_scaled_axis(Vector3::from(axis).normalize() * angle);
        let here = kitchen_plate([0.3, 0.0]);
        let there = raised(kitchen_plate(at), higher);
        let there = if tilted { there.seen_from(&Pose::from_parts(Vector3::zeros().into(), turn(0.7))) } else { there };
        let by = Pose::from_parts(Vector3::from(place).into(), turn(angle));
        let moved = [here, there].map(|plate| plate.seen_from(&by));
        prop_assert_eq!(here.is_over(&there), moved[0].is_over(&moved[1]));
        prop_assert_eq!(here.may_touch_beside(&there), moved[0].may_touch_beside(&moved[1]));
        prop_assert!((here.aside_m(&there) - moved[0].aside_m(&moved[1])).abs() < 1e-12);
    }

    /// A disc reaches as far as its two rims do.
    #[test]
    fn a_disc_reaches_as_far_as_its_rims(way in prop::array::uniform3(-1.0..1.0f64), turn in prop::array::uniform3(-2.0..2.0f64)) {
        prop_assume!(Vector3::from(way).norm() > 0.1);
        let way = Vector3::from(way).normalize();
        let turn = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        let plate = kitchen_plate([0.2, -0.1]).seen_from(&Pose::from_parts(Vector3::zeros().into(), turn));
        let rim = (0..720).flat_map(|k| {
            let (s, c) = trig::sin_cos(std::f64::consts::PI * f64::from(k) / 360.0);
            [0.0, -0.02].map(|z| plate.world(&Vector3::new(0.145 * c, 0.145 * s, z)).dot(&way))
        });
        let farthest = rim.fold(f64::NEG_INFINITY, f64::max);
        let reach = plate.reach_along_m(&way);
        prop_assert!(farthest <= reach + 1e-12 && reach - farthest < 1e-5, "{farthest} {reach}");
    }
}

#[test]
fn states_the_tilt_of_tilted_plates_alone() {
    let mut plate = kitchen().terms().plates[0];
    assert_eq!(plate.tilt_words(), None);
    let mut turned = |axis: Vector3<f64>, deg: f64| {
        plate.pose.rotation = UnitQuaternion::from_scaled_axis(axis * deg.to_radians());
        plate.tilt_words()
    };
    let said = turned(Vector3::y(), 60.0);
    assert_eq!(said.as_deref(), Some("tilted by 60°, axis (0.866025404, 0, 0.5)"));
    let said = turned(Vector3::x(), 180.0);
    assert_eq!(said.as_deref(), Some("tilted by 180°, axis (0, 0, -1)"));
    // About its own axis a plate is round.
    assert_eq!(turned(Vector3::z(), 30.0), None);
}
