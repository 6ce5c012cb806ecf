//! Numbers that bound what is planned on a plate.

use super::error::RedundancyError;
use platewash_kinematics::JointVector;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::{LEAST_RADIUS_M, LEAST_TURNS, LONGEST_M, MOST_TURNS, WashPath};
use std::f64::consts::{FRAC_PI_2, PI};

/// How far the chord between neighbouring contact points may leave the wash path \[m\].
pub const CHORD_ERROR_M: f64 = 2e-5;

/// The largest tilt that can be asked for \[rad\]: short of lying flat.
pub const LARGEST_TILT_RAD: f64 = 0.9 * FRAC_PI_2;

/// Lengths beyond this are no plates \[m\].
const LARGEST_M: f64 = 10.0;

/// Refuses a wash path, a plate, a clearance or a configuration that is none.
pub(super) fn check_input(
    path: &WashPath,
    plate: &Plate,
    clearance_m: f64,
    near: &JointVector,
) -> Result<(), RedundancyError> {
    let curve = &path.curve;
    within("cone_rad", path.cone_rad, [0.0, LARGEST_TILT_RAD])?;
    within("clearance_m", clearance_m, [0.0, 1.0])?;
    within("curve.radius_m", curve.radius_m, [LEAST_RADIUS_M, LARGEST_M])?;
    within("curve.turns", curve.turns, [LEAST_TURNS, MOST_TURNS])?;
    within("curve.start_angle_rad", curve.start_angle_rad, [-1e3, 1e3])?;
    // A spiral of mean radius R/2, and a ring.
    let length = PI * curve.radius_m * (curve.turns + 2.0);
    within("length of the curve", length, [0.0, LONGEST_M])?;
    for &coordinate in &plate.centre() {
        within("centre", coordinate, [-LARGEST_M, LARGEST_M])?;
    }
    for &joint in near {
        within("near", joint, [-1e3, 1e3])?;
    }
    Ok(())
}

fn within(name: &'static str, found: f64, [least, most]: [f64; 2]) -> Result<(), RedundancyError> {
    if (least..=most).contains(&found) {
        return Ok(());
    }
    Err(RedundancyError::Input {
        name,
        least,
        most,
        found,
    })
}
