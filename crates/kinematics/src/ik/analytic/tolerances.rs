//! Tolerances of the closed forms.

/// Largest deviation of a length that must be zero for an arm to be recognised \[m\].
pub const GEOMETRY_TOLERANCE_M: f64 = 1e-10;
/// Largest deviation of an angle that must be 0° or 90° for an arm to be recognised \[rad\].
pub const GEOMETRY_TOLERANCE_RAD: f64 = 5e-10;
/// Shortest upper arm and forearm \[m\].
pub const SHORTEST_LINK_M: f64 = 1e-3;
/// Distance of a target beyond full stretch, full fold or the column around axis 1 up to which it is still answered \[m\].
pub const REACH_ROUNDING_M: f64 = 5e-10;
/// Distance of a wrist centre from axis 1 (or axis 2, if the arm can fold so far) below which the joint is free \[m\].
pub const FREE_SHOULDER_M: f64 = 1e-10;
/// Angle between axes 4 and 6 below which joint 4 is free \[rad\].
pub const FREE_WRIST_RAD: f64 = 1e-10;
/// Distance beyond a limit up to which a joint is set onto it \[rad\].
pub const LIMIT_ROUNDING_RAD: f64 = 1e-11;
/// Distance beyond a limit up to which a branch is moved onto it, if the other joints can make up for it \[rad\].
pub const LIMIT_NEAR_RAD: f64 = 1e-5;
/// Error of the pose up to which those joints must make up for it \[m and rad\].
pub const CLOSED: f64 = 2e-10;
/// Greatest number of whole turns of a continuous joint that are followed, either way.
pub const MOST_TURNS: f64 = 1000.0;
