//! The `[ik]` section: inverse kinematics.

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

/// The inverse-kinematics solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IkMethod {
    /// Damped least squares with a QP fallback, from the seed and a fixed list of starts.
    Numeric,
    /// The same, from the closed form's nearest branch where the seed is far away or fails (arms that have one).
    Analytic,
}

/// From where each waypoint is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IkSeed {
    /// The configuration that the arm really has, lagging behind (the paper).
    Executed,
    /// The answer at the previous waypoint.
    Previous,
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
