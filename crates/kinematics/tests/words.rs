//! Numbers and messages of libraries in sentences.

use platewash_kinematics::words::*;
use proptest::prelude::*;

#[test]
fn numbers_have_as_many_digits_as_needed() {
    assert_eq!(distinct_decimals(-90.000_02, -90.0, 2), ["-90.00002", "-90.00000"]);
    assert_eq!(distinct_decimals(12.0, 70.0, 1), ["12.0", "70.0"]);
    assert_eq!(distinct_decimals(1e-300, 0.0, 2), ["1e-300", "0e0"]);
    assert_eq!(nonzero_decimals(-1.2e-7, 2), "-0.0000001");
    assert_eq!(nonzero_decimals(0.0, 1), "0.0");
    assert_eq!(
        [-0.0, -4e-5, -6e-5, f64::NEG_INFINITY].map(|v| fixed(v, 4)),
        ["0.0000", "0.0000", "-0.0001", "-inf"]
    );
    assert_eq!(rounded(25.499_999_999_999_996, 6).to_string(), "25.5");
    assert_eq!(rounded_up(4.268_001e-5, 3), 4.27e-5);
    assert_eq!(rounded_up(9.991, 3), 10.0);
    assert_eq!(rounded_down(60.000_000_000_000_01, 6), 60.0);
    assert_eq!(rounded_down(9.999_6, 4), 9.999);
}

#[test]
fn decimals_are_rounded_towards_safety() {
    assert_eq!(
        [decimals_down(19.298_64, 2), decimals_up(19.298_64, 2)],
        ["19.29", "19.30"]
    );
    assert_eq!(
        [decimals_down(99.999_999_999, 3), decimals_up(13.9, 2)],
        ["99.999", "13.90"]
    );
    assert_eq!([decimals_down(-1.01, 1), decimals_up(-1.01, 1)], ["-1.1", "-1.0"]);
    assert_eq!([decimals_down(0.25, 4), decimals_up(0.25, 4)], ["0.2500", "0.2500"]);
    assert_eq!(
        [decimals_down(f64::INFINITY, 1), decimals_up(f64::NAN, 1)],
        ["inf", "NaN"]
    );
}

proptest! {
    #[test]
    fn numbers_that_differ_read_differently(a in -1e3..1e3_f64, steps in 0_u64..4, decimals in 0_usize..6) {
        let b = f64::from_bits(a.to_bits() + steps);
        let [told_a, told_b] = distinct_decimals(a, b, decimals);
        prop_assert_eq!(told_a == told_b, a == b, "{} {}", told_a, told_b);
        let [told_a, told_b] = angles_told_apart(a, b, decimals);
        prop_assert_eq!(told_a == told_b, a == b, "{} {}", told_a, told_b);
    }

    #[test]
    fn rounding_keeps_its_side_and_its_digits(mantissa in 1.0..10.0_f64, exponent in -30..30_i32, digits in 1_usize..9) {
        let value = mantissa * 10_f64.powi(exponent);
        let step = 1.001 * 10_f64.powi(exponent + 2 - digits as i32);
        for (side, rounded) in [(1.0, rounded_up(value, digits)), (-1.0, rounded_down(value, digits))] {
            prop_assert!(side * (rounded - value) >= 0.0 && (rounded - value).abs() <= step, "{value} {rounded}");
            let text = format!("{rounded:e}");
            let told = text.split('e').next().unwrap_or_default().replace('.', "");
            prop_assert!(told.len() <= digits, "{value}: {text}");
        }
    }
}

#[test]
fn no_type_of_rust_is_named() {
    for (path, message, told) in [
        ("", "missing field `format`", "'format' is missing"),
        ("a.b", "missing field `c`", "'a.b.c' is missing"),
        (
            "",
            "unknown field `seed`, expected one of `name`, `axis`",
            "unknown key 'seed': expected one of 'name', 'axis'",
        ),
        (
            "",
            "unknown variant `hinge`, expected one of `revolute`, `fixed`",
            "'hinge' is none of 'revolute', 'fixed'",
        ),
        (
            "rows",
            "invalid type: map, expected a sequence",
            "'rows' must be a list […]; found a table {…}",
        ),
        (
            "seed",
            "invalid value: integer `-1`, expected u64",
            "'seed' must be a whole number; found -1",
        ),
        ("", "invalid float literal", "invalid float literal"),
    ] {
        assert_eq!(message_in_words(path, message), told);
    }
}
