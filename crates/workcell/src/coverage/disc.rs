//! The area that a disc and a rectangle have in common.

use crate::trig::atan2;

/// Area of the rectangle [x0, x1] × [y0, y1] within the disc of radius `radius` about the origin.
///
/// The signed area F(a, b) over [0, a] × [0, b] is odd in a and in b; the rectangle's is F(x1, y1) − F(x0, y1) − F(x1, y0) +
/// F(x0, y0).
pub(crate) fn area_of_rectangle_in_disc(radius: f64, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
    let signed = |a: f64, b: f64| quadrant_area(radius, a.abs(), b.abs()) * a.signum() * b.signum();
    (signed(x1, y1) - signed(x0, y1) - signed(x1, y0) + signed(x0, y0)).max(0.0)
}

/// Area of [0, a] × [0, b] within the disc: a b if the corner is inside, and otherwise b x_b plus the integral of
/// √(radius² − x²) from x_b to a, where x_b = √(radius² − b²).
fn quadrant_area(radius: f64, a: f64, b: f64) -> f64 {
    let (a, b) = (a.min(radius), b.min(radius));
    let squared = radius * radius;
    if a * a + b * b <= squared {
        return a * b;
    }
    let (x_b, y_a) = ((squared - b * b).max(0.0).sqrt(), (squared - a * a).max(0.0).sqrt());
    0.5 * (b * x_b + a * y_a + squared * (atan2(a, y_a) - atan2(x_b, b)))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn known_areas() {
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
}
