//! The `[ik]` section: inverse kinematics.

use platewash_paper::settings::{IkMethod, IkSeed};
use serde::{Deserialize, Serialize};

/// `[ik]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct IkSection {
    /// The solver.
    pub method: IkMethod,
    /// From where each waypoint is solved.
    pub seed: IkSeed,
    /// Largest accepted position error \[m\].
    pub position_tolerance_m: f64,
    /// Largest accepted orientation error \[rad\].
    pub orientation_tolerance_rad: f64,
}

impl Default for IkSection {
    fn default() -> Self {
        Self {
            method: IkMethod::Numeric,
            seed: IkSeed::Previous,
            position_tolerance_m: 1e-6,
            orientation_tolerance_rad: 1e-6,
        }
    }
}
