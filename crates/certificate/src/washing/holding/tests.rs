//! The load on one plate against distributions of pressure that hold it, by friction of their own at each point.

use super::RingLoad;
use nalgebra::{Vector2, Vector3};
use platewash_fixtures::is_thorough;
use platewash_workcell::job::RingTerms;
use platewash_workcell::random::stream;
use rand::RngExt;
use rand_pcg::Pcg64;
use std::f64::consts::TAU;

/// A plate pressed by some columns, with friction of its own on each.
struct Loaded {
    /// Pressed onto the ring \[N\], and the first moment of it \[N·m\].
    down_n: f64,
    moment_nm: Vector2<f64>,
    /// Across the axis \[N\], and about it \[N·m\].
    lateral_n: Vector2<f64>,
    torque_nm: f64,
}

/// A random load, with bounds that hold for it.
fn load(random: &mut Pcg64) -> (RingLoad, Loaded) {
    let mut between = |least: f64, most: f64| least + (most - least) * random.random::<f64>();
    let friction = between(0.0, 1.2);
    let steepest = if between(0.0, 1.0) < 0.5 {
        0.0
    } else {
        between(0.0, 0.7)
    };
    let (tip_m, reach_m, height_m) = (between(0.0, 0.13), between(0.01, 0.03), between(0.002, 0.04));
    let farthest_m = tip_m + reach_m * between(0.5, 1.0);
    let most_n = between(0.5, 40.0);
    let weight_n = if between(0.0, 1.0) < 0.2 {
        [0.0; 2]
    } else {
        [between(1.0, 15.0), between(0.0, 1.0)]
    };
    let tip = Vector2::new(tip_m, 0.0) * between(0.9, 1.0);
    let turn = |angle: f64| Vector2::new(angle.cos(), angle.sin());
    // Columns anywhere under the sponge, each with friction in its tangent plane.
    let all_n = most_n * between(0.0, 1.0).sqrt();
    let columns = 1 + (5.0 * between(0.0, 1.0)) as usize;
    let (mut down_n, mut moment, mut lateral, mut torque) = (weight_n[0], Vector2::zeros(), Vector2::zeros(), 0.0);
    let (mut lean, mut twist, mut across) = (Vector2::zeros(), 0.0, 0.0);
    let drag = between(0.0, TAU);
    for _ in 0..columns {
        let place = loop {
            let place = tip + turn(between(0.0, TAU)) * reach_m * between(0.0, 1.0);
            if place.norm() <= farthest_m {
                break place;
            }
        };
        let z = between(0.0, height_m);
        let out = if place.norm() > 0.0 {
            place.normalize()
        } else {
            Vector2::x()
        };
        let sine: f64 = steepest * between(-1.0, 1.0);
        let normal = Vector3::new(-sine * out.x, -sine * out.y, (1.0 - sine * sine).sqrt());
        // All drag the same way, or each about the axis, or any way.
        let along = match (3.0 * between(0.0, 1.0)) as usize {
            0 => turn(drag),
            1 => Vector2::new(-out.y, out.x),
            _ => turn(between(0.0, TAU)),
        };
        let along = Vector3::new(along.x, along.y, 0.0);
        let tangent = along - normal * along.dot(&normal);
        let pressed = all_n / columns as f64;
        let force = (tangent.normalize() * friction - normal) * pressed;
        let at = Vector3::new(place.x, place.y, z);
        down_n -= force.z;
        // What leans over the ring is pressed down there, too.
        moment += place * -force.z + force.xy() * z;
        lateral += force.xy();
        torque += at.cross(&force).z;
        let from_tip = place - tip;
        lean += from_tip * pressed;
        twist += from_tip.norm() * force.xy().norm();
        across += force.xy().norm();
    }
    // The weight pushes across the axis at some height.
    let down_hill = turn(between(0.0, TAU)) * weight_n[1];
    lateral += down_hill;
    moment += down_hill * between(0.0, height_m);
    let second = |random: f64, bound: f64| if random < 0.5 { f64::INFINITY } else { bound };
    let bounds = RingLoad {
        pressed_n: most_n,
        weight_n,
        sine: steepest,
        friction,
        tip_m,
        reach_m,
        farthest_m,
        height_m,
        lateral_n: second(between(0.0, 1.0), across),
        // The second bound of the lean is for faces that are flat.
        lean_nm: if steepest > 0.0 {
            f64::INFINITY
        } else {
            second(between(0.0, 1.0), lean.norm())
        },
        twist_nm: second(between(0.0, 1.0), twist),
    };
    let loaded = Loaded {
        down_n,
        moment_nm: moment,
        lateral_n: lateral,
        torque_nm: torque,
    };
    (bounds, loaded)
}

