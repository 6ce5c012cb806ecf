//! Properties of the trigonometry that hold for every argument: symmetry, monotony, inverses.

use platewash_kinematics::trig::{acos, asin, atan2, cos, sin, sin_cos};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

proptest! {
    #[test]
    fn sine_and_cosine_alone_are_the_pair(x in -2e5..2e5f64) {
        prop_assert_eq!((sin(x), cos(x)), sin_cos(x));
    }

    #[test]
    fn sine_is_odd_and_cosine_even_bit_for_bit(x in -2e5..2e5f64) {
        let (s, c) = sin_cos(x);
        let (minus_s, minus_c) = sin_cos(-x);
        prop_assert_eq!((minus_s.to_bits(), minus_c.to_bits()), ((-s).to_bits(), c.to_bits()));
    }

    #[test]
    fn squares_sum_to_one(x in -1e5..1e5f64) {
        let (s, c) = sin_cos(x);
        prop_assert!((s * s + c * c - 1.0).abs() < 5e-16);
    }

    #[test]
    fn sine_rises_and_falls_with_its_quadrant(quadrant in -1000..1000i32, a in 1e-6..1.57f64, step in 1e-9..1e-3f64) {
        let start = f64::from(quadrant) * FRAC_PI_2 + a;
        let end = (start + step).min(f64::from(quadrant + 1) * FRAC_PI_2);
        prop_assume!(end > start);
        let rises = quadrant.rem_euclid(4) % 3 == 0;
        let gain = (sin(end) - sin(start)) * if rises { 1.0 } else { -1.0 };
        prop_assert!(gain >= -1.2e-16, "{}", gain);
        prop_assert_eq!(sin(start) > 0.0, quadrant.rem_euclid(4) < 2);
    }

    #[test]
    fn arc_functions_invert_the_direct_ones(x in -PI..PI) {
        let (s, c) = sin_cos(x);
        prop_assert!((atan2(s, c) - x).abs() <= 8.9e-16);
        prop_assert!((sin(asin(s)) - s).abs() <= 4.5e-16);
        prop_assert!((cos(acos(c)) - c).abs() <= 4.5e-16);
    }

    #[test]
    fn arc_tangent_turns_with_its_vector(y in -1e3..1e3f64, x in 1e-3..1e3f64) {
        let angle = atan2(y, x);
        prop_assert_eq!(atan2(-y, x), -angle);
        prop_assert!((atan2(y, -x).abs() + angle.abs() - PI).abs() <= 8.9e-16);
        prop_assert!((atan2(x, y) + angle - FRAC_PI_2).abs() <= 4.5e-16);
        prop_assert_eq!(atan2(y * 1024.0, x * 1024.0), angle);
    }
}
