//! The area that a rectangle and a disc share.

use platewash_bodies::coverage::area_of_rectangle_in_disc;
use proptest::prelude::*;
use std::f64::consts::PI;

#[test]
fn areas_agree_with_known_values() {
    let area = |x, y| area_of_rectangle_in_disc(2.0, x, y);
    assert!((area([-2.0, 2.0], [-2.0, 2.0]) - 4.0 * PI).abs() < 1e-14);
    assert!((area([0.0, 9.0], [-9.0, 9.0]) - 2.0 * PI).abs() < 1e-14);
    assert!((area([-1.0, 1.0], [-0.5, 1.0]) - 3.0).abs() < 1e-14);
    assert!(area([1.5, 3.0], [1.5, 3.0]).abs() < 1e-14);
    // A segment of height 1: R² acos(1/2) − √3.
    assert!((area([1.0, 2.0], [-2.0, 2.0]) - (4.0 * PI / 3.0 - 3.0_f64.sqrt())).abs() < 1e-14);
}

proptest! {
    #[test]
    fn parts_add_up_and_agree_with_a_sum(x0 in -1.2..1.2_f64, w in 0.0..1.0_f64, y0 in -1.2..1.2_f64, h in 0.0..1.0_f64, cut in 0.0..1.0_f64) {
        let whole = area_of_rectangle_in_disc(1.0, [x0, x0 + w], [y0, y0 + h]);
        let x = x0 + cut * w;
        let parts = area_of_rectangle_in_disc(1.0, [x0, x], [y0, y0 + h]) + area_of_rectangle_in_disc(1.0, [x, x0 + w], [y0, y0 + h]);
        prop_assert!((whole - parts).abs() < 1e-14);
        let n = 2000;
        let strip = |i: usize| {
            let x = x0 + w * (i as f64 + 0.5) / n as f64;
            let y = (1.0 - x * x).max(0.0).sqrt();
            ((y0 + h).min(y) - y0.max(-y)).max(0.0) * w / n as f64
        };
        let sum: f64 = (0..n).map(strip).sum();
        prop_assert!((whole - sum).abs() < 1e-4, "{} {}", whole, sum);
    }
}