/// Pressure on some points of a ring with a sum and a first moment: between two of its points and, to a share, spread.
fn pressure(random: &mut Pcg64, ring_m: f64, down_n: f64, moment_nm: &Vector2<f64>) -> Vec<(Vector2<f64>, f64)> {
    let centre = moment_nm / down_n;
    let mut all = Vec::new();
    let share = random.random::<f64>();
    for (part, pairs) in [(share, 1), (1.0 - share, 40)] {
        for k in 0..pairs {
            // The line through the centre meets the ring on both sides.
            let angle = if pairs == 1 {
                TAU * random.random::<f64>()
            } else {
                TAU * f64::from(k) / f64::from(pairs)
            };
            let along = Vector2::new(angle.cos(), angle.sin());
            let middle = -centre.dot(&along);
            let half = (middle * middle + ring_m * ring_m - centre.norm_squared()).sqrt();
            let ends = [middle - half, middle + half];
            let pressed = down_n * part / f64::from(pairs);
            all.push((centre + along * ends[0], pressed * ends[1] / (ends[1] - ends[0])));
            all.push((centre + along * ends[1], pressed * -ends[0] / (ends[1] - ends[0])));
        }
    }
    all
}

/// Least friction coefficient that balances a load, by duality: the greatest of (v·F + ω T) / Σ p ‖v + ω ẑ × r‖ over all (v, ω).
fn least_friction(pressure: &[(Vector2<f64>, f64)], loaded: &Loaded, ring_m: f64) -> f64 {
    let mut most: f64 = 0.0;
    for i in 0..=36 {
        let (spin, slide) = (f64::from(i) / 36.0 * TAU / 4.0).sin_cos();
        for k in 0..72 {
            let angle = TAU * f64::from(k) / 72.0;
            let v = Vector2::new(angle.cos(), angle.sin()) * slide;
            for turn in [-spin / ring_m, spin / ring_m] {
                let resists = |(r, p): &(Vector2<f64>, f64)| p * (v + Vector2::new(-r.y, r.x) * turn).norm();
                let all: f64 = pressure.iter().map(resists).sum();
                most = most.max((v.dot(&loaded.lateral_n) + turn * loaded.torque_nm) / all);
            }
        }
    }
    most
}

/// Wherever the criterion says that a plate stays, friction exists that holds it, for every pressure on the ring that is tried; and the bounds of
/// where the pressure is, and of what is pushed across, hold.
#[test]
fn where_a_plate_is_said_to_stay_friction_holds_it() {
    let mut random = stream(20_261_128, "holding");
    let cases = if is_thorough() { 60_000 } else { 4_000 };
    let (mut stays, mut nearest) = (0, 0.0_f64);
    for case in 0..cases {
        let (bounds, loaded) = load(&mut random);
        let ring = RingTerms {
            friction: 0.05 + 1.5 * random.random::<f64>(),
            radius_m: 0.02 + 0.14 * random.random::<f64>(),
        };
        let shares = bounds.shares(&ring);
        let off_m = loaded.moment_nm.norm() / loaded.down_n;
        if let Some(tipping) = shares.tipping {
            assert!(
                loaded.down_n <= 0.0 || off_m <= tipping * ring.radius_m,
                "{case}: {off_m} {shares:?} {ring:?} {bounds:?}"
            );
        }
        if let Some(sliding) = shares.sliding {
            let needed = loaded.lateral_n.norm() / (ring.friction * loaded.down_n);
            assert!(needed <= sliding, "{case}: {needed} {shares:?} {bounds:?}");
        }
        let Some(needed) = shares.friction else { continue };
        assert!(
            shares.sliding.is_some_and(|sliding| sliding <= needed * (1.0 + 1e-6)),
            "{shares:?}"
        );
        let pressure = pressure(&mut random, ring.radius_m, loaded.down_n, &loaded.moment_nm);
        let [down, x, y] = pressure
            .iter()
            .fold([0.0; 3], |all, (r, p)| [all[0] + p, all[1] + p * r.x, all[2] + p * r.y]);
        assert!(
            (down / loaded.down_n - 1.0).abs() < 1e-9 && (Vector2::new(x, y) - loaded.moment_nm).norm() < 1e-9 * down
        );
        assert!(pressure.iter().all(|(_, p)| *p >= 0.0));
        let found = least_friction(&pressure, &loaded, ring.radius_m) / ring.friction;
        assert!(found <= needed, "{case}: {found} {needed} {ring:?} {bounds:?}");
        nearest = nearest.max(found / needed);
        stays += usize::from(needed <= 1.0);
    }
    assert!(stays > cases / 20, "{stays} of {cases} stay");
    assert!(
        nearest > 0.8,
        "the bound is near to what is needed somewhere: {nearest}"
    );
}

