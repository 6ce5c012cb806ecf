//! What the contact of sponge and plate must keep.

use serde::{Deserialize, Serialize};

/// What the contact of sponge and plate must keep while it washes, wherever within its error of height a plate lies, and whatever within
/// its range the sponge's stiffness is. Shares are of the area of a plate's face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactRequirements {
    /// c_min: the least compression of the sponge that counts as contact \[m\].
    pub compression_m: f64,
    /// ±δ: how much higher or lower than stated, along its axis, a plate may lie \[m\].
    pub height_error_m: f64,
    /// Least share that comes into contact.
    pub share: f64,
    /// Greatest strain of the sponge anywhere: its compression over its free height.
    pub strain: f64,
    /// Least and greatest normal force on the sponge while it washes \[N\].
    pub force_n: [f64; 2],
    /// Least time in contact \[s\] …
    pub time_s: f64,
    /// … on at least this share.
    pub time_share: f64,
    /// Least dose ∫ p dl of pressure over sliding distance in contact \[Pa·m\] …
    pub dose_pa_m: f64,
    /// … on at least this share.
    pub dose_share: f64,
}
