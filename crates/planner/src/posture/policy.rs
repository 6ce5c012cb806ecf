//! The tilt as a function of the contact point's distance from axis 1 alone.
//!
//! Near the base the flange leans away from axis 1, so that wrist and forearm keep off the base; far out it leans
//! inward, so that the wrist stays within reach. With `S(x) = x³ (10 − 15 x + 6 x²)`, the quintic smoothstep clamped to
//! [0, 1], and `x_n = (r − n₀) / (n₁ − n₀)`, `x_f = (r − f₀) / (f₁ − f₀)`:
//!
//! `τ(r) = T (1 − S(x_n) − S(x_f))`.
//!
//! It is C², and C² along a stroke wherever `r > 0`. The radii were found on the IRB 120 with a tool of 150 mm, where
//! the policy suffices for every plate of the paper up to a path radius of 0.13 m.

use std::f64::consts::PI;

/// The amplitude for which the ramps of [`TiltPolicy::up_to`] were measured \[rad\].
pub const MEASURED_TILT_RAD: f64 = PI / 12.0;

/// The tilt as a function of the distance from axis 1; see the [module](self) text.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TiltPolicy {
    /// T: the tilt outwards near the base, and inwards far out \[rad\].
    pub tilt_rad: f64,
    /// n₀ and n₁: up to the first fully outwards, from the second on upright \[m\].
    pub near_m: [f64; 2],
    /// f₀ and f₁: up to the first upright, from the second on fully inwards \[m\].
    pub far_m: [f64; 2],
}

impl TiltPolicy {
    /// The measured policy with the amplitude `tilt_rad`. Above [`MEASURED_TILT_RAD`] its ramps grow with it, so that the
    /// tilt changes no faster than 2° per 5 mm.
    #[must_use]
    pub fn up_to(tilt_rad: f64) -> Self {
        let stretch = (tilt_rad / MEASURED_TILT_RAD).max(1.0);
        Self {
            tilt_rad,
            near_m: [0.14, 0.14 + 0.07 * stretch],
            far_m: [0.62 - 0.08 * stretch, 0.62],
        }
    }

    /// Tilt at the distance `r` \[m\] from axis 1 \[rad\], positive outwards, and its derivative by `r` \[rad/m\].
    #[must_use]
    pub fn tilt(&self, r: f64) -> [f64; 2] {
        let [near, far] = [self.near_m, self.far_m].map(|ramp| smoothstep(r, ramp));
        [
            self.tilt_rad * (1.0 - near[0] - far[0]),
            -self.tilt_rad * (near[1] + far[1]),
        ]
    }
}

/// `S((r − from) / (to − from))` and its derivative by r.
fn smoothstep(r: f64, [from, to]: [f64; 2]) -> [f64; 2] {
    let x = ((r - from) / (to - from)).clamp(0.0, 1.0);
    let rest = 1.0 - x;
    [
        x * x * x * (10.0 - 15.0 * x + 6.0 * x * x),
        30.0 * x * x * rest * rest / (to - from),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_tilt_is_smooth_falls_and_stays_within_its_amplitude(r in 0.0..1.0f64, limit in 0.0..0.6f64) {
            let policy = TiltPolicy::up_to(limit);
            let h = 1e-5;
            let [before, here, after] = [r - h, r, r + h].map(|r| policy.tilt(r));
            prop_assert!(here[0].abs() <= limit && here[1] <= 0.0);
            prop_assert!(((after[0] - before[0]) / (2.0 * h) - here[1]).abs() < 1e-4);
            // C²: the slope has a bounded derivative, without jumps.
            prop_assert!((after[1] - before[1]).abs() < 2.0 * h * 2000.0);
            // At most 2° per 5 mm, to the third digit.
            prop_assert!(here[1].abs() <= 2.02_f64.to_radians() / 5e-3);
        }
    }

    #[test]
    fn the_policy_of_the_irb_120() {
        let policy = TiltPolicy::up_to(MEASURED_TILT_RAD);
        for (r, tilt) in [
            (0.1, 1.0),
            (0.14, 1.0),
            (0.175, 0.5),
            (0.21, 0.0),
            (0.4, 0.0),
            (0.58, -0.5),
            (0.62, -1.0),
        ] {
            assert!((policy.tilt(r)[0] - tilt * MEASURED_TILT_RAD).abs() < 1e-12, "{r}");
        }
    }
}