/// By hand: a sponge that presses straight down in the middle of a flat plate with N, and drags with μ N; the weight helps.
#[test]
fn a_plate_pressed_in_its_middle_slides_first() {
    let bounds = RingLoad {
        pressed_n: 10.0,
        weight_n: [5.0, 0.0],
        sine: 0.0,
        friction: 0.3,
        tip_m: 0.0,
        reach_m: 1e-9,
        farthest_m: 1e-9,
        height_m: 1e-9,
        lateral_n: f64::INFINITY,
        lean_nm: f64::INFINITY,
        twist_nm: f64::INFINITY,
    };
    let shares = bounds.shares(&RingTerms {
        friction: 0.5,
        radius_m: 0.1,
    });
    // 3 N of 7.5 N.
    for share in [shares.sliding, shares.friction] {
        assert!((share.unwrap() - 0.4).abs() < 1e-6, "{shares:?}");
    }
    assert!(shares.tipping.unwrap() < 1e-6 && shares.fault().is_none());
    // As far out as the ring it tips, with a little weight; without any friction it slides.
    let out = RingLoad {
        tip_m: 0.12,
        farthest_m: 0.121,
        ..bounds
    };
    let ring = RingTerms {
        friction: 0.5,
        radius_m: 0.07,
    };
    assert_eq!(
        (out.shares(&ring).fault(), out.shares(&ring).friction),
        (Some("it may tip"), None)
    );
    assert_eq!(
        bounds.shares(&RingTerms { friction: 0.0, ..ring }).fault(),
        Some("it may slide")
    );
    let slides = bounds.shares(&RingTerms { friction: 0.19, ..ring });
    assert_eq!(slides.fault(), Some("it may slide"));
    // The torque about a centre far from it turns it, though it would not slide.
    let heavy = RingLoad {
        weight_n: [30.0, 0.0],
        ..out
    };
    let turns = heavy.shares(&RingTerms {
        friction: 0.08,
        radius_m: 0.1,
    });
    assert_eq!(turns.fault(), Some("it may turn"), "{turns:?}");
}

/// Values that are no numbers, or none that can be: nothing is proved of them.
#[test]
fn unknown_loads_prove_nothing() {
    let known = load(&mut stream(3, "holding")).0;
    let ring = RingTerms {
        friction: 5.0,
        radius_m: 0.5,
    };
    assert_eq!(known.shares(&ring).fault(), None);
    let spoilt: [fn(&mut RingLoad, f64); 6] = [
        |l, v| l.weight_n = [v; 2],
        |l, v| l.pressed_n = v,
        |l, v| l.tip_m = v,
        |l, v| l.sine = v,
        |l, v| l.friction = v,
        |l, v| l.height_m = v,
    ];
    for (which, spoil) in spoilt.iter().enumerate() {
        for value in [f64::NAN, f64::INFINITY, 1e300] {
            let mut load = known;
            // Any force is held by so much friction, if it is a number.
            if which == 1 && value == 1e300 {
                continue;
            }
            spoil(&mut load, value);
            // A weight that presses with 10³⁰⁰ N down and across, or a slope of 10³⁰⁰, is none either.
            assert!(
                load.shares(&ring).fault().is_some(),
                "{which} {value}: {:?}",
                load.shares(&ring)
            );
        }
    }
    for weightless in [[0.0; 2], [-5.0, 0.0], [0.0, 5.0]] {
        let shares = RingLoad {
            weight_n: weightless,
            ..known
        }
        .shares(&ring);
        assert_eq!(
            shares.fault().is_none(),
            weightless == [0.0; 2],
            "{weightless:?}: {shares:?}"
        );
    }
}
