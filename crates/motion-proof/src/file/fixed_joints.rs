//! Checks of the joints that are stated to be fixed.

use platewash_kinematics::RobotModel;
use platewash_kinematics::urdf::FixedJoints;
use platewash_workcell::words::quoted;

/// Greatest difference at which a joint is where it is fixed \[rad, m\].
const SAME: f64 = 1e-9;

/// Checks a number of a joint that is fixed: a position, speed or acceleration.
pub(super) fn check_fixed(joint: &str, expected: f64, found: f64) -> Result<(), String> {
    if (found - expected).abs() <= SAME {
        return Ok(());
    }
    Err(format!(
        "expected {expected} for joint {}, which is fixed; found {found}",
        quoted(joint)
    ))
}

/// Checks that every joint that is fixed is one of the arm, of its description or of the file.
pub(super) fn check_fixed_names(
    arm: &RobotModel,
    fixed: &FixedJoints,
    of_file: impl Fn(&str) -> bool,
) -> Result<(), String> {
    let is_known = |name: &String| {
        of_file(name) || arm.fixed_joints().contains_key(name) || arm.joints().iter().any(|joint| joint.name == *name)
    };
    match fixed.keys().find(|name| !is_known(name)) {
        Some(name) => Err(format!(
            "joint {} is fixed, and neither the trajectory nor the arm has a joint of that name",
            quoted(name)
        )),
        None => Ok(()),
    }
}
