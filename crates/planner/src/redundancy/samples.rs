//! The contact points of a wash path.
//!
//! The tilt as a function of the length along the wash path: a uniform cubic B-spline.
//!
//! With control values `c_k` at the lengths `k h`, on the piece from `k h` with `t = s/h − k`:
//!
//! `τ = ((1−t)³ c_{k−1} + (3t³ − 6t² + 4) c_k + (−3t³ + 3t² + 3t + 1) c_{k+1} + t³ c_{k+2}) / 6`
//!
//! (de Boor, *A Practical Guide to Splines*, ch. IX). It is C², and everywhere a mean of four neighbouring control values
//! with weights ≥ 0: it never overshoots them. Beyond the ends the outermost values repeat.

use crate::placed_arm::{AxisRule, Contact};
use nalgebra::{Vector2, Vector3};
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;

/// Contact points, densely along a wash path.
#[derive(Debug, Clone)]
pub(crate) struct Samples {
    path: WashPath,
    plate: Plate,
    axis: AxisRule,
    /// θ \[rad\], ascending.
    pub theta: Vec<f64>,
    /// Contact points \[m\], base frame.
    pub contact: Vec<Contact>,
    /// Length along the wash path up to each \[m\].
    pub length_m: Vec<f64>,
}

impl Samples {
    /// Points of a wash path on its plate, as dense as [`CHORD_ERROR_M`] asks, with the axis by its share of the slope.
    pub fn new(path: &WashPath, plate: &Plate, axis_share: f64) -> Self {
        let theta = path.curve.parameters(&plate.surface, CHORD_ERROR_M);
        let mut samples = Self {
            path: *path,
            plate: *plate,
            axis: AxisRule::new(&plate.surface, axis_share),
            contact: Vec::with_capacity(theta.len()),
            length_m: Vec::with_capacity(theta.len()),
            theta,
        };
        let mut length = 0.0;
        for &theta in &samples.theta {
            let contact = samples.at(theta);
            let before = samples.contact.last();
            length += before.map_or(0.0, |last| (contact.point - last.point).norm());
            samples.contact.push(contact);
            samples.length_m.push(length);
        }
        samples
    }

    /// The contact point at θ \[rad\].
    pub fn at(&self, theta: f64) -> Contact {
        let here = self.path.curve.on(&self.plate.surface, theta);
        let (point, normal) = (self.plate.world(&here.position), self.plate.pose.rotation * here.normal);
        if self.plate.surface.is_flat() {
            return Contact::on_normal(point, normal);
        }
        let [arc_m, ..] = self.path.curve.arc(theta);
        let [c, s] = self.axis.direction(arc_m);
        let out = here.position.xy().try_normalize(0.0).unwrap_or_else(Vector2::x);
        let axis = self.plate.pose.rotation * Vector3::new(-s * out.x, -s * out.y, c);
        Contact { point, normal, axis }
    }

    /// The derivative of the contact point by θ \[m/rad\].
    pub fn first(&self, theta: f64) -> Vector3<f64> {
        let here = self.path.curve.on(&self.plate.surface, theta);
        self.plate.pose.rotation * here.first
    }

    /// Length of the whole wash path \[m\].
    pub fn whole_m(&self) -> f64 {
        self.length_m.last().copied().unwrap_or(0.0)
    }

    /// θ at `count` ≥ 2 points at equal lengths along the wash path, both ends included.
    pub fn evenly(&self, count: usize) -> Vec<f64> {
        let last = count.saturating_sub(1).max(1);
        let whole = self.whole_m();
        let mut piece = 0;
        let at = |k: usize| {
            let length = whole * k as f64 / last as f64;
            while piece + 2 < self.length_m.len() && self.length_m[piece + 1] < length {
                piece += 1;
            }
            let ends = [piece, (piece + 1).min(self.theta.len() - 1)];
            let [from, to] = ends.map(|i| self.length_m[i]);
            let share = ((length - from) / (to - from).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let [from, to] = ends.map(|i| self.theta[i]);
            from + (to - from) * share
        };
        (0..=last).map(at).collect()
    }
}

/// A uniform cubic B-spline over the length of a wash path.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TiltSpline {
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
pub(crate) fn smoothed(values: &[f64], ranges: &[[f64; 2]], passes: usize) -> Vec<f64> {
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

/// Largest deviation of the chord between neighbouring contact points from the wash path \[m\].
pub const CHORD_ERROR_M: f64 = 2e-5;

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
