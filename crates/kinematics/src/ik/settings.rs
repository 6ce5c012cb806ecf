//! Settings of the inverse kinematics.

use std::f64::consts::PI;

/// Restarts from random configurations within the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RandomRestarts {
    /// Seed of the random stream; the same seed gives the same answer.
    pub seed: u64,
    /// Number of restarts.
    pub count: usize,
}

/// Use of analytic branches as starts, on arms that have them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AnalyticStarts {
    /// Branches are starts, if [`crate::ik::analytic::AnalyticArm::recognise`] accepts the arm.
    Used,
    /// Branches are not starts: only the numeric cascade runs.
    Unused,
}

/// Settings of [`crate::ik::cascade::IkSolver`]; [`IkSettings::default`] suits the IRB 120 and arms of its size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IkSettings {
    /// Largest accepted distance between the frame's origin and the target's \[m\]; default 1e-6.
    pub position_tolerance_m: f64,
    /// Largest accepted angle between the frame and the target \[rad\]; default 1e-6.
    pub orientation_tolerance_rad: f64,
    /// Greatest number of DLS iterations from one start; default 60.
    pub max_iterations: usize,
    /// Greatest number of quadratic programs from one start; default 30.
    pub max_qp_iterations: usize,
    /// Largest joint step of one iteration \[rad\]; default 0.7.
    pub step_bound_rad: f64,
    /// Analytic branches as starts; default [`AnalyticStarts::Used`].
    pub analytic_starts: AnalyticStarts,
    /// Number of listed starts tried after the seed; default 64, at most [`crate::ik::starts::LISTED`].
    pub listed_starts: usize,
    /// Random restarts after the listed ones; default none.
    pub random_restarts: Option<RandomRestarts>,
}

impl Default for IkSettings {
    fn default() -> Self {
        Self {
            position_tolerance_m: 1e-6,
            orientation_tolerance_rad: 1e-6,
            max_iterations: 60,
            max_qp_iterations: 30,
            step_bound_rad: 0.7,
            analytic_starts: AnalyticStarts::Used,
            listed_starts: 64,
            random_restarts: None,
        }
    }
}

/// Setting that is out of its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("IK setting {name} must be {expected}; found {found}")]
pub struct IkSettingsError {
    /// Name of the setting.
    pub name: &'static str,
    /// Allowed range.
    pub expected: &'static str,
    /// Value found.
    pub found: f64,
}

impl IkSettings {
    /// Checks every setting against its range.
    ///
    /// # Errors
    /// [`IkSettingsError`] for the first setting out of range, NaN included.
    pub fn validate(&self) -> Result<(), IkSettingsError> {
        let tolerance = |v: f64| (1e-13..=1.0).contains(&v);
        let checks = [
            (
                "position_tolerance_m",
                self.position_tolerance_m,
                "in [1e-13, 1] m",
                tolerance(self.position_tolerance_m),
            ),
            (
                "orientation_tolerance_rad",
                self.orientation_tolerance_rad,
                "in [1e-13, 1] rad",
                tolerance(self.orientation_tolerance_rad),
            ),
            (
                "max_iterations",
                self.max_iterations as f64,
                "at least 1",
                self.max_iterations >= 1,
            ),
            (
                "step_bound_rad",
                self.step_bound_rad,
                "in (0, π] rad",
                self.step_bound_rad > 0.0 && self.step_bound_rad <= PI,
            ),
            (
                "listed_starts",
                self.listed_starts as f64,
                "at most 256",
                self.listed_starts <= crate::ik::starts::LISTED,
            ),
        ];
        // (No bound is needed on max_qp_iterations, where 0 means no QP, nor on random_restarts.count, where 0 means none.)
        match checks.into_iter().find(|(_, _, _, fine)| !fine) {
            Some((name, found, expected, _)) => Err(IkSettingsError { name, expected, found }),
            None => Ok(()),
        }
    }
}
