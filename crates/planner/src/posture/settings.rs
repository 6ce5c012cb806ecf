//! What a posture must keep.

use super::PostureError;
use nalgebra::Vector3;
use platewash_kinematics::JointVector;
use platewash_workcell::stroke::Stroke;
use std::f64::consts::{FRAC_PI_2, PI};

/// Added to the clearance asked for, so that the motion between the points checked keeps it too \[m\].
pub const RESERVE_M: f64 = 5e-4;

/// What the largest tilt planned stays below the largest allowed \[rad\], 0.057°: between the points solved, the joints follow
/// curves through them and then cubics, which turn the tool a little further.
pub const TILT_RESERVE_RAD: f64 = 1e-3;

/// How far the chord between neighbouring contact points may leave the stroke \[m\].
pub const CHORD_ERROR_M: f64 = 2e-5;

/// The largest tilt that can be asked for \[rad\]: short of lying flat.
pub const LARGEST_TILT_RAD: f64 = 0.9 * FRAC_PI_2;

/// Lengths beyond this are no plates \[m\].
const LARGEST_M: f64 = 10.0;

/// The least outer radius of a stroke \[m\].
pub(crate) const LEAST_RADIUS_M: f64 = 1e-4;

/// The fewest turns of a stroke.
pub(crate) const LEAST_TURNS: f64 = 0.25;

/// The most turns of a stroke.
pub(crate) const MOST_TURNS: f64 = 200.0;

/// The longest stroke \[m\]; it bounds time and memory.
pub(crate) const LONGEST_M: f64 = 100.0;

/// What a posture must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PostureSettings {
    /// Largest angle of the tool from the plate's normal \[rad\], in [0, [`LARGEST_TILT_RAD`]].
    pub tilt_max_rad: f64,
    /// Clearance of every pair but the sponge and the plates \[m\], in [0, 1]; [`RESERVE_M`] is added to it.
    pub clearance_m: f64,
}

impl PostureSettings {
    /// Clearance with its reserve \[m\].
    #[must_use]
    pub fn required_m(&self) -> f64 {
        self.clearance_m + RESERVE_M
    }

    /// The largest tilt at the points that are solved \[rad\]: [`TILT_RESERVE_RAD`] less than allowed, or half of what is allowed
    /// where that is more.
    #[must_use]
    pub fn planned_tilt_rad(&self) -> f64 {
        (self.tilt_max_rad - TILT_RESERVE_RAD).max(0.5 * self.tilt_max_rad)
    }

    /// Refuses settings out of their range, NaN included.
    ///
    /// # Errors
    /// [`PostureError::Input`], naming the first.
    pub fn validate(&self) -> Result<(), PostureError> {
        within("tilt_max_rad", self.tilt_max_rad, [0.0, LARGEST_TILT_RAD])?;
        within("clearance_m", self.clearance_m, [0.0, 1.0])
    }
}

/// Refuses a stroke, a centre or a configuration that is none.
pub(super) fn check_input(stroke: &Stroke, centre: &Vector3<f64>, near: &JointVector) -> Result<(), PostureError> {
    within("stroke.radius_m", stroke.radius_m, [LEAST_RADIUS_M, LARGEST_M])?;
    within("stroke.turns", stroke.turns, [LEAST_TURNS, MOST_TURNS])?;
    within("stroke.start_angle_rad", stroke.start_angle_rad, [-1e3, 1e3])?;
    // A spiral of mean radius R/2, and a ring.
    let length = PI * stroke.radius_m * (stroke.turns + 2.0);
    within("length of the stroke", length, [0.0, LONGEST_M])?;
    for &coordinate in centre {
        within("centre", coordinate, [-LARGEST_M, LARGEST_M])?;
    }
    for &joint in near {
        within("near", joint, [-1e3, 1e3])?;
    }
    Ok(())
}

fn within(name: &'static str, found: f64, [least, most]: [f64; 2]) -> Result<(), PostureError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(PostureError::Input {
        name,
        least,
        most,
        found,
    })
}
