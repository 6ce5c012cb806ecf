//! The tilt as a function of the length along the wash path: a uniform cubic B-spline.
//!
//! With control values `c_k` at the lengths `k h`, on the piece from `k h` with `t = s/h − k`:
//!
//! `τ = ((1−t)³ c_{k−1} + (3t³ − 6t² + 4) c_k + (−3t³ + 3t² + 3t + 1) c_{k+1} + t³ c_{k+2}) / 6`
//!
//! (de Boor, *A Practical Guide to Splines*, ch. IX). It is C², and everywhere a mean of four neighbouring control values
//! with weights ≥ 0: it never overshoots them. Beyond the ends the outermost values repeat.

/// A uniform cubic B-spline over the length of a wash path.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TiltSpline {
    /// c \[rad\]; at least one.
    pub control_rad: Vec<f64>,
    /// h \[m\].
    pub spacing_m: f64,
}

impl TiltSpline {
    /// Tilt at the length `s` \[m\] \[rad\]; a little beyond the ends the outermost pieces go on.
    pub fn tilt(&self, s: f64) -> f64 {
        let u = s / self.spacing_m;
        let last = self.control_rad.len().saturating_sub(1);
        let k = (u as usize).min(last);
        let t = u - k as f64;
        let at = |i: usize| self.control_rad.get(i.min(last)).copied().unwrap_or(0.0);
        let [a, b, c, d] = [at(k.saturating_sub(1)), at(k), at(k + 1), at(k + 2)];
        let (t2, t3, rest) = (t * t, t * t * t, 1.0 - t);
        let sum = rest * rest * rest * a
            + (3.0 * t3 - 6.0 * t2 + 4.0) * b
            + (-3.0 * t3 + 3.0 * t2 + 3.0 * t + 1.0) * c
            + t3 * d;
        sum / 6.0
    }
}

/// Control values smoothed by `passes` of the binomial mean (1, 2, 1) / 4, each value kept within its range.
///
/// The ends stay. A pass damps the shortest wave wholly; n passes have the width of about √(n/2) values.
pub(super) fn smoothed(values: &[f64], ranges: &[[f64; 2]], passes: usize) -> Vec<f64> {
    let mut now = values.to_vec();
    for _ in 0..passes {
        let before = now.clone();
        for (k, window) in before.windows(3).enumerate() {
            let mean = 0.25 * window[0] + 0.5 * window[1] + 0.25 * window[2];
            let [least, most] = ranges[k + 1];
            now[k + 1] = mean.max(least).min(most);
        }
    }
    now
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_spline_is_smooth_and_never_overshoots(
            control_rad in prop::collection::vec(-0.5..0.5f64, 1..20),
            share in 0.0..1.0f64,
        ) {
            let (least, most) = control_rad.iter().fold((1.0_f64, -1.0_f64), |(l, m), &c| (l.min(c), m.max(c)));
            let end = 5e-3 * (control_rad.len() - 1) as f64;
            let spline = TiltSpline { control_rad, spacing_m: 5e-3 };
            let (s, h) = (share * end, 1e-6);
            prop_assert!((least - 1e-12..=most + 1e-12).contains(&spline.tilt(s)));
            let second = |s: f64| (spline.tilt(s + h) - 2.0 * spline.tilt(s) + spline.tilt(s - h)) / (h * h);
            // Third derivatives are at most 8 / (5 mm)³ = 6.4e7 here.
            prop_assert!((second(s + h) - second(s)).abs() < 6.4e7 * 3.0 * h + 1e-3, "the second derivative jumps");
        }

        #[test]
        fn smoothing_stays_in_range_and_flattens(
            values in prop::collection::vec((-0.5..0.5f64, 0.0..0.3f64), 1..30),
            passes in 0usize..40,
        ) {
            let ranges: Vec<_> = values.iter().map(|&(v, w)| [v - w, v + w]).collect();
            let values: Vec<_> = values.into_iter().map(|(v, _)| v).collect();
            let smooth = smoothed(&values, &ranges, passes);
            prop_assert!(smooth.iter().zip(&ranges).all(|(v, [l, m])| l <= v && v <= m));
            prop_assert_eq!(smooth[0], values[0]);
            let rough = |v: &[f64]| v.windows(2).map(|w| (w[1] - w[0]).abs()).sum::<f64>();
            prop_assert!(rough(&smooth) <= rough(&values) + 1e-12);
        }
    }

    #[test]
    fn a_constant_and_a_line_are_reproduced() {
        let spline = TiltSpline {
            control_rad: (0..10).map(|k| 0.01 * f64::from(k)).collect(),
            spacing_m: 0.5,
        };
        for s in [0.5, 1.0, 1.3, 2.9, 3.5] {
            assert!((spline.tilt(s) - 0.02 * s).abs() < 1e-15);
        }
    }
}
