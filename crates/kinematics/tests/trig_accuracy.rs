//! The trigonometry module against 400-digit references: accuracy, special values, lanes, and pinned bits.
//!
//! `fixtures/trig.json` is written by `fixtures/trig.py`, which describes its rows.

use platewash_kinematics::trig::{acos, asin, atan2, sin_cos, sin_cos_lanes};
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The stated bounds \[ulp\].
const SIN_COS_ULP: f64 = 0.85;
const ATAN2_ULP: f64 = 1.5;
const ARC_SINE_ULP: f64 = 1.3;

/// Limit of sine's and cosine's fast path \[rad\]; beyond it they are the `libm` crate's, below 1 ulp.
const FAST_BOUND: f64 = 1e5;

fn rows(of: &str) -> Vec<Vec<String>> {
    let fixture: HashMap<String, Vec<String>> =
        serde_json::from_str(include_str!("fixtures/trig.json")).expect("the fixture is JSON");
    let split = |row: &String| row.split(' ').map(str::to_owned).collect();
    fixture[of].iter().map(split).collect()
}

fn argument(hex: &str) -> f64 {
    f64::from_bits(u64::from_str_radix(hex, 16).expect("16 hex digits"))
}

/// Error of `got` against "nearest double:rest in thousandths", in units of the answer's last place.
fn error_ulp(got: f64, reference: &str) -> f64 {
    let (nearest, rest) = reference.split_once(':').expect("double:rest");
    let nearest = argument(nearest);
    let magnitude = nearest.abs();
    let ulp = f64::from_bits(magnitude.to_bits() + 1) - magnitude;
    (got - nearest) / ulp - rest.parse::<f64>().expect("a number") * 1e-3
}

fn worst(errors: impl Iterator<Item = (f64, String)>) -> (f64, String) {
    errors
        .map(|(error, at)| (error.abs(), at))
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .expect("rows")
}

#[test]
fn sine_and_cosine_are_as_accurate_as_stated() {
    for (within, bound) in [(true, SIN_COS_ULP), (false, 1.0)] {
        let inside = |row: &Vec<String>| (argument(&row[0]).abs() <= FAST_BOUND) == within;
        let (error, at) = worst(rows("sin_cos").into_iter().filter(inside).flat_map(|row| {
            let (s, c) = sin_cos(argument(&row[0]));
            [
                (error_ulp(s, &row[1]), format!("sin {row:?}")),
                (error_ulp(c, &row[2]), format!("cos {row:?}")),
            ]
        }));
        assert!(error <= bound, "{error} ulp at {at}");
    }
}

#[test]
fn inverse_functions_are_as_accurate_as_stated() {
    let (error, at) = worst(rows("atan2").into_iter().map(|row| {
        let got = atan2(argument(&row[0]), argument(&row[1]));
        (error_ulp(got, &row[2]), format!("{row:?}"))
    }));
    assert!(error <= ATAN2_ULP, "atan2: {error} ulp at {at}");
    for (name, f) in [("acos", acos as fn(f64) -> f64), ("asin", asin)] {
        let (error, at) = worst(
            rows(name)
                .into_iter()
                .map(|row| (error_ulp(f(argument(&row[0])), &row[1]), format!("{row:?}"))),
        );
        assert!(error <= ARC_SINE_ULP, "{name}: {error} ulp at {at}");
    }
}

#[test]
fn special_values_are_kept() {
    let bits = |(s, c): (f64, f64)| (s.to_bits(), c.to_bits());
    for tiny in [0.0, -0.0, 5e-324, -5e-324, 1e-310, 1e-20, -1e-9] {
        assert_eq!(bits(sin_cos(tiny)), bits((tiny, 1.0)), "{tiny:e}");
    }
    for none in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let (s, c) = sin_cos(none);
        assert!(s.is_nan() && c.is_nan(), "{none}");
        assert!(atan2(f64::NAN, none).is_nan() && atan2(none, f64::NAN).is_nan());
    }
    assert!(acos(f64::NAN).is_nan() && asin(f64::NAN).is_nan());
    assert_eq!((acos(1.0).to_bits(), acos(-1.0), acos(0.0)), (0, PI, FRAC_PI_2));
    assert_eq!((acos(1.0 + 1e-15), acos(f64::NEG_INFINITY)), (0.0, PI));
    assert_eq!((asin(1.0), asin(-2.0)), (FRAC_PI_2, -FRAC_PI_2));
    assert_eq!(asin(-0.0).to_bits(), (-0.0_f64).to_bits());
}

