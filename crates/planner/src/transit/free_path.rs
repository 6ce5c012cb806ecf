//! The free part of a transit, between two tops.

use platewash_kinematics::JointVector;

/// Joint motion between neighbouring configurations that are looked at, at most \[rad\].
pub const STEP_RAD: f64 = 0.02;

/// Configurations between two tops, both left out, with the parameter counted from the first top \[m\], and its
/// value at the second.
#[derive(Debug, Clone)]
pub(super) struct FreePath {
    pub u: Vec<f64>,
    pub q: Vec<JointVector>,
    pub length: f64,
}
