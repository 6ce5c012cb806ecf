use platewash_workcell::wash_path::*;

use platewash_workcell::surface::{SHIPPED_PROFILES, Surface};
use proptest::prelude::*;
use std::f64::consts::TAU;

fn trims() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), 0.0..MOST_TRIM_RAD]
}

fn spirals() -> impl Strategy<Value = WashCurve> {
    (0.02..0.3f64, 0.5..8.0f64, -4.0..4.0f64, prop::bool::ANY, trims()).prop_map(
        |(radius_m, turns, start_angle_rad, closing_ring, trim_rad)| WashCurve {
            radius_m,
            turns,
            start_angle_rad,
            closing_ring,
            trim_rad,
            pattern: WashPattern::Spiral,
        },
    )
}

fn rings() -> impl Strategy<Value = WashCurve> {
    (
        2..6usize,
        0.01..0.03f64,
        0.02..0.06f64,
        0.3..2.5f64,
        0.3..2.5f64,
        -4.0..4.0f64,
        trims(),
        1..4u32,
    )
        .prop_map(
            |(count, inner_m, pitch_m, lead_rad, blend_rad, start_angle_rad, trim_rad, laps)| {
                let rings = Rings {
                    count,
                    inner_m,
                    lead_rad,
                    blend_rad,
                    laps,
                };
                WashCurve {
                    radius_m: inner_m + pitch_m * (count - 1) as f64,
                    turns: rings.turns(),
                    start_angle_rad,
                    closing_ring: true,
                    trim_rad,
                    pattern: WashPattern::Rings(rings),
                }
            },
        )
}

/// Curves of every pattern: a new one must be drawn here, too.
fn curves() -> impl Strategy<Value = WashCurve> {
    prop::sample::select(PatternName::ALL.to_vec()).prop_flat_map(|name| match name {
        PatternName::Spiral => spirals().boxed(),
        PatternName::Rings => rings().boxed(),
    })
}

fn surfaces() -> impl Strategy<Value = Surface> {
    let names = prop::sample::select(SHIPPED_PROFILES.to_vec());
    prop_oneof![
        (0.02..0.3f64).prop_map(|radius_m| Surface::Disc { radius_m }),
        names.prop_map(|name| Surface::shipped(name).unwrap()),
    ]
}

