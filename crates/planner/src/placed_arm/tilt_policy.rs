//! Tilt as a function of the contact point's distance from axis 1 alone.
//!
//! With `S(x) = x³ (10 − 15 x + 6 x²)`, the quintic smoothstep clamped to [0, 1], and `x_n = (r − n₀) / (n₁ − n₀)`,
//! `x_f = (r − f₀) / (f₁ − f₀)`:
//!
//! `τ(r) = T (1 − S(x_n) − S(x_f))`,
//!
//! so that the flange leans away from axis 1 near the base, which keeps wrist and forearm off the base, and inward far
//! out, which keeps the wrist within reach. It is C², also along a wash path wherever `r > 0`.
//!
//! Two choices of the ramps are useful:
//!
//! - [`TiltPolicy::sloping`]: both ramps over the whole plate. The tool turns about its tip while the tip moves out
//!   and in, so that shoulder and elbow travel less: on the IRB 120 a wash path takes half the joint travel of a fixed pose.
//! - [`TiltPolicy::upright`]: ramps at the borders of the arm's reach, and upright between them.

use platewash_workcell::job::ReachBorders;
use serde::Serialize;
use std::f64::consts::PI;

/// The amplitude that is tried before greater ones \[rad\]: 15°. More saves no joint travel worth the clearance.
pub const GENTLE_TILT_RAD: f64 = PI / 12.0;

/// The fastest change of the tilt along a ramp \[rad/m\]: 2° per 5 mm.
pub const FASTEST_RAD_M: f64 = PI / 90.0 / 5e-3;

/// The steepest slope of S.
const STEEPEST: f64 = 1.875;

/// The tilt as a function of the distance from axis 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TiltPolicy {
    /// T: the tilt outwards near the base, and inwards far out \[rad\].
    pub tilt_rad: f64,
    /// n₀ and n₁: up to the first fully outwards, from the second on upright \[m\].
    pub near_m: [f64; 2],
    /// f₀ and f₁: up to the first upright, from the second on fully inwards \[m\].
    pub far_m: [f64; 2],
}

impl TiltPolicy {
    /// Both ramps over a wash path of `radius_m` \[m\] whose centre is `centre_m` \[m\] away from axis 1, and half as far again on
    /// either side; wider where the tilt would change too fast.
    #[must_use]
    pub fn sloping(tilt_rad: f64, centre_m: f64, radius_m: f64) -> Self {
        let half = (1.5 * radius_m).max(STEEPEST * tilt_rad / FASTEST_RAD_M);
        let ramp = [centre_m - half, centre_m + half];
        Self {
            tilt_rad,
            near_m: ramp,
            far_m: ramp,
        }
    }

    /// Upright but for the borders of the arm's reach. Above `GENTLE_TILT_RAD` the ramps grow with the amplitude.
    #[must_use]
    pub fn upright(tilt_rad: f64, reach: &ReachBorders) -> Self {
        let stretch = (tilt_rad / GENTLE_TILT_RAD).max(1.0);
        let ReachBorders { near_m, far_m } = *reach;
        Self {
            tilt_rad,
            near_m: [near_m, near_m + 0.07 * stretch],
            far_m: [far_m - 0.08 * stretch, far_m],
        }
    }

    /// Tilt at the distance `r` \[m\] from axis 1 \[rad\], positive outwards.
    #[must_use]
    pub fn tilt(&self, r: f64) -> f64 {
        let [near, far] = [self.near_m, self.far_m].map(|ramp| smoothstep(r, ramp));
        self.tilt_rad * (1.0 - near - far)
    }
}

/// `S((r − from) / (to − from))`: 0 up to `from`, 1 from `to` on, C² between.
fn smoothstep(r: f64, [from, to]: [f64; 2]) -> f64 {
    let x = ((r - from) / (to - from)).clamp(0.0, 1.0);
    x * x * x * (10.0 - 15.0 * x + 6.0 * x * x)
}

#[allow(clippy::disallowed_methods)]
#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_tilt_is_smooth_falls_and_stays_within_its_amplitude(r in 0.0..1.0f64, limit in 0.0..0.6f64, radius in 0.02..0.2f64, slopes in any::<bool>()) {
            let policy = if slopes { TiltPolicy::sloping(limit, 0.4, radius) } else { TiltPolicy::upright(limit, &ReachBorders::IRB_120) };
            let h = 1e-5;
            let [before, here, after] = [r - h, r, r + h].map(|r| policy.tilt(r));
            prop_assert!(here.abs() <= limit && after <= before);
            // The measured ramps are faster than the rest by 0.4 %.
            prop_assert!(before - after <= 2.0 * h * 1.01 * FASTEST_RAD_M + 1e-12);
            // C²: the second derivative has no jump.
            let second = |r: f64| (policy.tilt(r + h) - 2.0 * policy.tilt(r) + policy.tilt(r - h)) / (h * h);
            prop_assert!((second(r + h) - second(r)).abs() < 30.0);
        }
    }

    #[test]
    fn the_policy_of_the_irb_120() {
        let policy = TiltPolicy::upright(GENTLE_TILT_RAD, &ReachBorders::IRB_120);
        for (r, tilt) in [
            (0.1, 1.0),
            (0.14, 1.0),
            (0.175, 0.5),
            (0.21, 0.0),
            (0.4, 0.0),
            (0.58, -0.5),
            (0.62, -1.0),
        ] {
            assert!((policy.tilt(r) - tilt * GENTLE_TILT_RAD).abs() < 1e-12, "{r}");
        }
    }
}