#[test]
fn arc_tangent_follows_ieee_754_at_zeros_and_infinities() {
    let (inf, three_quarters) = (f64::INFINITY, 3.0 * FRAC_PI_4);
    for (y, x, angle) in [
        (0.0, 0.0, 0.0),
        (0.0, -0.0, PI),
        (0.0, 2.0, 0.0),
        (0.0, -5e-324, PI),
        (3.0, 0.0, FRAC_PI_2),
        (5e-324, -0.0, FRAC_PI_2),
        (1.0, 1.0, FRAC_PI_4),
        (1.0, -1.0, three_quarters),
        (inf, inf, FRAC_PI_4),
        (inf, -inf, three_quarters),
        (inf, 1e300, FRAC_PI_2),
        (inf, -0.0, FRAC_PI_2),
        (0.0, inf, 0.0),
        (1e308, inf, 0.0),
        (1e308, -inf, PI),
        (0.0, -inf, PI),
        (5e-324, 1e308, 0.0),
        (5e-324, -1.7e308, PI),
        (1.7e308, 1.7e308, FRAC_PI_4),
        (5e-324, 5e-324, FRAC_PI_4),
    ] {
        for sign in [1.0, -1.0] {
            let got = atan2(y * sign, x);
            assert_eq!(got.to_bits(), (angle * sign).to_bits(), "atan2({}, {x})", y * sign);
        }
    }
}

/// Arguments for the pinned bits: fixed, spread over quadrants and sizes, and none of them rounded by a library.
fn sweep() -> impl Iterator<Item = f64> {
    (-50_000..50_000_i32).map(|k| f64::from(k) * [1.0, 1e-3, 1e-4][k.rem_euclid(3) as usize] * 1.9375)
}

/// FNV-1a over the bits.
fn checksum(values: impl Iterator<Item = f64>) -> u64 {
    let bytes = values.flat_map(|v| v.to_bits().to_le_bytes());
    bytes.fold(0xCBF2_9CE4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3)
    })
}

/// A change of any result changes plans: it must be meant. If it is, copy the new sums.
#[test]
fn results_have_the_pinned_bits() {
    let sums = [
        checksum(sweep().flat_map(|x| <[f64; 2]>::from(sin_cos(x)))),
        checksum(sweep().zip(sweep().skip(777)).map(|(y, x)| atan2(y, x))),
        checksum(sweep().map(|x| acos(x * 1e-5))),
        checksum(sweep().map(|x| asin(x * 1e-5))),
    ];
    assert_eq!(
        sums.map(|s| format!("{s:016x}")),
        [
            "8a36a1bf85516832",
            "4d04f23c155476d7",
            "9322c0416e222f8c",
            "62471c719ed28ea4"
        ]
    );
}

fn lanes_match<const N: usize>() {
    let angles: Vec<f64> = sweep().collect();
    for chunk in angles.chunks_exact(N) {
        let chunk: &[f64; N] = chunk.try_into().expect("exact");
        let (s, c) = sin_cos_lanes::<N>(chunk);
        for i in 0..N {
            let alone = sin_cos(chunk[i]);
            assert_eq!((s[i], c[i]), alone, "{}", chunk[i]);
        }
    }
}

#[test]
fn lanes_have_the_bits_of_the_scalar_function() {
    lanes_match::<4>();
    lanes_match::<6>();
    lanes_match::<8>();
}

#[test]
fn corrects_lanes_out_of_bounds_alone() {
    let angles = [0.5, 1e9, f64::NAN, -FAST_BOUND, f64::INFINITY, -0.0];
    let (s, c) = sin_cos_lanes::<6>(&angles);
    for (i, &angle) in angles.iter().enumerate() {
        let alone = sin_cos(angle);
        assert_eq!(
            (s[i].to_bits(), c[i].to_bits()),
            (alone.0.to_bits(), alone.1.to_bits()),
            "{angle}"
        );
    }
}