proptest! {
    #[test]
    fn derivatives_are_those_of_the_position(curve in curves(), share in 0.001..0.999f64) {
        // The narrowest blend has a fourth derivative of 6e4 m/rad⁴, of which the difference is off by h²/6.
        let (theta, h) = (share * curve.end(), 1e-6);
        let [before, here, after] = [theta - h, theta, theta + h].map(|t| curve.at(t));
        prop_assert!(((after.position - before.position) / (2.0 * h) - here.first).norm() < 1e-8);
        prop_assert!(((after.first - before.first) / (2.0 * h) - here.second).norm() < 1e-7);
    }

    #[test]
    fn the_radius_grows_from_the_centre_to_the_ring(curve in spirals()) {
        prop_assert_eq!(curve.at(0.0).position.norm(), 0.0);
        let mut last = 0.0;
        for k in 0..=2000 {
            let r = curve.at(curve.end() * f64::from(k) / 2000.0).position.norm();
            prop_assert!(r >= last - 1e-15 && r <= curve.radius_m * (1.0 + 1e-14));
            last = r;
        }
        prop_assert!((curve.at(curve.spiral_end()).position.norm() - curve.radius_m).abs() < 1e-15);
        prop_assert!(curve.at(curve.spiral_end()).first.normalize().dot(&curve.at(curve.spiral_end()).position) < 1e-15);
    }

    #[test]
    fn the_length_grows_from_ring_to_ring(curve in rings()) {
        let rings = curve.rings().unwrap();
        let steps = 3000;
        let at = |k: i32| curve.arc(curve.end() * f64::from(k) / f64::from(steps))[0];
        prop_assert_eq!(at(0), rings.inner_m);
        prop_assert!((at(steps) - curve.radius_m).abs() < 1e-15);
        prop_assert!((0..steps).all(|k| at(k) <= at(k + 1) + 1e-15));
        prop_assert!((curve.end() - curve.spiral_end() - TAU * f64::from(curve.laps()) + curve.trim_rad).abs() < 1e-12);
    }

    /// Between two θ no derivative is above what is stated, and points of a surface lie on it.
    #[test]
    fn rates_and_bends_stay_within_their_bounds(
        curve in curves(), surface in surfaces(), share in 0.0..0.98f64, width in 0.0..0.02f64,
    ) {
        let (from, to) = (share * curve.end(), (share + width) * curve.end());
        let [first, second] = curve.greatest_rates([from, to]);
        let whole = curve.greatest_second(&surface, [from, to]);
        for k in 0..=20 {
            let theta = from + (to - from) * f64::from(k) / 20.0;
            let [arc_m, rate, bend] = curve.arc(theta);
            prop_assert!(rate.abs() <= first * (1.0 + 1e-12) && bend.abs() <= second * (1.0 + 1e-12) + 1e-15);
            let here = curve.on(&surface, theta);
            let rho = here.position.xy().norm();
            prop_assert!((here.position.z - surface.height_m(rho)).abs() < 1e-12);
            prop_assert!((surface.arc_at(rho) - arc_m).abs() < 1e-9);
            prop_assert!(here.first.dot(&here.normal).abs() < 1e-12);
            let h = 1e-5;
            let [a, b] = [-h, h].map(|d| curve.on(&surface, (theta + d).clamp(0.0, curve.end())));
            if theta > h && theta < curve.end() - h {
                prop_assert!(((b.position - a.position) / (2.0 * h) - here.first).norm() < 1e-7);
                prop_assert!((b.first - a.first).norm() / (2.0 * h) <= whole * 1.01 + 1e-6);
            }
        }
    }

    #[test]
    fn chords_keep_their_error_on_profiles(curve in rings(), name in prop::sample::select(SHIPPED_PROFILES.to_vec())) {
        let (surface, error) = (Surface::shipped(name).unwrap(), 2e-5);
        let all = curve.parameters(&surface, error);
        prop_assert!(all.is_sorted() && all.contains(&curve.spiral_end()) && all.ends_with(&[curve.end()]));
        for ends in all.windows(2) {
            let [a, b] = [ends[0], ends[1]].map(|t| curve.on(&surface, t).position);
            let along = (b - a).normalize();
            for k in 1..4 {
                let off = curve.on(&surface, ends[0] + (ends[1] - ends[0]) * f64::from(k) / 4.0).position - a;
                prop_assert!((off - along * along.dot(&off)).norm() <= 1.1 * error);
            }
        }
    }

    #[test]
    fn chords_keep_their_error(curve in curves(), error in 1e-6..1e-4f64) {
        let all = curve.parameters(&Surface::Disc { radius_m: 0.3 }, error);
        prop_assert_eq!(all[0], 0.0);
        prop_assert_eq!(all[all.len() - 1], curve.end());
        prop_assert!(all.contains(&curve.spiral_end()));
        for ends in all.windows(2) {
            prop_assert!(ends[0] < ends[1]);
            let [a, b] = [ends[0], ends[1]].map(|t| curve.at(t).position);
            let along = (b - a).normalize();
            for k in 1..8 {
                let off = curve.at(ends[0] + (ends[1] - ends[0]) * f64::from(k) / 8.0).position - a;
                prop_assert!((off - along * along.dot(&off)).norm() <= 1.1 * error + 1e-12);
            }
        }
    }
}

/// By hand: without the blend, R = a Θ; with it a is larger by half a blend's share.
#[test]
fn the_kitchen_has_the_expected_pitch() {
    let curve = WashCurve {
        radius_m: 0.124,
        turns: 3.5,
        start_angle_rad: 0.0,
        closing_ring: true,
        trim_rad: 0.0,
        pattern: WashPattern::Spiral,
    };
    let expected = TAU * 0.124 / (7.0 * std::f64::consts::PI - 0.5);
    assert!((curve.pitch_m() - expected).abs() < 1e-15);
    let outwards = curve.at(TAU).position.norm() - curve.at(0.0).position.norm();
    assert!((outwards - curve.pitch_m()).abs() < 1e-15);
}

/// A plan file of other programs may state any number; only curves with all of them in range are sampled.
#[test]
fn curves_with_a_number_out_of_range_are_not_sound() {
    let rings = Rings {
        count: 4,
        inner_m: 0.02,
        lead_rad: 2.0,
        blend_rad: 1.7,
        laps: 1,
    };
    let good = WashCurve {
        radius_m: 0.12,
        turns: rings.turns(),
        start_angle_rad: 0.0,
        closing_ring: true,
        trim_rad: 0.0,
        pattern: WashPattern::Rings(rings),
    };
    assert!(good.is_sound());
    let ringed = |rings| WashCurve {
        pattern: WashPattern::Rings(rings),
        ..good
    };
    let bad = [
        WashCurve {
            radius_m: f64::NAN,
            ..good
        },
        WashCurve { turns: 1e12, ..good },
        WashCurve { trim_rad: -1.0, ..good },
        ringed(Rings {
            laps: u32::MAX,
            ..rings
        }),
        ringed(Rings { laps: 0, ..rings }),
        ringed(Rings {
            count: usize::MAX,
            ..rings
        }),
        ringed(Rings {
            blend_rad: 0.0,
            ..rings
        }),
        ringed(Rings { inner_m: 0.2, ..rings }),
    ];
    for curve in bad {
        assert!(!curve.is_sound(), "{curve:?}");
    }
}
