//! Profile with as few knots as the points ask for.

use crate::measured::axis::{Fitted, Frame};
use crate::measured::knots::{Profile, rings};

/// Number of knots, at equal distances, of the profile while the axis is sought.
pub(super) const FIRST_KNOTS: usize = 16;

/// Returns the profile with as few knots as the points ask for, and moves the frame to its axis.
pub(super) fn sparing(fitted: &Fitted<'_>, frame: &mut Frame, profile: &Profile, rim_m: f64) -> Profile {
    let found = |frame: &Frame, profile: &Profile| Profile::sparing(&rings(&fitted.kept(frame, profile), rim_m), rim_m);
    let mut profile = found(frame, profile);
    fitted.refine(frame, &mut profile, 20, |points, profile| {
        profile.fitted(&rings(points, rim_m), false, 4)
    });
    found(frame, &profile)
}
