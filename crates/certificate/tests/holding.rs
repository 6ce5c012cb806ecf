//! The requirement that a plate stays, on made plans: in a fixture, and on a ring.

use crate::contact::{disc, profile, rings};
use crate::maker::{Recipe, irb120};
use nalgebra::{UnitQuaternion, Vector3};
use platewash_certificate::Verdict;
use platewash_certificate::{Certificate, PlateContact, Requirement, Status, prove};
use platewash_kinematics::Pose;
use platewash_workcell::job::{FixtureTerms, HolderTerms, RingTerms};

fn fixture(force_n: f64, torque_nm: f64) -> HolderTerms {
    HolderTerms {
        sponge_friction: 0.5,
        plate_mass_kg: None,
        fixture: Some(FixtureTerms { force_n, torque_nm }),
        ring: None,
    }
}

fn on_ring(friction: f64, radius_m: f64, mass_kg: f64) -> HolderTerms {
    HolderTerms {
        sponge_friction: 0.3,
        plate_mass_kg: Some(mass_kg),
        fixture: None,
        ring: Some(RingTerms { friction, radius_m }),
    }
}

fn judged(recipe: &Recipe, holder: HolderTerms) -> (Certificate, PlateContact) {
    let mut recipe = recipe.clone();
    recipe.terms.requirements.holder = Some(holder);
    let certificate = prove(&recipe.plan(), &irb120()).unwrap();
    let contact = certificate.contact[0];
    (certificate, contact)
}

#[test]
fn a_plate_stays_in_a_fixture_that_takes_its_load() {
    let mut recipe = disc(0.006, 2.0, rings());
    recipe.terms.limits.joint_acceleration_rad_s2 = [300.0; 6];
    let plain = prove(&recipe.plan(), &irb120()).unwrap();
    assert!(plain.check(Requirement::PlateStays).is_none());
    let of_plain = plain.contact[0].holder_load.unwrap();
    assert_eq!(
        (of_plain.sponge_friction, of_plain.weight_n, of_plain.ring),
        ([0.3, 1.0], None, None)
    );
    let (held, contact) = judged(&recipe, fixture(12.0, 1.5));
    let load = contact.holder_load.unwrap();
    assert_eq!(load.sponge_friction, [0.3, 0.5]);
    // Half of the friction, half of the load.
    assert!((load.lateral_n[1] / of_plain.lateral_n[1] - 0.5).abs() < 1e-12);
    assert_eq!(held.checks.last().unwrap().requirement, Requirement::PlateStays);
    assert_eq!(held.check(Requirement::PlateStays).unwrap().status, Status::Proved);
    assert_eq!(held.verdict, Verdict::Pass, "{held}");
    // The other bounds are those without it.
    assert_eq!(contact.greatest_force_n, plain.contact[0].greatest_force_n);
    // At the bound it is kept, and a little below it is not, by the side that falls short.
    let [force_n, torque_nm] = [load.lateral_n[1], load.torque_nm[1]];
    for (terms, unit, kept) in [
        (fixture(force_n, torque_nm), None, true),
        (fixture(0.99 * force_n, 2.0 * torque_nm), Some("N"), false),
        (fixture(2.0 * force_n, 0.99 * torque_nm), Some("N·m"), false),
        (fixture(0.0, 0.0), None, false),
        (fixture(1e6, 1e6), None, true),
    ] {
        let (certificate, _) = judged(&recipe, terms);
        let check = certificate.check(Requirement::PlateStays).unwrap();
        let status = if kept { Status::Proved } else { Status::NotProved };
        assert_eq!(check.status, status, "{check:?}");
        let measure = check.measure.unwrap();
        assert!(
            unit.is_none_or(|unit| measure.words().unit == unit) && measure.seen.is_none(),
            "{check:?}"
        );
    }
    let text = format!("{held:#}");
    for words in [
        "holder takes: across the plate's axis up to ",
        "friction coefficient of the sponge up to 0.5, assumed",
        "held by a fixture that takes 12 N across its axis and 1.5 N·m about it, with a friction of the sponge of at most 0.5 (assumed)",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}

/// A level plate, an inclined one, and a mounted arm on whose base that is level.
#[test]
fn the_weight_is_that_in_the_world() {
    let mut recipe = disc(0.006, 2.0, rings());
    let (level, contact) = judged(&recipe, on_ring(1.0, 0.12, 1.0));
    let load = contact.holder_load.unwrap();
    assert!((load.weight_n.unwrap()[0] - 9.81).abs() < 1e-12 && load.weight_n.unwrap()[1] < 1e-12);
    let shares = load.ring.unwrap();
    assert_eq!(
        level.check(Requirement::PlateStays).unwrap().status,
        Status::Proved,
        "{shares:?}"
    );
    assert!(shares.fault().is_none() && shares.friction.unwrap() > 0.3, "{shares:?}");
    let (slippery, contact) = judged(&recipe, on_ring(0.2, 0.12, 1.0));
    let check = slippery.check(Requirement::PlateStays).unwrap();
    assert_eq!(check.status, Status::NotProved, "{check:?}");
    assert!(contact.holder_load.unwrap().ring.unwrap().fault().is_some());
    assert!(format!("{slippery:#}").contains("it may "), "{slippery:#}");
    // The world turned about the arm: everything keeps its place seen from the base, and the plate is inclined by 30°.
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 30_f64.to_radians());
    let plan = {
        recipe.terms.requirements.holder = Some(on_ring(1.0, 0.12, 1.0));
        let mut plan = recipe.plan();
        let mount = Pose::from_parts(Vector3::new(0.0, 0.0, 2.0).into(), tilt);
        plan.job.workcell.mount = mount;
        for plate in &mut plan.job.plates {
            *plate = plate.seen_from(&mount);
        }
        for obstacle in &mut plan.job.workcell.obstacles {
            obstacle.pose = mount * obstacle.pose;
        }
        plan
    };
    let inclined = prove(&plan, &irb120()).unwrap();
    let load = inclined.contact[0].holder_load.unwrap();
    let [along_n, across_n] = load.weight_n.unwrap();
    assert!(
        (along_n - 9.81 * 30_f64.to_radians().cos()).abs() < 1e-9 && (across_n - 4.905).abs() < 1e-9,
        "{load:?}"
    );
    assert!(load.ring.unwrap().sliding.unwrap() > shares.sliding.unwrap());
}

#[test]
fn a_plate_with_a_profile_stays_on_a_wide_ring_and_tips_on_a_narrow_one() {
    let recipe = profile("coupe275");
    let (_, contact) = judged(&recipe, on_ring(1.0, 0.13, 2.0));
    let shares = contact.holder_load.unwrap().ring.unwrap();
    assert!(shares.tipping.unwrap() < 1.0, "{shares:?}");
    let (narrow, contact) = judged(&recipe, on_ring(1.0, 0.05, 0.3));
    assert_eq!(contact.holder_load.unwrap().ring.unwrap().fault(), Some("it may tip"));
    let check = narrow.check(Requirement::PlateStays).unwrap();
    assert_eq!((check.status, check.measure.unwrap().bound), (Status::NotProved, None));
    let words = "plate stays (at most 100 % required): plate 1, it may tip";
    assert!(narrow.headline.contains(words), "{}", narrow.headline);
}
