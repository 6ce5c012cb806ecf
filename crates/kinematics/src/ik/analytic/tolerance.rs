//! What counts as zero, as a limit, as met.

/// Largest deviation of a length that must be zero for an arm to be recognised \[m\].
pub const GEOMETRY_TOLERANCE_M: f64 = 1e-10;
/// Largest deviation of an angle that must be 0° or 90° for an arm to be recognised \[rad\].
pub const GEOMETRY_TOLERANCE_RAD: f64 = 1e-10;
/// Shortest upper arm and forearm \[m\].
pub const SHORTEST_LINK_M: f64 = 1e-3;
/// A target this far beyond full stretch, full fold or the column around axis 1 is still answered \[m\].
pub const REACH_ROUNDING_M: f64 = 5e-10;
/// A wrist centre this close to axis 1 (or axis 2, where the arm can fold so far) leaves the joint free \[m\].
pub const FREE_SHOULDER_M: f64 = 1e-10;
/// Axes 4 and 6 this close to parallel leave joint 4 free \[rad\].
pub const FREE_WRIST_RAD: f64 = 1e-10;
/// A joint this far beyond a limit is set onto it \[rad\].
pub const LIMIT_ROUNDING_RAD: f64 = 1e-11;
/// A branch this far beyond a limit is moved onto it if the other joints can make up for it \[rad\].
pub const LIMIT_NEAR_RAD: f64 = 1e-5;
/// … to this much \[m and rad\].
pub const CLOSED: f64 = 2e-10;
/// At most this many whole turns of a continuous joint are followed, either way.
pub const MOST_TURNS: f64 = 1000.0;
