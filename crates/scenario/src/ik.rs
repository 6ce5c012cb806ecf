//! The `[ik]` section: inverse kinematics.

use platewash_keys::Section;
use platewash_paper::settings::{IkMethod, IkSeed};
use serde::{Deserialize, Serialize};

/// `[ik]`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Section)]
#[section("ik")]
#[serde(default, deny_unknown_fields)]
pub struct IkSection {
    /// Solver of the paper's program: damped least squares with a QP fallback, alone or also from the closed form's nearest branch.
    #[key(domain = Word(&["numeric", "analytic"]), default = IkMethod::Numeric)]
    pub method: IkMethod,
    /// Each waypoint is solved from the configuration that the arm really has (the paper), or from the previous answer.
    #[key(domain = Word(&["executed", "previous"]), default = IkSeed::Previous)]
    pub seed: IkSeed,
    /// Largest accepted position error.
    #[key(unit = "m", domain = Number(1e-12, 1e-2), default = 1e-6)]
    pub position_tolerance_m: f64,
    /// Largest accepted orientation error.
    #[key(unit = "rad", domain = Number(1e-12, 1e-2), default = 1e-6)]
    pub orientation_tolerance_rad: f64,
}
