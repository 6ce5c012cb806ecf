//! A profile in words.

use super::{Knot, Surface};
use platewash_kinematics::words::rounded;

/// Significant digits of a knot, which is stated; and of a height, which follows.
const DIGITS: [usize; 2] = [9, 5];

impl Surface {
    /// Which profile it is, by its name or its knots, and how high its rim is over its pole; `None` of a disc.
    #[must_use]
    pub fn profile_words(&self) -> Option<String> {
        let Self::Profile(meridian) = self else { return None };
        let [stated, derived] = DIGITS;
        let knot = |knot: &Knot| {
            let (radius_mm, slope_deg) = (1e3 * knot.radius_m, knot.slope_rad.to_degrees());
            format!(
                "{} mm {}°",
                rounded(radius_mm, stated),
                rounded(slope_deg, stated) + 0.0
            )
        };
        let by_knots = || {
            let knots: Vec<_> = meridian.knots().iter().map(knot).collect();
            format!("of a profile by knots ({})", knots.join(", "))
        };
        let profile = self
            .shipped_name()
            .map_or_else(by_knots, |name| format!("of profile {name}"));
        let rim_mm = rounded(1e3 * self.height_m(self.rim_m()), derived);
        let side = if rim_mm < 0.0 { "below" } else { "over" };
        Some(format!("{profile}, rim {} mm {side} the pole", rim_mm.abs()))
    }
}
